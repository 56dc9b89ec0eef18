// What the fuzz targets share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>

namespace cutis::fuzz {

// Runs what loads hostile input. An Error of one line is the right answer to it; anything else that is thrown, and a message
// of several lines, ends the program, which libFuzzer reports.
void expectCleanly(const std::function<void()>& load);

// Writes the input to a file of this process in memory, for loaders that read files. The same path at each call.
std::filesystem::path inputFile(std::span<const std::uint8_t> input, const char* name);

}  // namespace cutis::fuzz
