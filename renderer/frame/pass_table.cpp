// The pass table: to add a pass, add its row here, its pair of files and its shader.
#include <algorithm>
#include <string>

#include "renderer/core/error.h"
#include "renderer/core/hash.h"
#include "renderer/frame/changed_groups.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/light_patches.h"
#include "renderer/frame/opposite.h"
#include "renderer/gpu/device.h"
#include "renderer/passes/diffusion.h"
#include "renderer/passes/exitance.h"
#include "renderer/passes/irradiance.h"
#include "renderer/passes/light_maps.h"
#include "renderer/passes/light_views.h"
#include "renderer/passes/opposite.h"
#include "renderer/passes/published_diffusion.h"
#include "renderer/passes/seen_triangles.h"
#include "renderer/passes/surface.h"
#include "renderer/passes/thickness.h"

namespace cutis {
namespace {

// Rows before the frame

void makeOppositeVertices(FrameContext& frame) {
    const std::vector<shared::OppositeVertex> vertices =
        findOpposite(*frame.input->scene, frame.geometry, frame.atlas);
    frame.oppositeVertices =
        gpu::Buffer(*frame.device, {.name = "opposite sides", .bytes = vertices.size() * sizeof(vertices[0])});
    frame.commands->upload(frame.oppositeVertices, vertices);
}

glm::ivec2 pictureSize(const FrameContext& frame) {
    return {frame.settings->width, frame.settings->height};
}

// Room for one part of the picture.
void makeViewBuffers(FrameContext& frame) {
    const int step = tileSize(frame.scene.buffers, kSupersampling);
    frame.viewTile = makeTileBuffers(*frame.device, frame.scene.buffers,
                                     glm::min(glm::ivec2(step), pictureSize(frame)), kSupersampling);
}

void makeTarget(FrameContext& frame) {
    const auto width = static_cast<std::uint32_t>(frame.settings->width);
    const auto height = static_cast<std::uint32_t>(frame.settings->height);
    const VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    frame.target.picture =
        gpu::Image(*frame.device, {.name = "picture", .format = format, .width = width, .height = height});
    frame.target.aovLayer.fill(-1);
    int layers = 0;
    for (int i = 0; i < kAovCount; ++i) {
        const auto& wanted = frame.settings->aovs;
        const bool named =
            i != kAovAtlas && std::find(wanted.begin(), wanted.end(), kAovNames[i]) != wanted.end();
        const bool inspected = i == kAovAtlas && frame.settings->inspect.what != Inspect::What::none;
        if (named || inspected) frame.target.aovLayer[i] = layers++;
    }
    if (layers > 0) {
        frame.target.aovs = gpu::Image(*frame.device, {.name = "aovs", .format = format, .width = width,
                                                       .height = height, .layers = static_cast<std::uint32_t>(layers)});
    }
}

// Rows of the frame

// Draws the views that no layer holds yet. Only lights and poses may have changed for a layer to stay, and of those whose
// view shows it neither.
// Maps are layers of one image, of which a device has only so many.
void checkMapCount(const FrameContext& frame, std::uint32_t maps, std::size_t samples) {
    const std::uint32_t most = frame.device->limits().maxImageArrayLayers;
    if (maps <= most) return;
    throw Error("cannot light the scene",
                std::to_string(samples) + " light samples with shadows take " + std::to_string(maps) +
                    " light maps, one for each character that they may reach, the limit is " + std::to_string(most) +
                    ": " + std::to_string(std::uint64_t(samples) * most / maps) +
                    " samples would fit (fewer lights, or \"samples\" of area lights)",
                frame.device->info().name);
}

void lightMapsRow(FrameContext& frame) {
    const std::vector<LightSample> shadowed = shadowedSamples(frame);
    LightMaps& maps = frame.lights;
    if (!frame.changes->only({Input::lightPlaces, Input::lightMapsNeeded}, {Resource::meshes})) {
        frame.lightMapLayers.forget();
        maps.depth = {}, maps.entry = {};
    }
    maps.size = frame.detail.lightMapSize;
    maps.viewList =
        computeLightViews(shadowed, frame.groups, frame.geometry.casters, frame.geometry.origin, maps.size);
    std::vector<std::uint64_t> contents;
    for (const shared::LightView& view : maps.viewList) contents.push_back(contentOf(view, frame.geometry));
    const LightMapLayers::Assignment assigned =
        frame.lightMapLayers.assign(maps.viewList, frame.lighting.mapsNeeded, contents);
    maps.views = gpu::Buffer(*frame.device, {.name = "light views", .bytes = maps.viewList.size() * sizeof(shared::LightView)});
    frame.commands->upload(maps.views, maps.viewList);
    if (assigned.newImage) {
        checkMapCount(frame, frame.lightMapLayers.layers(), shadowed.size());
        const auto renew = [&](gpu::Image& image, const char* name, VkFormat format) {
            const auto size = static_cast<std::uint32_t>(maps.size);
            gpu::Image renewed(*frame.device, {.name = name, .format = format, .width = size, .height = size,
                                               .layers = frame.lightMapLayers.layers()});
            for (const LightMapLayers::Move& move : assigned.moves) {
                frame.commands->copy(image.layer(move.from), renewed.layer(move.to));
            }
            image = std::move(renewed);
        };
        renew(maps.depth, "light depth", VK_FORMAT_D32_SFLOAT);
        if (frame.needs[Need::translucency]) renew(maps.entry, "light entry points", VK_FORMAT_R32_UINT);
    }
    maps.drawn = static_cast<int>(assigned.draw.size());
    if (assigned.newImage && assigned.moves.empty() && assigned.draw.empty()) {
        // Nothing looks any map up, but the images are bound.
        frame.commands->clear(maps.depth, gpu::ClearValue::depth(1));
        if (maps.entry) frame.commands->clear(maps.entry, gpu::ClearValue::integers(0xffffffffu));
    }
    for (std::size_t i = 0; i < assigned.draw.size();) {
        const std::uint32_t first = assigned.draw[i];
        std::uint32_t count = 0;
        for (; i < assigned.draw.size() && assigned.draw[i] == first + count; ++i) ++count;
        recordLightMaps(*frame.device, *frame.commands, frame.scene.buffers,
                        {.depth = &maps.depth, .entry = maps.entry ? &maps.entry : nullptr, .viewBuffer = &maps.views,
                         .views = maps.viewList, .firstView = first, .viewCount = count, .atlasSize = frame.atlas.size});
    }
}

void surfaceRow(FrameContext& frame) {
    recordSurface(*frame.device, *frame.commands, frame.scene.buffers, frame.scene.charts, frame.atlas.size,
                  levelShifts(frame.scene.charts, reducesLevels(*frame.settings)), frame.tiles, frame.surface);
}

// Calls body(tile) for the parts of the picture.
template <class Body>
void forEachViewTile(FrameContext& frame, Body body) {
    const glm::ivec2 picture = pictureSize(frame);
    const int step = tileSize(frame.scene.buffers, kSupersampling);
    for (int y = 0; y < picture.y; y += step) {
        for (int x = 0; x < picture.x; x += step) {
            const glm::ivec2 origin(x, y);
            body(ViewTile{origin, glm::min(glm::ivec2(step), picture - origin), picture, kSupersampling});
        }
    }
}

void visibleRow(FrameContext& frame) {
    const gpu::Buffer seen = makeSeenTriangles(*frame.device, *frame.commands, frame.scene.buffers);
    forEachViewTile(frame, [&](const ViewTile& tile) {
        recordSeenTriangles(*frame.device, *frame.commands, frame.scene.buffers, frame.camera, tile, frame.viewTile,
                            seen);
    });
    recordSeenTiles(*frame.device, *frame.commands, frame.scene.buffers, seen, frame.tiles);
}

void thicknessRow(FrameContext& frame) {
    recordThickness(*frame.device, *frame.commands, frame.scene.buffers, frame.surface, frame.lights, frame.tiles,
                    frame.skin);
}

void neededTexelsRow(FrameContext& frame) {
    recordNeededTiles(*frame.device, *frame.commands, frame.scene.buffers, frame.settings->taps, frame.tiles);
}

void oppositeRow(FrameContext& frame) {
    recordOpposite(*frame.device, *frame.commands, frame.scene.buffers, frame.oppositeVertices, frame.tiles,
                   frame.surface);
}

void environmentVisibilityRow(FrameContext& frame) {
    std::vector<std::uint32_t> vertexCounts;
    for (const GeometryDraw& draw : frame.geometry.draws) vertexCounts.push_back(draw.vertexCount);
    const VisibilityInput input{.scene = &frame.scene.buffers,
                                .surface = frame.surface.size > 0 ? &frame.surface : nullptr,
                                .tiles = &frame.tiles,
                                .draws = frame.scene.draws,
                                .vertexCounts = vertexCounts,
                                .groups = frame.groups,
                                .groupsSeen = frame.groupsSeen,
                                .groupsChanged = frame.changes->groups,
                                .casters = frame.geometry.bounds,
                                .origin = frame.geometry.origin,
                                .probeCount = frame.geometry.probeCount,
                                .mapSize = kVisibilityMapSize,
                                .clearance = 2 * static_cast<float>(frame.proxyError)};
    const EnvironmentSettings& settings = frame.input->rig.environment;
    std::vector<glm::vec4> parts;  // of the sky
    for (const VisibilityDirection& part : frame.sky.parts) {
        parts.emplace_back(rotateAboutY(part.direction, settings.rotation), part.solidAngle);
    }
    std::vector<shared::EnvironmentDirection> arriving;
    for (const DirectionalFlux& from : frame.sky.arriving) {
        arriving.push_back({glm::vec3(from.flux), glm::vec3(rotateAboutY(from.direction, settings.rotation))});
    }
    recordEnvironmentVisibility(*frame.device, *frame.commands, input, parts, frame.visibility);
    recordEnvironmentOcclusion(*frame.device, *frame.commands, input, parts, arriving, frame.visibility);
}

void irradianceRow(FrameContext& frame) {
    const bool environment = frame.needs[Need::environment];
    recordIrradiance(*frame.device, *frame.commands,
                     {.scene = &frame.scene.buffers,
                      .surface = &frame.surface,
                      .tiles = &frame.tiles,
                      .lights = frame.needs[Need::lights] ? &frame.lights : nullptr,
                      .environment = environment ? &frame.environmentMaps : nullptr,
                      .visibility = environment ? &frame.visibility : nullptr,
                      .environmentSettings = environment ? &frame.environmentSettings : nullptr},
                     frame.skin);
}

void diffusionRow(FrameContext& frame) {
    if (frame.settings->chain == Chain::published) {
        recordPublishedDiffusion(*frame.device, *frame.commands, frame.scene.buffers, frame.surface, frame.tiles,
                                 frame.skin);
    } else {
        recordDiffusion(*frame.device, *frame.commands, frame.scene.buffers, frame.surface, frame.tiles,
                        frame.settings->taps, frame.skin);
    }
}

void wideGaussiansRow(FrameContext& frame) {
    recordWideGaussians(*frame.device, *frame.commands, frame.scene.buffers, frame.surface, frame.tiles,
                        frame.scene.charts, frame.patches, frame.skin);
}

void exitanceRow(FrameContext& frame) {
    recordExitance(*frame.device, *frame.commands, frame.scene.buffers, frame.surface, frame.tiles,
                   frame.settings->chain == Chain::published ? ThicknessStorage::bytes : ThicknessStorage::floats,
                   frame.skin);
}

// Both depend on the camera and work tile by tile, so one row holds them.
void compositeRow(FrameContext& frame) {
    const bool environment = frame.needs[Need::environment];
    if (frame.target.aovs) frame.commands->clear(frame.target.aovs);
    forEachViewTile(frame, [&](const ViewTile& tile) {
        recordView(*frame.device, *frame.commands, frame.scene.buffers, frame.camera, tile, frame.viewTile);
        recordComposite(*frame.device, *frame.commands,
                        {.scene = &frame.scene.buffers,
                         .buffers = &frame.viewTile,
                         .skin = frame.needs[Need::litSkin] ? &frame.skin : nullptr,
                         .surface = &frame.surface,
                         .lights = &frame.lights,
                         .environment = environment ? &frame.environmentMaps : nullptr,
                         .visibility = environment ? &frame.visibility : nullptr,
                         .environmentSettings = environment ? &frame.environmentSettings : nullptr},
                        tile, frame.target);
    });
}

// They free what the rows wrote, once more below.

void forgetOccluders(FrameContext& frame) { frame.scene.buffers.proxyIndices = {}; }
void forgetProfiles(FrameContext& frame) { frame.scene.buffers.gaussians = {}; }
void forgetEnvironmentMaps(FrameContext& frame) { frame.environmentMaps = {}; }
void forgetSkyDirections(FrameContext& frame) { frame.sky = {}; }
void forgetEnvironmentSettings(FrameContext& frame) { frame.environmentSettings = {}; }
void forgetOppositeVertices(FrameContext& frame) { frame.oppositeVertices = {}; }
void forgetViewBuffers(FrameContext& frame) { frame.viewTile = {}; }
void forgetTarget(FrameContext& frame) { frame.target = {}; }
void forgetSurface(FrameContext& frame) { frame.surface = {}, frame.tiles = {}; }
void forgetOpposite(FrameContext& frame) { frame.surface.opposite = {}; }
void forgetThickness(FrameContext& frame) { frame.skin.entry = {}; }
void forgetVisibility(FrameContext& frame) { frame.visibility = {}; }
void forgetLevels(FrameContext& frame) { frame.skin.levels = {}; }
void forgetExitance(FrameContext& frame) { frame.skin.exitance = {}; }
void forgetIrradiance(FrameContext& frame) {
    frame.skin.irradiance = {}, frame.skin.incident = {}, frame.skin.visibility = {};
}
void forgetLightMaps(FrameContext& frame) {
    frame.lightMapLayers.forget();
    frame.lights.depth = {}, frame.lights.entry = {}, frame.lights.views = {}, frame.lights.viewList.clear();
}

std::vector<PassRow> rowsBeforeTheFrame() {
    using I = Input;
    using R = Resource;
    return {
        {.name = "environment_maps", .phase = Phase::alone, .need = Need::environment,
         .inputs = {I::environment, I::skinLayer}, .reads = {}, .writes = {R::environmentMaps},
         .record = makeEnvironmentMaps, .forget = forgetEnvironmentMaps},
        {.name = "sky_directions", .phase = Phase::alone, .need = Need::environment, .inputs = {I::environment},
         .reads = {}, .writes = {R::skyDirections}, .ahead = makeSkyDirections, .forget = forgetSkyDirections},
        {.name = "environment_settings", .phase = Phase::upload, .need = Need::environment,
         .inputs = {I::environmentRotation, I::environmentPower}, .reads = {R::environmentMaps},
         .writes = {R::environmentSettings}, .record = uploadEnvironmentSettings, .forget = forgetEnvironmentSettings},
        {.name = "meshes", .phase = Phase::upload, .need = Need::always, .inputs = {I::geometry, I::pose},
         .reads = {}, .writes = {R::meshes}, .record = uploadMeshes, .forget = forgetMeshes},
        {.name = "sky_occluders", .phase = Phase::upload, .need = Need::environment, .inputs = {I::geometry}, .reads = {},
         .writes = {R::occluders}, .record = uploadOccluders, .ahead = makeOccluders, .forget = forgetOccluders},
        {.name = "textures", .phase = Phase::alone, .need = Need::always, .inputs = {I::textures}, .reads = {},
         .writes = {R::textures}, .record = uploadSceneTextures, .forget = forgetTextures},
        {.name = "materials", .phase = Phase::upload, .need = Need::always,
         .inputs = {I::geometry, I::materials, I::skinLayer, I::skinMix, I::profiles}, .reads = {R::textures},
         .variants = {Need::transparency, Need::skinSpecular, Need::clearcoat, Need::sheen, Need::transmission,
                      Need::secondLobe},
         .writes = {R::materials}, .record = uploadMaterials},
        {.name = "pores", .phase = Phase::upload, .need = Need::detail, .inputs = {I::geometry, I::textures, I::pores},
         .reads = {}, .writes = {R::pores}, .record = uploadPores, .forget = forgetPores},
        {.name = "atlas_layout", .phase = Phase::upload, .need = Need::skin, .inputs = {I::geometry, I::atlasDetail},
         .reads = {}, .writes = {R::layout}, .record = uploadLayout, .ahead = makeLayout, .forget = forgetLayout},
        {.name = "stretch", .phase = Phase::upload, .need = Need::motion, .inputs = {},
         .reads = {R::meshes, R::layout}, .writes = {R::stretch}, .record = uploadStretch},
        {.name = "draws", .phase = Phase::upload, .need = Need::always, .inputs = {}, .reads = {R::meshes},
         .readsIf = {R::layout}, .writes = {R::draws}, .record = uploadDraws},
        {.name = "draw_ranges", .phase = Phase::upload, .need = Need::always, .inputs = {I::materials},
         .reads = {R::meshes, R::textures}, .readsIf = {R::occluders}, .writes = {R::ranges}, .record = findDrawRanges},
        {.name = "profiles", .phase = Phase::upload, .need = Need::skin, .inputs = {I::profiles}, .reads = {R::layout},
         .writes = {R::profiles}, .record = uploadProfiles, .forget = forgetProfiles},
        {.name = "seams", .phase = Phase::upload, .need = Need::seams, .inputs = {I::levels},
         .reads = {R::layout}, .writes = {R::seams}, .record = uploadSeams, .ahead = makeSeams, .forget = forgetSeams},
        {.name = "light_patches", .phase = Phase::upload, .need = Need::wideGaussians, .inputs = {},
         .reads = {R::meshes, R::layout, R::profiles}, .writes = {R::lightPatches}, .record = uploadLightPatches,
         .forget = forgetLightPatches},
        {.name = "opposite_sides", .phase = Phase::upload, .need = Need::oppositeSides, .inputs = {I::profiles},
         .reads = {R::meshes, R::layout}, .writes = {R::oppositeVertices}, .record = makeOppositeVertices,
         .forget = forgetOppositeVertices},
        {.name = "lights", .phase = Phase::upload, .need = Need::always, .inputs = {I::geometry, I::lightPlaces, I::lightPower},
         .reads = {}, .writes = {R::lights}, .record = uploadLightSamples},
        {.name = "view_buffers", .phase = Phase::upload, .need = Need::always, .inputs = {I::geometry, I::pictureSize, I::materials},
         .reads = {}, .variants = {Need::transparency}, .writes = {R::viewBuffers}, .record = makeViewBuffers, .forget = forgetViewBuffers},
        {.name = "picture", .phase = Phase::upload, .need = Need::always, .inputs = {I::pictureSize, I::aovs},
         .reads = {}, .writes = {R::target}, .record = makeTarget, .forget = forgetTarget},
    };
}

std::vector<PassRow> rowsOfTheFrame() {
    using I = Input;
    using R = Resource;
    return {
        {.name = "surface", .phase = Phase::frame, .need = Need::skin, .inputs = {I::materials, I::levels},
         .reads = {R::meshes, R::layout, R::draws, R::textures}, .readsIf = {R::seams, R::stretch}, .writes = {R::surface}, .record = surfaceRow,
         .forget = forgetSurface,
         .byGroup = true},
        {.name = "visible", .phase = Phase::frame, .need = Need::hiddenSkin, .inputs = {I::camera, I::materials},
         .reads = {R::viewBuffers, R::surface}, .writes = {R::seen}, .record = visibleRow},
        {.name = "opposite", .phase = Phase::frame, .need = Need::oppositeSides, .inputs = {I::profiles},
         .reads = {R::surface, R::oppositeVertices}, .readsIf = {R::seen}, .updates = {R::seen},
         .writes = {R::thickness}, .record = oppositeRow, .forget = forgetOpposite},
        {.name = "light_maps", .phase = Phase::frame, .need = Need::shadows,
         .inputs = {I::geometry, I::lightPlaces, I::lightMapSize, I::lightMapsNeeded, I::materials},
         .reads = {R::meshes, R::textures}, .readsIf = {R::layout}, .variants = {Need::translucency}, .writes = {R::lightMaps}, .record = lightMapsRow,
         .forget = forgetLightMaps, .amends = true},
        {.name = "thickness", .phase = Phase::frame, .need = Need::translucency,
         .inputs = {I::lightPlaces, I::profiles}, .reads = {R::surface, R::lightMaps}, .readsIf = {R::seen},
         .updates = {R::seen}, .writes = {R::thickness}, .record = thicknessRow, .forget = forgetThickness,
         .byGroup = true},
        {.name = "needed_texels", .phase = Phase::frame, .need = Need::hiddenSkin, .inputs = {I::profiles, I::chain},
         .reads = {R::surface, R::seen}, .readsIf = {R::thickness}, .updates = {R::seen}, .writes = {R::tiles},
         .record = neededTexelsRow},
        {.name = "environment_visibility", .phase = Phase::frame, .need = Need::environment,
         .inputs = {I::environment, I::environmentRotation, I::groupsSeen, I::materials},
         .reads = {R::meshes, R::draws, R::ranges, R::textures, R::occluders, R::skyDirections},
         .readsIf = {R::surface, R::tiles}, .writes = {R::visibility}, .record = environmentVisibilityRow,
         .forget = forgetVisibility,
         .byGroup = true},
        {.name = "irradiance", .phase = Phase::frame, .need = Need::litSkin, .inputs = {I::skinLayer, I::skinMix},
         .reads = {R::surface, R::lights},
         .readsIf = {R::tiles, R::thickness, R::lightMaps, R::visibility, R::environmentMaps, R::environmentSettings},
         .variants = {Need::lights}, .writes = {R::irradiance}, .record = irradianceRow, .forget = forgetIrradiance,
         .byGroup = true},
        {.name = "diffusion", .phase = Phase::frame, .need = Need::litSkin, .inputs = {I::profiles, I::chain},
         .reads = {R::surface, R::irradiance}, .writes = {R::levels}, .record = diffusionRow, .forget = forgetLevels,
         .amends = true, .byGroup = true},
        {.name = "wide_gaussians", .phase = Phase::frame, .need = Need::wideGaussians, .inputs = {},
         .reads = {R::surface, R::irradiance, R::levels, R::lightPatches}, .updates = {R::levels}, .writes = {},
         .record = wideGaussiansRow},
        {.name = "exitance", .phase = Phase::frame, .need = Need::litSkin, .inputs = {I::profiles, I::chain},
         .reads = {R::levels}, .readsIf = {R::thickness}, .writes = {R::exitance}, .record = exitanceRow,
         .forget = forgetExitance,
         .byGroup = true},
        {.name = "composite", .phase = Phase::frame, .need = Need::always, .inputs = {I::camera},
         .reads = {R::meshes, R::textures, R::materials, R::draws, R::ranges, R::lights, R::viewBuffers, R::target},
         .readsIf = {R::exitance, R::lightMaps, R::visibility, R::environmentMaps, R::environmentSettings, R::pores},
         .variants = {Need::detail}, .writes = {R::picture}, .record = compositeRow},
    };
}

}  // namespace

const std::vector<PassRow>& passTable() {
    static const std::vector<PassRow> table = [] {
        std::vector<PassRow> rows = rowsBeforeTheFrame();
        for (PassRow& row : rowsOfTheFrame()) rows.push_back(std::move(row));
        return rows;
    }();
    return table;
}

}  // namespace cutis
