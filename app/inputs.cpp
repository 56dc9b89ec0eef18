#include "app/inputs.h"

#include <algorithm>
#include <cstdlib>
#include <future>
#include <optional>

#include "app/frame_files.h"
#include "renderer/core/error.h"
#include "renderer/core/timeline.h"
#include "renderer/core/suggest.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/environment.h"
#include "renderer/scene/environment_sun.h"
#include "renderer/scene/gltf.h"
#include "renderer/scene/pose.h"
#include "renderer/scene/presets.h"
#include "renderer/scene/rig.h"

namespace cutis::app {
namespace fs = std::filesystem;
namespace {

const char* const kDefaultScene = "default";
const char* const kDefaultPreset = "three-point";

// Nothing where it takes the scene to say.
std::optional<NamedRig> rigByName(const Request& request) {
    if (!request.rig || request.rig == "scene") return {};
    return request.rig == "none" ? NamedRig{} : loadNamedRig(*request.rig);
}

NamedRig rigForScene(const Request& request, const Scene& scene, const fs::path& file) {
    if (request.rig == "scene") {
        if (scene.lights.empty())
            throw Error("cannot use --rig scene", "the scene has no lights", file.string());
        return {rigFromScene(scene), {}};
    }
    if (!scene.lights.empty()) return {rigFromScene(scene), {}};
    fs::path beside = file;
    beside.replace_extension(".rig.json");
    std::error_code error;
    if (fs::is_regular_file(beside, error)) return {loadRig(beside), beside};
    return {presetRig(kDefaultPreset), {}};
}

// Keeps the lights of those names, switched on.
void selectLights(Rig& rig, const std::vector<std::string>& names) {
    if (names.empty()) return;
    std::vector<std::string> all;
    std::string list;
    for (const Light& light : rig.lights) {
        all.push_back(light.name);
        list += (list.empty() ? "" : ", ") + light.name;
    }
    for (const std::string& name : names) {
        if (std::find(all.begin(), all.end(), name) == all.end()) {
            const std::string there = list.empty() ? "the rig has no lights" : "the rig has " + list;
            throw Error("no light '" + name + "'" + didYouMean(name, all), there, "--light");
        }
    }
    std::erase_if(rig.lights, [&](const Light& light) {
        return std::find(names.begin(), names.end(), light.name) == names.end();
    });
    for (Light& light : rig.lights) light.enabled = true;
}

bool takesLightsOfScene(const Request& request, const Scene& scene) {
    return request.rig ? request.rig == "scene" : !scene.lights.empty();
}

bool takesCameraOfScene(const Request& request, const Scene& scene) {
    const std::string& camera = request.camera;
    if (camera.empty()) return !scene.cameras.empty();
    return camera != "auto" && !camera.starts_with("auto:") && !camera.starts_with("orbit:");
}

double aspectOf(const Request& request) {
    return double(request.settings.width) / request.settings.height;
}

// The animation that is asked for; without a name the first, where a time is.
int chooseAnimation(const Request& request, const Scene& scene) {
    if (request.animation) return findAnimation(scene, *request.animation);
    if (!request.time && !request.frames) return kAtRest;
    if (scene.animations.empty()) {
        throw Error(request.time ? "cannot use --time" : "cannot use --frames", "the scene has no animation",
                    scene.file.string());
    }
    return 0;
}

// A file that is read beside others.
class EnvironmentReader {
  public:
    // Begins, unless the name is empty.
    explicit EnvironmentReader(const fs::path& file) : file_(file) {
        if (!file.empty()) reading_ = std::async(std::launch::async, read, file);
    }
    // Of that file, or another. Throws Error.
    Environment take(const fs::path& file) {
        return reading_.valid() && file == file_ ? reading_.get() : read(file);
    }

  private:
    static Environment read(const fs::path& file) {
        const TimeSpan span("environment");
        return loadEnvironment(file);
    }
    fs::path file_;
    std::future<Environment> reading_;
};

// As far as it is known before the scene is.
fs::path environmentFileBeforeScene(const Request& request, const std::optional<NamedRig>& rig) {
    if (request.environment) return *request.environment == "none" ? fs::path() : fs::path(*request.environment);
    return rig ? environmentFileOf(rig->rig, rig->file) : fs::path();
}

void chooseEnvironment(const Request& request, EnvironmentReader& reader, Inputs& inputs) {
    EnvironmentSettings& settings = inputs.rig.environment;
    if (request.environment == "none") {
        settings = {};
        return;
    }
    if (request.environment) {
        settings.file = *request.environment;
        settings.enabled = true;
        settings.sunRemoved = false;  // it was of the rig's own
    }
    settings.intensity = request.environmentIntensity.value_or(settings.intensity);
    settings.rotation = request.environmentRotation.value_or(settings.rotation);
    inputs.environmentFile =
        request.environment ? fs::path(settings.file) : environmentFileOf(inputs.rig, inputs.rigFile);
    if (!inputs.environmentFile.empty()) {
        inputs.environment = reader.take(inputs.environmentFile);
        if (settings.sunRemoved) removeSun(*inputs.environment);
    } else if (request.environmentIntensity || request.environmentRotation) {
        warn("--env-intensity and --env-rotation have no effect: there is no environment");
    }
}

}  // namespace

fs::path dataFolder() {
    const char* folder = std::getenv("CUTIS_DATA_DIR");
    return folder && *folder ? folder : CUTIS_DATA_DIR;
}

fs::path sceneFile(const std::string& operand) {
    if (operand != kDefaultScene) return operand;
    const fs::path file = dataFolder() / "default" / "default.gltf";
    std::error_code error;
    if (!fs::is_regular_file(file, error))
        throw Error("no default scene", "tools/demo installs it", file.string());
    return file;
}

NamedRig loadNamedRig(const std::string& name) {
    if (isPreset(name)) return {presetRig(name), {}};
    const fs::path file = name;
    // A word that is no path is a mistyped preset: presetRig lists them.
    std::error_code error;
    if (!file.has_extension() && !file.has_parent_path() && !fs::exists(file, error))
        return {presetRig(name), {}};
    return {loadRig(file), file};
}

fs::path environmentFileOf(const Rig& rig, const fs::path& rigFile) {
    if (!rig.environment.enabled || rig.environment.file.empty()) return {};
    return rigFile.parent_path() / rig.environment.file;  // an absolute name stays what it is
}

Inputs loadInputs(const Request& request) {
    Inputs inputs;
    const fs::path file = sceneFile(request.operands.at(0));
    std::optional<NamedRig> named = rigByName(request);
    EnvironmentReader environment(environmentFileBeforeScene(request, named));
    {
        const TimeSpan span("scene");
        inputs.scene = loadGltf(file, {.skin = request.skin});
    }
    inputs.animation = chooseAnimation(request, inputs.scene);
    if (inputs.animation != kAtRest) {
        const double begin = request.frames ? timeOfFrame(request, request.frames->first) : request.time.value_or(0);
        poseScene(inputs.scene, inputs.animation, begin);
    }
    if (!named) named = rigForScene(request, inputs.scene, file);
    inputs.rig = std::move(named->rig);
    inputs.rigFile = std::move(named->file);
    selectLights(inputs.rig, request.lights);
    resolvePlacements(inputs.rig, inputs.scene);
    chooseEnvironment(request, environment, inputs);
    inputs.camera = cameraFor(inputs.scene, request.camera, aspectOf(request));
    return inputs;
}

void setTime(Inputs& inputs, const Request& request, double seconds) {
    poseScene(inputs.scene, inputs.animation, seconds);
    ++inputs.poseRevision;
    if (takesLightsOfScene(request, inputs.scene)) {
        Rig moved = rigFromScene(inputs.scene);
        selectLights(moved, request.lights);
        inputs.rig.lights = std::move(moved.lights);
    }
    if (takesCameraOfScene(request, inputs.scene))
        inputs.camera = cameraFor(inputs.scene, request.camera, aspectOf(request));
}

}  // namespace cutis::app
