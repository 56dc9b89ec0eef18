#include "renderer/passes/light_maps.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <string>

#include "renderer/core/hash.h"
#include "renderer/gpu/device.h"
#include "renderer/passes/light_views.h"

namespace cutis {
namespace {

struct MapPush {
    std::uint32_t view;
    float texelsToUnit;
    std::uint32_t material;
    std::uint32_t seed;
};

// Which triangles are drawn: those that face the light, or those that face away from it.
enum class Sides { both, near, far };

// Draw calls of one kind: skin that takes light in, whatever else stops it, or one masked material.
struct Batch {
    bool skin = false, masked = false;
    Sides sides = Sides::both;
    std::uint32_t material = 0, alphaGroup = 0;  // of a masked batch
    std::vector<gpu::DrawCall> calls;
};

// Whether the light of a view stands within a range's bounds.
bool standsWithin(const DrawRange& range, const shared::LightView& view) {
    // Where a perspective projection has no depth: its eye. Of a parallel one that is a direction.
    const glm::vec4 eye = glm::inverse(view.worldToClip) * glm::vec4(0, 0, 1, 0);
    if (std::abs(eye.w) < 1e-12f * glm::length(glm::vec3(eye))) return false;
    const glm::vec3 place = glm::vec3(eye) / eye.w;
    return glm::all(glm::greaterThanEqual(place, range.boundsMin)) &&
           glm::all(glm::lessThanEqual(place, range.boundsMax));
}

Sides sidesOf(const DrawRange& range, const LightMapTargets& targets, const shared::LightView& view) {
    if (targets.proxies) return range.closed ? Sides::far : Sides::both;
    // Light meets the near side of a sealed body first. Where the body has no thickness at that place, both
    // lie at one depth, and only the near one takes light in.
    return range.sealed && !standsWithin(range, view) ? Sides::near : Sides::both;
}

// What reaches the view. Neighbouring ranges of one kind become one call.
std::vector<Batch> batchesFor(const SceneBuffers& scene, const LightMapTargets& targets,
                              const shared::LightView& view) {
    std::vector<Batch> batches;
    for (const DrawRange& range : scene.ranges) {
        if (range.clear || !reaches(view.worldToClip, range.boundsMin, range.boundsMax)) continue;
        const bool skin = targets.entry && range.skin;
        const std::uint32_t first = targets.proxies ? range.firstProxyIndex : range.firstIndex;
        const std::uint32_t count = targets.proxies ? range.proxyIndexCount : range.indexCount;
        if (count == 0) continue;
        const Sides sides = sidesOf(range, targets, view);
        Batch* batch = nullptr;
        for (Batch& known : batches) {
            if (known.skin == skin && known.masked == range.masked && known.sides == sides &&
                (!range.masked || known.material == range.material)) {
                batch = &known;
            }
        }
        if (!batch) {
            batch =
                &batches.emplace_back(Batch{skin, range.masked, sides, range.material, range.alphaGroup, {}});
        }
        std::vector<gpu::DrawCall>& calls = batch->calls;
        if (!calls.empty() && calls.back().first + calls.back().count == first) {
            calls.back().count += count;
        } else {
            calls.push_back({.first = first, .count = count});
        }
    }
    return batches;
}

void drawBatch(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
               const LightMapTargets& targets, gpu::RasterState state, std::uint32_t view,
               const Batch& batch) {
    if (batch.sides != Sides::both) {
        // Light views hold +Y at the bottom of the map: triangles turn the other way there.
        state.frontFace = VK_FRONT_FACE_CLOCKWISE;
        state.cull = batch.sides == Sides::far ? VK_CULL_MODE_FRONT_BIT : VK_CULL_MODE_BACK_BIT;
    }
    std::string vertex = "light_map.vert", fragment = "light_map.frag";
    gpu::Bindings bindings{{"PositionBuffer", scene.positions}, {"LightViewBuffer", *targets.viewBuffer}};
    if (targets.entry) fragment += "+ENTRY";
    if (batch.skin) {
        vertex += "+SKIN";
        fragment += "+SKIN";
        bindings.push_back({"AtlasVertexBuffer", scene.atlasVertices});
    }
    if (batch.masked) {
        vertex += "+MASKED";
        fragment += "+MASKED";
        bindings.push_back({"AttributeBuffer", scene.attributes});
        bindings.push_back({"MaterialBuffer", scene.materials});
    }
    gpu::Specialization constants;
    if (batch.masked && scene.textured()) {
        fragment += "+TEXTURED";
        bindings.push_back({"materialTextures", scene.materialTextures});
        constants = {{0, scene.textureGroups}, {2, batch.alphaGroup}};
    }
    std::vector<std::string> shaders{vertex};
    if (targets.entry || batch.masked) shaders.push_back(fragment);
    commands.draw(
        device.program(shaders, state, constants), bindings,
        MapPush{view, 1.0f / static_cast<float>(std::max(targets.atlasSize, 1)), batch.material,
                static_cast<std::uint32_t>(ContentHash().add(targets.views[view].worldToClip).value())},
        batch.calls, targets.proxies ? &scene.proxyIndices : &scene.indices);
}

}  // namespace

void recordLightMaps(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                     const LightMapTargets& targets) {
    const bool translucent = targets.entry != nullptr;
    gpu::RasterState state;
    state.depthFormat = targets.depth->desc().format;
    state.depthClamp = true;
    if (translucent) state.colorFormats = {VK_FORMAT_R32_UINT};
    for (std::uint32_t v = targets.firstView; v < targets.firstView + targets.viewCount; ++v) {
        const shared::LightView& view = targets.views[v];
        gpu::RenderTargets render;
        render.depth = {targets.depth->layer(view.layer), gpu::ClearValue::depth(1)};
        if (translucent)
            render.colors = {{targets.entry->layer(view.layer), gpu::ClearValue::integers(0xffffffffu)}};
        commands.beginRendering(render);
        for (const Batch& batch : batchesFor(scene, targets, view)) {
            drawBatch(device, commands, scene, targets, state, v, batch);
        }
        commands.endRendering();
    }
}

}  // namespace cutis
