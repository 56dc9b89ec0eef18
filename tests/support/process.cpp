#include "tests/support/process.h"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

extern char** environ;

namespace cutis::test {

namespace {

std::string readAll(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<std::string> environmentWith(const EnvironmentVariables& extra) {
    std::vector<std::string> all;
    for (char** entry = environ; *entry; ++entry) {
        const std::string text = *entry;
        const std::string name = text.substr(0, text.find('='));
        bool replaced = false;
        for (const auto& [key, value] : extra) replaced = replaced || key == name;
        if (!replaced) all.push_back(text);
    }
    for (const auto& [key, value] : extra)
        if (!value.empty()) all.push_back(key + "=" + value);
    return all;
}

std::vector<char*> pointersTo(std::vector<std::string>& texts) {
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    return pointers;
}

// In the child, between fork and exec: only calls that are safe there.
[[noreturn]] void becomeProgram(char* const* arguments, char* const* variables, const char* out,
                                const char* err) {
    setpgid(0, 0);  // so that a timeout ends its children too
    const int in = open("/dev/null", O_RDONLY);
    const int outFile = open(out, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int errFile = open(err, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (in >= 0 && outFile >= 0 && errFile >= 0 && dup2(in, 0) >= 0 && dup2(outFile, 1) >= 0 &&
        dup2(errFile, 2) >= 0)
        execve(arguments[0], arguments, variables);
    _exit(127);
}

}  // namespace

ProcessResult runProcess(const std::vector<std::string>& arguments, const EnvironmentVariables& extra,
                         double timeoutSeconds) {
    if (arguments.empty() || access(arguments[0].c_str(), X_OK) != 0)
        throw std::runtime_error("no program at " + (arguments.empty() ? std::string("''") : arguments[0]));
    // Files rather than pipes: a program that prints a lot cannot block on a reader.
    const TemporaryFolder folder("cutis-process");
    const std::string out = folder / "stdout", err = folder / "stderr";
    std::vector<std::string> argumentTexts = arguments, variableTexts = environmentWith(extra);
    const std::vector<char*> argumentPointers = pointersTo(argumentTexts);
    const std::vector<char*> variablePointers = pointersTo(variableTexts);

    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error(std::string("fork: ") + strerror(errno));
    if (child == 0) becomeProgram(argumentPointers.data(), variablePointers.data(), out.c_str(), err.c_str());

    ProcessResult result;
    int state = 0;
    rusage used{};
    while (wait4(child, &state, WNOHANG, &used) == 0) {
        if (!result.timedOut && elapsed() > timeoutSeconds) {
            result.timedOut = true;
            kill(-child, SIGKILL);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    result.seconds = elapsed();
    const auto secondsOf = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
    result.cpuSeconds = secondsOf(used.ru_utime) + secondsOf(used.ru_stime);
    result.peakBytes = static_cast<std::uint64_t>(used.ru_maxrss) * 1024;
    result.status = WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
    result.out = readAll(out);
    result.err = readAll(err);
    return result;
}

TemporaryFolder::TemporaryFolder(const std::string& name) {
    std::string pattern = (std::filesystem::temp_directory_path() / (name + "-XXXXXX")).string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("mkdtemp " + pattern + ": " + strerror(errno));
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;  // a folder that cannot be removed is debris, not a failed test
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace cutis::test
