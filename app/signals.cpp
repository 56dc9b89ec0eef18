#include "app/signals.h"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <thread>

#include "renderer/core/files.h"

namespace cutis::app {

namespace {

std::atomic<std::atomic<bool>*> gentleStop{nullptr};
std::atomic<int> firstSignal{0};

}  // namespace

void stopGentlyOnSignals(std::atomic<bool>* stop) {
    gentleStop = stop;
}

int endingStatus() {
    return firstSignal ? 128 + firstSignal : 0;
}

void endCleanlyOnSignals() {
    // A thread of its own waits for them, because a signal handler may not touch a file list or a mutex. All
    // later threads, drivers' included, inherit the mask that keeps these signals from them.
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction old {};
        // A signal that is ignored from the start (nohup, a background job of a shell) stays ignored.
        if (sigaction(signal, nullptr, &old) == 0 && old.sa_handler != SIG_IGN) sigaddset(&signals, signal);
    }
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    std::thread([signals] {
        int signal = 0;
        if (sigwait(&signals, &signal) != 0) return;
        if (std::atomic<bool>* stop = gentleStop) {
            firstSignal = signal;
            *stop = true;
            if (sigwait(&signals, &signal) != 0) return;
        }
        discardTemporaryFiles();
        _exit(128 + signal);
    }).detach();
}

}  // namespace cutis::app
