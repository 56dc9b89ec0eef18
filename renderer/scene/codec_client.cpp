#include "renderer/scene/codec_client.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "renderer/core/error.h"
#include "renderer/scene/codec/protocol.h"

extern char** environ;

namespace cutis {
namespace fs = std::filesystem;
namespace {

using codec::Operation;

// What damaged files may take is 5 s in all.
constexpr std::uint32_t kLeastSeconds = 4;
constexpr std::uint64_t kBytesASecond = 2'000'000;
constexpr std::uint64_t kSpareMemory = std::uint64_t(512) << 20;

fs::path programPath() {
    const fs::path built = CUTIS_IMAGE_CODEC;
    std::error_code error;
    const fs::path beside = fs::read_symlink("/proc/self/exe", error).parent_path() / built.filename();
    return fs::exists(beside, error) ? beside : built;
}

// Two connected ends that keep the limits of messages and are closed in other programs.
struct SocketPair {
    SocketPair() {
        if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
            throw Error("cannot start the image codec", std::strerror(errno));
    }
    ~SocketPair() {
        for (const int end : ends)
            if (end >= 0) ::close(end);
    }
    SocketPair(const SocketPair&) = delete;
    SocketPair& operator=(const SocketPair&) = delete;
    int ends[2];
};

// Our end of the conversation with one process.
class Socket {
  public:
    explicit Socket(int descriptor) : descriptor_(descriptor) {}
    ~Socket() { ::close(descriptor_); }
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;
    int descriptor() const { return descriptor_; }

  private:
    int descriptor_;
};
// Closed when the last who uses it is done: until then no other gets its number.
using SharedSocket = std::shared_ptr<const Socket>;

class Process {
  public:
    static Process& instance() {
        static Process process;
        return process;
    }

    // The socket to a running process; another one when the last was found dead.
    SharedSocket socket(const SharedSocket& dead = nullptr) {
        const std::lock_guard lock(mutex_);
        if (!socket_ || socket_ == dead) start();
        return socket_;
    }

  private:
    void start() {
        SocketPair pair;
        posix_spawn_file_actions_t actions;
        ::posix_spawn_file_actions_init(&actions);
        ::posix_spawn_file_actions_adddup2(&actions, pair.ends[1], STDIN_FILENO);
        const std::string path = programPath().string();
        std::string name = "cutis-codec";
        char* arguments[] = {name.data(), nullptr};
        pid_t pid = 0;
        const int error = ::posix_spawn(&pid, path.c_str(), &actions, nullptr, arguments, environ);
        ::posix_spawn_file_actions_destroy(&actions);
        if (error) throw Error("cannot start the image codec", std::strerror(error), path);
        std::erase_if(started_, [](pid_t ended) { return ::waitpid(ended, nullptr, WNOHANG) != 0; });
        started_.push_back(pid);
        socket_ = std::make_shared<const Socket>(std::exchange(pair.ends[0], -1));
    }

    std::mutex mutex_;
    SharedSocket socket_;
    std::vector<pid_t>
        started_;  // and not seen to end: one that has ended is kept by the system until somebody asks for it
};

bool converse(const Socket& socket, const codec::Request& request, std::span<const std::byte> data,
              codec::Parcel<codec::Reply>& reply) {
    SocketPair pair;
    SharedBytes given(data.size());
    if (!data.empty()) std::memcpy(given.data(), data.data(), data.size());
    if (!codec::send(socket.descriptor(),
                     codec::Parcel<codec::Request>{request, {pair.ends[1], given.descriptor()}}))
        return false;
    ::close(std::exchange(pair.ends[1], -1));
    return codec::receive(pair.ends[0], reply);
}

bool hasMadeSense(const codec::Request& request, const codec::Reply& reply) {
    const PixelLayout& layout = reply.layout;
    const bool decoded =
        request.operation != Operation::encode && request.operation != Operation::decodeDraco;
    return !decoded || (layout.width > 0 && layout.width <= request.limits.width && layout.height > 0 &&
                        layout.height <= request.limits.height && layout.channels > 0 &&
                        layout.channels <= request.limits.channels && layout.bytes() == reply.dataBytes);
}

CodecResult perform(codec::Request request, std::uint64_t fileBytes, std::span<const std::byte> data) {
    request.dataBytes = data.size();
    request.seconds =
        kLeastSeconds + static_cast<std::uint32_t>(std::min<std::uint64_t>(fileBytes / kBytesASecond, 3600));
    request.memoryBytes = 2 * (request.limits.bytes + data.size()) + kSpareMemory;
    codec::Parcel<codec::Reply> reply;
    const SharedSocket first = Process::instance().socket();
    // The process itself may have been killed meanwhile: then once more with a new one.
    if (!converse(*first, request, data, reply) &&
        !converse(*Process::instance().socket(first), request, data, reply)) {
        return {"the image codec has gone", {}, {}};
    }
    reply.message.why.back() = '\0';
    CodecResult result{reply.message.why.data(), reply.message.layout, {}};
    if (!result.why.empty()) return result;
    result.data = SharedBytes::adopt(reply.descriptors[0], reply.message.dataBytes);
    if (!hasMadeSense(request, reply.message) || result.data.bytes().size() != reply.message.dataBytes)
        result.why = "its decoder gave nothing of use";
    return result;
}

template <std::size_t Size>
void setText(std::array<char, Size>& field, const std::string& text) {
    if (text.size() >= Size) throw Error("cannot read image", "its name is too long", text);
    std::ranges::copy(text, field.begin());
}

}  // namespace

void startCodec() {
    try {
        Process::instance().socket();
    } catch (const Error&) {
        // Whoever needs it is told.
    }
}

CodecResult decodeImageMemory(std::span<const std::byte> file, const PixelLimits& limits) {
    codec::Request request;
    request.operation = Operation::decodeMemory;
    request.limits = limits;
    return perform(request, file.size(), file);
}

CodecResult decodeImageFile(const std::string& path, const PixelLimits& limits) {
    codec::Request request;
    request.operation = Operation::decodeFile;
    request.limits = limits;
    setText(request.path, fs::absolute(path).string());
    std::error_code error;
    const std::uintmax_t bytes = fs::file_size(path, error);
    return perform(request, error ? 0 : bytes, {});
}

CodecResult decodeDraco(std::span<const std::byte> data, std::uint64_t maxBytes) {
    codec::Request request;
    request.operation = Operation::decodeDraco;
    request.limits.bytes = maxBytes;
    return perform(request, data.size(), data);
}

CodecResult encodeImage(const std::string& format, const PixelLayout& layout,
                        std::span<const std::byte> samples) {
    codec::Request request;
    request.operation = Operation::encode;
    request.layout = layout;
    setText(request.format, format);
    return perform(request, samples.size(), samples);
}

}  // namespace cutis
