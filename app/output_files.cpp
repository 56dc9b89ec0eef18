#include "app/output_files.h"

#include <unistd.h>

#include <set>

#include "app/usage_error.h"
#include "renderer/core/error.h"
#include "renderer/core/files.h"

namespace cutis::app {
namespace fs = std::filesystem;

fs::path aovFile(const fs::path& output, const std::string& name) {
    fs::path file = output;
    return file.replace_extension("." + name + ".exr");
}

std::vector<fs::path> filesToWrite(const Request& request, const std::string& command) {
    std::vector<fs::path> files = request.outputs;
    for (const std::string& name : request.settings.aovs)
        files.push_back(aovFile(request.outputs.front(), name));
    if (request.halves) {
        for (const char* half : {"a", "b", "a.diffuse", "b.diffuse"})
            files.push_back(aovFile(request.outputs.front(), half));
    }
    if (!request.stats.empty()) files.push_back(request.stats);
    std::set<fs::path> unique;
    for (const fs::path& file : files) {
        if (!unique.insert(file.lexically_normal()).second)
            throw UsageError("two results would be written to " + file.string(), command);
    }
    return files;
}

void checkWritable(const fs::path& file) {
    const fs::path place = placeToWrite(file);
    const fs::path folder = place.has_parent_path() ? place.parent_path() : fs::path(".");
    if (access(folder.c_str(), W_OK) != 0)
        throw Error("cannot write file", "the folder is not writable", folder.string());
}

void checkInputsSurvive(const Inputs& inputs, const std::vector<fs::path>& outputs) {
    for (const fs::path& output : outputs) {
        for (const fs::path& input : {inputs.scene.file, inputs.rigFile, inputs.environmentFile}) {
            std::error_code error;
            if (!input.empty() && fs::equivalent(input, output, error))
                throw Error("cannot write file", "it is an input of this picture", output.string());
        }
    }
}

void writePicture(const fs::path& output, const Picture& picture, double exposure) {
    if (output.extension() == ".png" || output.extension() == ".PNG") {
        writePng(output, picture, exposure);
    } else {
        writeExr(output, picture);
    }
}

}  // namespace cutis::app
