// cutis view: the window.
#include <filesystem>

#include "app/command.h"
#include "app/inputs.h"
#include "app/viewer/viewer.h"
#include "renderer/core/error.h"
#include "renderer/gpu/device.h"

namespace cutis::app {

int runView(const Request& given) {
    Request request = given;
    if (request.operands.empty()) request.operands = {"default"};
    // What can be seen at once is said before a window opens; the rest is said in it.
    const std::filesystem::path file = sceneFile(request.operands[0]);
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        throw Error("cannot read file", "no such file", file.string());
    runViewer(request);
    if (const std::uint64_t messages = gpu::validationMessages())
        throw Error("validation failed", std::to_string(messages) + " messages from the validation layers");
    return 0;
}

}  // namespace cutis::app
