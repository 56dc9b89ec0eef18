#include "renderer/frame/changed_groups.h"

#include <iterator>

#include "renderer/core/hash.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/lighting.h"
#include "renderer/passes/light_views.h"

namespace cutis {
namespace {

void addView(ContentHash& hash, const shared::LightView& view, const Geometry& geometry) {
    hash.add(view.worldToClip, view.depthToDistance, view.texelSize, contentOf(view, geometry));
}

std::vector<std::uint64_t> lightOf(const FrameContext& frame) {
    const Geometry& geometry = frame.geometry;
    std::vector<ContentHash> hashes(frame.groups.size());
    for (std::size_t d = 0; d < geometry.draws.size(); ++d) {
        hashes[geometry.drawInfos[d].receiverGroup].add(d, geometry.draws[d].pose);
    }
    if (frame.needs[Need::shadows]) {
        const std::vector<shared::LightView> views =
            computeLightViews(shadowedSamples(frame), frame.groups, geometry.casters, geometry.origin,
                              frame.detail.lightMapSize);
        for (std::size_t v = 0; v < views.size(); ++v) addView(hashes[v % frame.groups.size()], views[v], geometry);
    }
    if (frame.needs[Need::environment]) {
        for (std::size_t g = 0; g < frame.groups.size(); ++g) {
            for (const VisibilityDirection& part : frame.sky.parts) {
                const glm::dvec3 towards(rotateAboutY(part.direction, frame.input->rig.environment.rotation));
                addView(hashes[g],
                        directionalView(-towards, frame.groups[g], geometry.casters, geometry.origin, kVisibilityMapSize),
                        geometry);
            }
        }
    }
    std::vector<std::uint64_t> values;
    for (const ContentHash& hash : hashes) values.push_back(hash.value());
    return values;
}

}  // namespace

std::uint64_t contentOf(const shared::LightView& view, const Geometry& geometry) {
    ContentHash content;
    for (const GeometryDraw& draw : geometry.draws) {
        const glm::vec3 low(draw.bounds.min - geometry.origin), high(draw.bounds.max - geometry.origin);
        if (reaches(view.worldToClip, low, high)) content.add(draw.firstIndex, draw.pose);
    }
    return content.value();
}

std::vector<bool> ChangedGroups::find(const FrameContext& frame, const InputHashes& inputs) {
    asked_ = {};
    // In one picture alone, and in a scene that stands still, there is nothing to compare with.
    if (!frame.anyView || !frame.needs[Need::motion]) return {};
    asked_ = {inputs, std::vector<bool>(std::begin(frame.needs.met), std::end(frame.needs.met)), lightOf(frame)};
    // What nothing that is lit depends on.
    for (const Input input : {Input::pose, Input::camera}) asked_.inputs[static_cast<std::size_t>(input)] = 0;
    std::vector<bool> changed;
    if (asked_.inputs == drawn_.inputs && asked_.needs == drawn_.needs && asked_.groups.size() == drawn_.groups.size()) {
        for (std::size_t g = 0; g < asked_.groups.size(); ++g) changed.push_back(asked_.groups[g] != drawn_.groups[g]);
    }
    return changed;
}

}  // namespace cutis
