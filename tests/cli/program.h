// Runs `cutis` and states what every failure must look like.
#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene.h"
#include "tests/support/process.h"

namespace cutis::test {

ProcessResult runCutis(std::vector<std::string> arguments, EnvironmentVariables extra = {});

// Status, nothing on stdout, and exactly one line `cutis: error: …` on stderr that holds all of `parts`.
void expectFailure(const ProcessResult& run, int status, const std::vector<std::string>& parts);

// Status 0 and nothing on stderr.
void expectSuccess(const ProcessResult& run);

std::string readText(const std::filesystem::path& path);
void writeText(const std::filesystem::path& path, const std::string& text);
std::vector<std::string> filesIn(const std::filesystem::path& folder);  // names, sorted

// Two heads, boxes of 0.2 m of skin named Anna and Ben, 0.4 m apart about the origin.
Scene twoHeads();

}  // namespace cutis::test
