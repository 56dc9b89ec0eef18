// cutis-codec: decodes and encodes image files, and decodes meshes, for cutis, so that a file that crashes,
// hangs or bloats a decoder takes neither cutis nor an unsaved rig with it.
//
// It loads OpenImageIO once and answers each request in a process of its own, forked from the loaded one,
// with limits of memory and time. Its socket is standard input; it ends when cutis does.
#include <fcntl.h>
#include <malloc.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <map>
#include <string>

#include "renderer/scene/codec/draco_codec.h"
#include "renderer/scene/codec/protocol.h"
#include "renderer/scene/codec/shared_bytes.h"

namespace cutis::codec {
namespace {

// Of one image. An arena of the heap reserves 64 MiB of addresses (mallopt(3)), which count as memory taken.
constexpr int kThreads = 4, kArenas = 2;
// A decoder may wait for a slow disk, not for ever: so many times the seconds of processor time that it has.
constexpr unsigned kPatience = 20;
// A small file may hold much: its decoder gets a second more for so much as it has decoded by then. What the
// file claims to hold gives it none.
constexpr std::uint64_t kDecodedBytesASecond = 150'000'000;

void setText(std::array<char, 512>& field, const std::string& text) {
    std::snprintf(field.data(), field.size(), "%s", text.c_str());
}

// Of processor time, once so much of the image is decoded. At the most what the request's limit of bytes is
// worth.
void limitSeconds(const Request& request, std::uint64_t decoded) {
    const rlim_t seconds = request.seconds + std::min(decoded, request.limits.bytes) / kDecodedBytesASecond;
    const rlimit both{seconds, request.seconds + request.limits.bytes / kDecodedBytesASecond + 1};
    ::setrlimit(RLIMIT_CPU, &both);
    ::alarm(static_cast<unsigned>(seconds) * kPatience);
}

void limitResources(const Request& request) {
    const auto limit = [](auto resource, rlim_t value) {
        const rlimit both{value, value};
        ::setrlimit(resource, &both);
    };
    limit(RLIMIT_CORE, 0);
    limitSeconds(request, 0);
#ifndef __SANITIZE_ADDRESS__  // which reserves terabytes of addresses
    unsigned long pages = 0;
    if (std::FILE* statm = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(statm, "%lu", &pages) != 1) pages = 0;
        std::fclose(statm);
    }
    limit(RLIMIT_AS, pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + request.memoryBytes);
#endif
}

// Answers one request; the process ends after it.
void answer(const Parcel<Request>& parcel) {
    const Request& request = parcel.message;
    Parcel<Reply> reply;
    SharedBytes made;
    const Allocate allocate = [&](std::uint64_t bytes) {
        made = SharedBytes(bytes);
        return made.data();
    };
    const Progress progress = [&](std::uint64_t decoded) { limitSeconds(request, decoded); };
    const SharedBytes given = SharedBytes::adopt(parcel.descriptors[1], request.dataBytes);
    ::mallopt(M_ARENA_MAX, kArenas);
    limitThreads(kThreads);
    limitResources(request);
    Reply& message = reply.message;
    std::string why;
    switch (request.operation) {
        case Operation::decodeMemory:
            why = decodeMemory(given.bytes(), request.limits, message.layout, allocate, progress);
            break;
        case Operation::decodeFile:
            why = decodeFile(request.path.data(), request.limits, message.layout, allocate, progress);
            break;
        case Operation::decodeDraco:
            why = codec::decodeDraco(given.bytes(), request.limits.bytes, allocate);
            break;
        case Operation::encode:
            made = SharedBytes::file();
            why = encode(request.format.data(), request.layout, given.bytes(), made.path());
            break;
    }
    setText(message.why, why);
    if (why.empty()) {
        message.dataBytes = made.sizeNow();
        reply.descriptors[0] = made.descriptor();
    }
    send(parcel.descriptors[0], reply);
}

// What is said for a process that could not say it itself.
std::string causeOf(int status) {
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (signal == SIGXCPU || signal == SIGALRM) return "it takes its decoder too long";
    if (signal == SIGKILL) return "it took too much time or memory";
    return std::string("its decoder crashed") + (signal ? std::string(" (") + ::strsignal(signal) + ")" : "");
}

class Server {
  public:
    Server() {
        sigset_t ended;
        sigemptyset(&ended);
        sigaddset(&ended, SIGCHLD);
        ::sigprocmask(SIG_BLOCK, &ended, nullptr);
        endings_ = ::signalfd(-1, &ended, SFD_CLOEXEC | SFD_NONBLOCK);
    }

    // Until cutis closes its end.
    void run() {
        for (;;) {
            pollfd events[] = {{STDIN_FILENO, POLLIN, 0}, {endings_, POLLIN, 0}};
            if (::poll(events, 2, -1) < 0) continue;
            if (events[1].revents) reap();
            if (events[0].revents && !serve()) return;
        }
    }

  private:
    bool serve() {
        Parcel<Request> parcel;
        if (!receive(STDIN_FILENO, parcel)) return false;
        const pid_t child = ::fork();
        if (child == 0) {
            ::close(STDIN_FILENO);
            answer(parcel);
            std::_Exit(0);
        }
        if (parcel.descriptors[1] >= 0) ::close(parcel.descriptors[1]);
        if (child < 0) {
            fail(parcel.descriptors[0], "no process could be started for it");
        } else {
            replies_[child] = parcel.descriptors[0];
        }
        return true;
    }

    void reap() {
        signalfd_siginfo info;
        while (::read(endings_, &info, sizeof info) == sizeof info) {
        }
        int status = 0;
        for (pid_t child; (child = ::waitpid(-1, &status, WNOHANG)) > 0;) {
            const auto found = replies_.find(child);
            if (found == replies_.end()) continue;
            if (status != 0) {
                fail(found->second, causeOf(status));
            } else {
                ::close(found->second);
            }
            replies_.erase(found);
        }
    }

    void fail(int socket, const std::string& why) {
        Parcel<Reply> reply;
        setText(reply.message.why, why);
        send(socket, reply);
        ::close(socket);
    }

    int endings_;
    std::map<pid_t, int> replies_;  // sockets of the processes at work
};

// Signals end this process and those that it starts, and so tell what became of them, whatever whoever
// started cutis made of them, or a sanitizer that a library brings along.
void resetSignals() {
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM, SIGXCPU})
        std::signal(signal, SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

}  // namespace
}  // namespace cutis::codec

int main() {
    cutis::codec::resetSignals();
    // An interrupt of the terminal is for cutis to answer.
    std::signal(SIGINT, SIG_IGN);
    // What libraries print about a damaged file, cutis says in its own words.
    const int nowhere = ::open("/dev/null", O_RDWR);
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
    cutis::codec::Server().run();
    std::_Exit(0);
}
