#include <algorithm>
#include <cmath>
#include <map>

#include "renderer/core/error.h"
#include "renderer/core/unique_names.h"
#include "renderer/scene/gltf_accessors.h"
#include "renderer/scene/gltf_parts.h"
#include "renderer/scene/pose.h"

namespace cutis::gltf {
namespace {

template <class Vector>
std::vector<float> flattened(const std::vector<Vector>& values) {
    std::vector<float> flat;
    flat.reserve(values.size() * Vector::length());
    for (const Vector& v : values) {
        for (int c = 0; c < Vector::length(); ++c) flat.push_back(v[c]);
    }
    return flat;
}

class AnimationReader {
  public:
    AnimationReader(Document& document, const NodeMap& nodes, Scene& scene)
        : document_(document), nodes_(nodes), scene_(scene) {}

    void run() {
        for (std::size_t i = 0; i < document_.count("animations"); ++i) addAnimation(i);
        for (const Animation& animation : scene_.animations) {
            for (const AnimationChannel& channel : animation.channels) {
                Node& node = scene_.nodes[channel.node];
                if (channel.property == AnimatedProperty::weights || node.rest) continue;
                node.rest = toTransform(node.local);
            }
        }
    }

  private:
    void addAnimation(std::size_t index) {
        const JsonView entry = document_.entry("animations", index);
        Animation animation;
        animation.name = entry.string("name");
        if (animation.name.empty()) animation.name = "animation " + std::to_string(index);
        animation.name = names_.take(animation.name);
        const JsonView samplers = entry.member("samplers");
        std::map<std::pair<std::size_t, std::size_t>, int> read;  // sampler of the file, components
        for (const JsonView& channel : entry.member("channels").elements()) {
            std::optional<AnimationChannel> added = readTarget(channel);
            if (!added) continue;
            const JsonView sampler = channel.member("sampler");
            const std::size_t number = sampler.index(samplers.size(), "samplers");
            const std::size_t components = componentsOf(*added);
            const auto [known, isNew] = read.try_emplace({number, components}, kNone);
            if (isNew) {
                auto curve = readSampler(samplers.element(number), added->property, components);
                if (curve) {
                    known->second = int(animation.samplers.size());
                    animation.duration = std::max(animation.duration, double(curve->times.back()));
                    animation.samplers.push_back(std::move(*curve));
                }
            }
            if (known->second == kNone) continue;  // unusable, as a warning has said
            added->sampler = known->second;
            animation.channels.push_back(*added);
        }
        scene_.animations.push_back(std::move(animation));
    }

    std::size_t componentsOf(const AnimationChannel& channel) const {
        if (channel.property == AnimatedProperty::weights) return scene_.nodes[channel.node].weights.size();
        return channel.property == AnimatedProperty::rotation ? 4 : 3;
    }

    // Nothing for what cannot be shown: other scenes' nodes, properties of extensions, weights of nothing.
    std::optional<AnimationChannel> readTarget(const JsonView& channel) {
        const JsonView target = channel.member("target");
        const auto reference = target.find("node");
        const std::string path = target.member("path").string();
        AnimationChannel read;
        if (path == "translation") {
            read.property = AnimatedProperty::translation;
        } else if (path == "rotation") {
            read.property = AnimatedProperty::rotation;
        } else if (path == "scale") {
            read.property = AnimatedProperty::scale;
        } else if (path == "weights") {
            read.property = AnimatedProperty::weights;
        } else {
            warn("an animation of \"" + path + "\" is left out, " + channel.where());
            return std::nullopt;
        }
        if (!reference) return std::nullopt;
        read.node = nodes_.sceneNode[reference->index(nodes_.sceneNode.size(), "nodes")];
        if (read.node == kNone) return std::nullopt;
        if (read.property == AnimatedProperty::weights && scene_.nodes[read.node].weights.empty()) {
            warn("an animation of a mesh without morph targets is left out, " + channel.where());
            return std::nullopt;
        }
        return read;
    }

    std::optional<AnimationSampler> readSampler(const JsonView& entry, AnimatedProperty property,
                                                std::size_t components) {
        AnimationSampler sampler;
        const std::string name = entry.string("interpolation", "LINEAR");
        if (name == "CUBICSPLINE") {
            sampler.interpolation = Interpolation::cubicSpline;
        } else if (name == "STEP") {
            sampler.interpolation = Interpolation::step;
        } else if (name != "LINEAR") {
            entry.member("interpolation").fail("there is no interpolation \"" + name + "\"");
        }
        sampler.components = components;
        sampler.times = readScalars(document_, entry.member("input"));
        const JsonView output = entry.member("output");
        sampler.values = property == AnimatedProperty::weights    ? readScalars(document_, output)
                         : property == AnimatedProperty::rotation ? flattened(readVec4(document_, output))
                                                                  : flattened(readVec3(document_, output));
        const std::size_t rows = sampler.interpolation == Interpolation::cubicSpline ? 3 : 1;
        if (sampler.values.size() / components / rows < sampler.times.size()) {
            output.fail("it has " + std::to_string(sampler.values.size()) + " numbers for " +
                        std::to_string(sampler.times.size()) + " keys of " +
                        std::to_string(rows * components));
        }
        sampler.values.resize(sampler.times.size() * rows * components);
        const auto finite = [](float v) { return std::isfinite(v); };
        if (!std::ranges::all_of(sampler.times, finite) || !std::ranges::is_sorted(sampler.times)) {
            warn("an animation whose times do not increase is left out, " + entry.member("input").where());
            return std::nullopt;
        }
        if (!std::ranges::all_of(sampler.values, finite)) {
            warn("an animation with NaN or infinite values is left out, " + output.where());
            return std::nullopt;
        }
        return sampler;
    }

    Document& document_;
    const NodeMap& nodes_;
    Scene& scene_;
    UniqueNames names_;
};

}  // namespace

void readAnimations(Document& document, const NodeMap& nodes, Scene& scene) {
    AnimationReader(document, nodes, scene).run();
}

}  // namespace cutis::gltf
