// cutis skin: which materials are skin, written back into the glTF file.
#include "app/command.h"
#include "app/inputs.h"
#include "renderer/scene/gltf.h"
#include "renderer/scene/skin_writer.h"

namespace cutis::app {

int runSkinExport(const Request& request) {
    const Scene scene = loadGltf(sceneFile(request.operands[0]), {.skin = request.skin, .images = false});
    writeSkinExtras(scene, request.outputs.front());
    return 0;
}

}  // namespace cutis::app
