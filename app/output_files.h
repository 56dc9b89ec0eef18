// Where the results of a picture go, and whether they can.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/inputs.h"
#include "app/options.h"
#include "renderer/scene/picture.h"

namespace cutis::app {

// OUT.NAME.exr beside OUT.exr or OUT.png.
std::filesystem::path aovFile(const std::filesystem::path& output, const std::string& name);

// Everything that the request makes `command` write. Throws UsageError when two results would be one file.
std::vector<std::filesystem::path> filesToWrite(const Request& request, const std::string& command);

// Before minutes of work, not after: can this be written at all? Throws Error.
void checkWritable(const std::filesystem::path& file);

// No output may replace what the picture is made from. Throws Error.
void checkInputsSurvive(const Inputs& inputs, const std::vector<std::filesystem::path>& outputs);

// By its extension: .png exposed and tone mapped, .exr as it is. Throws Error.
void writePicture(const std::filesystem::path& output, const Picture& picture, double exposure);

}  // namespace cutis::app
