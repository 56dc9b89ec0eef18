// Runs a program as a user would, and keeps what it printed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace cutis::test {

struct ProcessResult {
    int status = -1;        // exit status; 128 + signal when a signal ended it
    bool timedOut = false;  // it ran past the limit and was killed
    std::string out, err;   // all of stdout and stderr
    double seconds = 0;     // wall clock
    double cpuSeconds = 0;  // of processor time, with the processes that it started and waited for
    std::uint64_t peakBytes = 0;  // most memory resident in any one of them
};

using EnvironmentVariables = std::vector<std::pair<std::string, std::string>>;

// Runs arguments[0] (a path) with the rest as its arguments, stdin empty, this process's environment plus
// `extra` (an empty value unsets). Throws std::runtime_error when the program cannot be started.
ProcessResult runProcess(const std::vector<std::string>& arguments, const EnvironmentVariables& extra = {},
                         double timeoutSeconds = 300);

// A fresh folder of this process, removed with all it holds at the end of its life.
class TemporaryFolder {
  public:
    explicit TemporaryFolder(const std::string& name = "cutis-test");
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& file) const { return path_ / file; }

  private:
    std::filesystem::path path_;
};

}  // namespace cutis::test
