// Warnings about what a scene holds, which several pictures of it would repeat.
#pragma once

#include <string>

namespace cutis {

// warn(text), unless this run of the program has said the same before.
void warnOnce(const std::string& text);

}  // namespace cutis
