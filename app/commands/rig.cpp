// cutis rig: presets, rig files, and rigs as glTF lights.
#include "renderer/scene/rig.h"

#include <algorithm>
#include <cstdio>

#include "app/command.h"
#include "app/inputs.h"
#include "renderer/core/error.h"
#include "renderer/scene/environment.h"
#include "renderer/scene/gltf.h"
#include "renderer/scene/gltf_writer.h"
#include "renderer/scene/presets.h"

namespace cutis::app {
namespace fs = std::filesystem;
namespace {

Scene loadGeometry(const fs::path& file) {
    return loadGltf(file, {.skin = {}, .images = false});
}

bool isGltf(const fs::path& file) {
    return file.extension() == ".glb" || file.extension() == ".gltf";
}

// The operand of `export`: a scene's lights, or a rig.
Rig loadSource(const std::string& operand) {
    if (!isGltf(sceneFile(operand))) return loadNamedRig(operand).rig;
    Rig rig = rigFromScene(loadGeometry(sceneFile(operand)));
    if (rig.lights.empty()) throw Error("nothing to export", "the scene has no lights", operand);
    return rig;
}

}  // namespace

int runRigList(const Request&) {
    for (const Preset& preset : presets())
        std::printf("%-12s  %s\n", preset.name.c_str(), preset.summary.c_str());
    return 0;
}

int runRigShow(const Request& request) {
    std::fputs(rigToJson(loadNamedRig(request.operands[0]).rig).c_str(), stdout);
    return 0;
}

int runRigCheck(const Request& request) {
    NamedRig named = loadNamedRig(request.operands[0]);
    const fs::path environment = environmentFileOf(named.rig, named.file);
    if (!environment.empty()) loadEnvironment(environment);
    if (!request.scene.empty()) resolvePlacements(named.rig, loadGeometry(sceneFile(request.scene.string())));
    const auto enabled = std::count_if(named.rig.lights.begin(), named.rig.lights.end(),
                                       [](const Light& light) { return light.enabled; });
    std::printf("%s: a rig of %zu lights, %td of them on%s\n", request.operands[0].c_str(),
                named.rig.lights.size(), enabled, environment.empty() ? "" : ", and an environment");
    return 0;
}

int runRigExport(const Request& request) {
    Rig rig = loadSource(request.operands[0]);
    if (!request.scene.empty()) resolvePlacements(rig, loadGeometry(sceneFile(request.scene.string())));
    const fs::path& output = request.outputs.front();
    if (!isGltf(output)) {
        saveRig(rig, output);
        return 0;
    }
    const auto placed = std::find_if(rig.lights.begin(), rig.lights.end(),
                                     [](const Light& light) { return light.enabled && light.place; });
    if (request.scene.empty() && placed != rig.lights.end()) {
        throw Error("cannot export rig",
                    "light '" + placed->name + "' is placed by a head: --scene SCENE says which",
                    request.operands[0]);
    }
    writeGlb(sceneFromRig(rig), output);
    return 0;
}

}  // namespace cutis::app
