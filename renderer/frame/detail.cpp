#include "renderer/frame/detail.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "renderer/frame/camera.h"
#include "renderer/frame/frame.h"
#include "renderer/passes/light_views.h"
#include "renderer/skin/detail.h"

namespace cutis {
namespace {

// Light maps are as fine as the picture asks (a texel is one to two pixels), whatever their number: a light
// casts the same shadow alone and among many. Only beyond this much memory do they become coarser.
constexpr std::uint64_t kLightMapBytes = std::uint64_t(2) << 30;
constexpr int kLargestLightMap = 4096, kFinestUsefulLightMap = 1024, kSmallestLightMap = 128;

// Texels a little finer than the pixels where the character stands; never finer than the narrowest blur of skin. In
// small pictures the rims of ears and the edges of lids ask for more: where texels are wider, light of one side
// reaches the other (docs/measure.md). A character that the picture does not show needs hardly any.
double wantedMmPerTexel(double mmPerPixel, bool inView) {
    constexpr double kFinest = 0.08, kRims = 1, kOutOfView = 10;
    if (!inView) return kOutOfView;
    return std::clamp(0.9 * mmPerPixel, kFinest, std::max(kRims, 0.6 * mmPerPixel));
}

// Of each character's skin; the finest where it has several.
std::vector<double> mmPerUnitOf(const Scene& scene, const Geometry& geometry) {
    std::vector<double> mmPerUnit(scene.characters.size(), 0);
    for (const GeometryDraw& draw : geometry.draws) {
        if (!draw.skin) continue;
        double& mm = mmPerUnit[draw.character];
        const double own = scene.materials[draw.material].skin->mmPerUnit;
        mm = mm == 0 ? own : std::min(mm, own);
    }
    return mmPerUnit;
}

bool near(double kept, double wanted) {
    return kept > 0 && kept <= wanted * kDetailSlack && wanted <= kept * kDetailSlack;
}

Detail detailWanted(const FrameContext& frame) {
    const RenderSettings& settings = *frame.settings;
    const ViewCameraMetrics metrics(frame.input->camera, {settings.width, settings.height});
    const std::vector<double> mmPerUnit = mmPerUnitOf(*frame.input->scene, frame.geometry);
    Detail wanted;
    for (std::size_t c = 0; c < mmPerUnit.size(); ++c) {
        const Character& character = frame.input->scene->characters[c];
        const glm::dvec3 centre = character.bounds.centre();
        const glm::vec3 low(character.bounds.min - frame.geometry.origin),
            high(character.bounds.max - frame.geometry.origin);
        const bool inView = frame.anyView || reaches(frame.camera.worldToClip, low, high);
        const double metres =
            (frame.anyView ? metrics.metresPerPixelAtDistance(centre) : metrics.metresPerPixel(centre)) /
            settings.detail;
        wanted.mmPerTexel.push_back(wantedMmPerTexel(metres * mmPerUnit[c], inView));
        if (inView)
            wanted.pixelsAcross =
                std::max(wanted.pixelsAcross, glm::length(character.bounds.size()) / metres);
    }
    return wanted;
}

}  // namespace

void anticipateDetail(FrameContext& frame) {
    const Detail wanted = detailWanted(frame);
    Detail& kept = frame.detail;
    if (!kept.anticipated) kept = wanted;
    kept.anticipated = true;
    kept.pixelsAcross = std::max(kept.pixelsAcross, wanted.pixelsAcross);
    for (std::size_t i = 0; i < kept.mmPerTexel.size(); ++i) {
        kept.mmPerTexel[i] = std::min(kept.mmPerTexel[i], wanted.mmPerTexel[i]);
    }
}

void chooseDetail(FrameContext& frame) {
    Detail& kept = frame.detail;
    if (kept.anticipated) return;
    const Detail wanted = detailWanted(frame);
    const bool layoutStands =
        frame.anyView && kept.mmPerTexel.size() == wanted.mmPerTexel.size() &&
        std::equal(kept.mmPerTexel.begin(), kept.mmPerTexel.end(), wanted.mmPerTexel.begin(), near);
    if (!layoutStands) kept.mmPerTexel = wanted.mmPerTexel;
    if (!frame.anyView || !near(kept.pixelsAcross, wanted.pixelsAcross))
        kept.pixelsAcross = wanted.pixelsAcross;
}

bool resolvesPores(const FrameContext& frame) {
    const glm::ivec2 pixels(frame.settings->width, frame.settings->height);
    const ViewCameraMetrics metrics(frame.input->camera, pixels);
    for (const GeometryDraw& draw : frame.geometry.draws) {
        if (!draw.skin) continue;
        const SkinMaterial& skin = *frame.input->scene->materials[draw.material].skin;
        const glm::vec3 low(draw.bounds.min - frame.geometry.origin), high(draw.bounds.max - frame.geometry.origin);
        if (!(skin.specular > 0 && skin.detail > 0) || !reaches(frame.camera.worldToClip, low, high)) continue;
        const double widest = skin::kDetailWidest * skin.detailScale / skin.mmPerUnit;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::bvec3 upper(corner & 1, corner & 2, corner & 4);
            if (metrics.metresPerPixel(glm::mix(draw.bounds.min, draw.bounds.max, upper)) < widest) return true;
        }
    }
    return false;
}

void chooseLightMapSize(FrameContext& frame, std::size_t maps) {
    if (frame.settings->lightMapSize > 0) {
        frame.detail.lightMapSize = frame.settings->lightMapSize;
        return;
    }
    const std::uint64_t texelBytes = frame.needs[Need::translucency] ? 8 : 4;
    const auto wanted =
        static_cast<unsigned>(std::clamp<double>(frame.detail.pixelsAcross, 1, kLargestLightMap));
    int size =
        std::clamp(static_cast<int>(std::bit_ceil(wanted)) / 2, kFinestUsefulLightMap, kLargestLightMap);
    while (size > kSmallestLightMap && maps * texelBytes * size * size > kLightMapBytes) size /= 2;
    frame.detail.lightMapSize = size;
}

}  // namespace cutis
