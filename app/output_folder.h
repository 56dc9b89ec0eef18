// A folder of results: for commands that write a report.
#pragma once

#include <filesystem>
#include <string>

namespace cutis::app {

// Makes the folder where it is missing (its parent must be there). Throws Error when it cannot be written, or when it
// holds something that is not a report of `marker` (a file that such a report has), so that nothing else is overwritten.
void prepareOutputFolder(const std::filesystem::path& folder, const std::string& marker);

// The words of this process' command line, quoted where a shell would need it: what reproduces a result.
std::string commandLine();

}  // namespace cutis::app
