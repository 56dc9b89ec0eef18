#include "renderer/core/timeline.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <mutex>

namespace cutis {
namespace {

constexpr std::size_t kMost = 4096;

using Clock = std::chrono::steady_clock;

double millisecondsOf(const timespec& time) {
    return double(time.tv_sec) * 1e3 + double(time.tv_nsec) * 1e-6;
}

// When the process started, by the steady clock's milliseconds; proc(5): the 22nd field of /proc/self/stat, in ticks since boot.
double processStart() {
    double start = 0;
    if (std::FILE* file = std::fopen("/proc/self/stat", "r")) {
        unsigned long long ticks = 0;
        // The second field is a name in parentheses, which may hold anything.
        if (std::fscanf(file, "%*d (%*[^)]) %*c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %*u %*u %*d %*d %*d %*d %*d %*d %llu",
                        &ticks) == 1) {
            timespec boot{}, steady{};
            clock_gettime(CLOCK_BOOTTIME, &boot);
            clock_gettime(CLOCK_MONOTONIC, &steady);
            start = double(ticks) * 1e3 / double(sysconf(_SC_CLK_TCK)) - millisecondsOf(boot) + millisecondsOf(steady);
        }
        std::fclose(file);
    }
    return start;
}

double steadyMs() {
    return std::chrono::duration<double, std::milli>(Clock::now().time_since_epoch()).count();
}

struct Spans {
    std::mutex mutex;
    std::vector<TimelineEntry> entries;
};

Spans& spans() {
    static Spans all;
    return all;
}

}  // namespace

double processMs() {
    static const double start = processStart();
    return steadyMs() - start;
}

void noteMain() {
    Spans& all = spans();
    const std::lock_guard lock(all.mutex);
    all.entries.push_back({"libraries", 0, processMs()});
}

TimeSpan::TimeSpan(std::string_view name) : name_(name), fromMs_(processMs()) {}

TimeSpan::~TimeSpan() {
    Spans& all = spans();
    const std::lock_guard lock(all.mutex);
    if (all.entries.size() < kMost) all.entries.push_back({std::move(name_), fromMs_, processMs()});
}

std::vector<TimelineEntry> timeline() {
    Spans& all = spans();
    const std::lock_guard lock(all.mutex);
    return all.entries;
}

}  // namespace cutis
