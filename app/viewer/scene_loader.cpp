#include "app/viewer/scene_loader.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <utility>

#include "app/inputs.h"
#include "renderer/core/error.h"
#include "renderer/core/suggest.h"
#include "renderer/gpu/device.h"
#include "renderer/scene/characters.h"
#include "renderer/scene/gltf.h"

namespace cutis::app {
namespace {

// --light in the viewer is solo: the rig keeps its other lights, so that saving it does not lose them.
void soloLights(Document& document, const std::vector<std::string>& names) {
    std::vector<std::string> all;
    for (const Light& light : document.rig.lights) all.push_back(light.name);
    for (const std::string& name : names) {
        const auto found = std::find(all.begin(), all.end(), name);
        if (found == all.end())
            throw Error("no light '" + name + "'" + didYouMean(name, all), "the rig has no such light",
                        "--light");
        document.solo[static_cast<std::size_t>(found - all.begin())] = true;
    }
}

// Textures are most of a scene, and the interface needs none of them.
Scene withoutTexels(const Scene& scene) {
    Scene bare;
    bare.name = scene.name;
    bare.file = scene.file;
    bare.materials = scene.materials;
    bare.meshes = scene.meshes;
    bare.nodes = scene.nodes;
    bare.cameras = scene.cameras;
    bare.lights = scene.lights;
    bare.skins = scene.skins;
    bare.animations = scene.animations;
    bare.characters = scene.characters;
    bare.nodeCharacter = scene.nodeCharacter;
    bare.bounds = scene.bounds;
    return bare;
}

// A camera of the file, or one that is framed on the heads, stays what it is until it is moved by hand: it is
// made anew for each size of the view.
View viewOf(const Request& request, const Inputs& inputs) {
    const Bounds head = headBounds(inputs.scene, "*");
    View view;
    view.orbit = fromCamera(inputs.camera, head.empty() ? glm::dvec3(0) : head.centre());
    if (!request.camera.empty()) {
        if (!request.camera.starts_with("orbit:")) view.camera = request.camera;
    } else {
        view.camera = inputs.scene.cameras.empty() ? "auto" : "0";
    }
    return view;
}

// What is known of errors on the device that renders. That a measurement cannot be read is no reason not to
// open the scene.
KnownFront frontOf(const Request& request, const Inputs& inputs) {
    try {
        if (anyMeasurement()) return knownFront(inputs, gpu::chosenDevice(request.device));
    } catch (const Error& error) {
        warn(error.what());
    }
    return {defaultFront(), false};
}

LoadedScene load(Request request) {
    LoadedScene loaded;
    loaded.name = request.operands.at(0);
    const std::vector<std::string> solo = std::exchange(request.lights, {});
    Inputs inputs = loadInputs(request);
    loaded.known = frontOf(request, inputs);
    Document& document = loaded.document;
    document.scene = loaded.name;
    const bool environment = !inputs.environmentFile.empty();
    replaceRig(document, std::move(inputs.rig), inputs.rigFile);
    document.rig.exposure += request.exposure;
    if (environment)
        document.rig.environment.file =
            std::filesystem::absolute(inputs.environmentFile).lexically_normal().string();
    soloLights(document, solo);
    document.skin = skinOf(inputs.scene);
    document.view = viewOf(request, inputs);
    document.background = request.background;
    document.quality = {.tolerance = 0,
                        .irradianceSize = request.settings.irradianceSize,
                        .gaussians = request.settings.gaussians,
                        .merge = request.settings.merge,
                        .chain = request.settings.chain,
                        .taps = request.settings.taps};
    loaded.geometry = std::make_shared<Scene>(withoutTexels(inputs.scene));
    if (!inputs.scene.animations.empty()) loaded.spare = std::make_shared<Scene>(*loaded.geometry);
    if (inputs.animation != kAtRest) loaded.pose = {inputs.animation, request.time.value_or(0)};
    loaded.scene = std::make_shared<Scene>(std::move(inputs.scene));
    return loaded;
}

LoadedScene loadOrExplain(const Request& request) {
    try {
        return load(request);
    } catch (const std::bad_alloc&) {
        LoadedScene failed;
        failed.error = "out of memory: the scene is too large for this machine";
        return failed;
    } catch (const std::exception& problem) {
        LoadedScene failed;
        failed.error = problem.what();
        return failed;
    }
}

}  // namespace

void SceneLoader::start(const Request& request, bool opens) {
    name_ = request.operands.at(0);
    begun_ = std::chrono::steady_clock::now();
    if (pending_.valid()) {
        next_ = {request, opens};
        return;
    }
    pending_ = std::async(std::launch::async, [request, opens, wake = wake_] {
        LoadedScene loaded = loadOrExplain(request);
        loaded.name = request.operands.at(0);
        loaded.opens = opens;
        wake();
        return loaded;
    });
}

double SceneLoader::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
}

std::optional<LoadedScene> SceneLoader::take() {
    if (!pending_.valid()) return std::exchange(before_, std::nullopt);
    if (pending_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
    LoadedScene loaded = pending_.get();
    if (next_) {
        if (loaded.error.empty()) before_ = std::move(loaded);
        const Wanted wanted = *std::exchange(next_, std::nullopt);
        start(wanted.request, wanted.opens);
        return std::nullopt;
    }
    if (loaded.error.empty()) before_.reset();
    return loaded;
}

}  // namespace cutis::app
