#include "app/progress.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>

namespace cutis::app {

using namespace std::chrono_literals;

Progress::Progress() {
    if (isatty(STDERR_FILENO)) thread_ = std::thread([this] { show(); });
}

Progress::~Progress() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void Progress::setStage(const std::string& stage) {
    const std::lock_guard lock(mutex_);
    stage_ = stage;
}

void Progress::show() {
    const auto start = std::chrono::steady_clock::now();
    std::unique_lock lock(mutex_);
    if (changed_.wait_for(lock, 1s, [this] { return ended_; })) return;
    do {
        const auto seconds =
            std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - start);
        std::fprintf(stderr, "\r\033[Kcutis: %s, %d s", stage_.c_str(), static_cast<int>(seconds.count()));
        std::fflush(stderr);
    } while (!changed_.wait_for(lock, 1s, [this] { return ended_; }));
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
}

}  // namespace cutis::app
