// Names of the files of a range of frames.
#pragma once

#include <filesystem>

#include "app/options.h"

namespace cutis::app {

inline constexpr double kDefaultFps = 24;  // frames a second, where --fps says nothing

// Whether the file's name holds one place for a number: %d, or %04d for four digits.
bool hasFrameNumber(const std::filesystem::path& file);

// The name with the frame's number in that place.
std::filesystem::path fileOfFrame(const std::filesystem::path& file, int frame);

// The request for one frame of its range: outputs and stats named for it.
Request requestOfFrame(const Request& request, int frame);

// The time that a frame shows, in seconds.
double timeOfFrame(const Request& request, int frame);

}  // namespace cutis::app
