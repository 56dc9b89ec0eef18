// Scene, rig, environment and camera, as the options choose them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/options.h"
#include "renderer/scene/scene.h"

namespace cutis::app {

// What a picture is made of. The rig is complete: chosen, its lights selected, its placements resolved.
struct Inputs {
    Scene scene;
    Rig rig;
    std::filesystem::path rigFile;  // empty: a preset, the scene's own, or none
    std::filesystem::path environmentFile;
    std::optional<Environment> environment;
    Camera camera;
    int animation = -1;              // index into Scene::animations; -1: the scene rests
    std::uint64_t poseRevision = 0;  // how often setTime has posed the scene
};

// Loads what the request names:
//  - operand 0 is the scene; `default` is data/default/default.gltf of CUTIS_DATA_DIR;
//  - the rig is --rig, else the scene's own lights if it has any, else STEM.rig.json beside the scene's
//  STEM.gltf, else
//    the preset three-point; --light keeps some of its lights;
//  - the pose is that of --animation at --time or at the first of --frames, else the scene's at rest;
//  - the environment is --env, else the rig's, whose file name is relative to the rig file.
// Throws Error.
Inputs loadInputs(const Request& request);

// Puts scene, camera and lights into the pose of another time of the animation. Lights that were placed round a subject and
// cameras that were framed on one stay where they were; those of the file move with their nodes. Throws Error.
void setTime(Inputs& inputs, const Request& request, double seconds);

// A rig file or a preset. Throws Error.
struct NamedRig {
    Rig rig;
    std::filesystem::path file;  // empty for a preset
};
NamedRig loadNamedRig(const std::string& name);

// Where the rig's environment lies; empty when it has none or it is off.
std::filesystem::path environmentFileOf(const Rig& rig, const std::filesystem::path& rigFile);

// Where set-up puts the default scene (default/) and environments (hdri/).
std::filesystem::path dataFolder();

// The scene file that an operand means. Throws Error when there is no default scene.
std::filesystem::path sceneFile(const std::string& operand);

}  // namespace cutis::app
