#include "renderer/scene/codec/protocol.h"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace cutis {

std::uint64_t PixelLayout::bytes() const {
    const std::uint64_t sample = type == SampleType::uint8 ? 1 : type == SampleType::uint16 ? 2 : 4;
    return std::uint64_t(width) * std::uint64_t(height) * std::uint64_t(channels) * sample;
}

namespace codec {
namespace {

constexpr std::size_t kMostDescriptors = 2;

// Room for the descriptors beside a message.
struct Control {
    alignas(cmsghdr) std::array<char, CMSG_SPACE(kMostDescriptors * sizeof(int))> bytes{};
};

}  // namespace

bool sendBytes(int socket, std::span<const std::byte> message, std::span<const int> descriptors) {
    iovec part{const_cast<std::byte*>(message.data()), message.size()};
    msghdr header{};
    header.msg_iov = &part;
    header.msg_iovlen = 1;
    Control control;
    const auto count = static_cast<std::size_t>(std::ranges::find(descriptors, -1) -
                                                descriptors.begin());  // those before the first absent one
    if (count > 0) {
        header.msg_control = control.bytes.data();
        header.msg_controllen = CMSG_SPACE(count * sizeof(int));
        cmsghdr* rights = CMSG_FIRSTHDR(&header);
        rights->cmsg_level = SOL_SOCKET;
        rights->cmsg_type = SCM_RIGHTS;
        rights->cmsg_len = CMSG_LEN(count * sizeof(int));
        std::memcpy(CMSG_DATA(rights), descriptors.data(), count * sizeof(int));
    }
    ssize_t sent;
    do sent = ::sendmsg(socket, &header, MSG_NOSIGNAL);
    while (sent < 0 && errno == EINTR);
    return sent == static_cast<ssize_t>(message.size());
}

bool receiveBytes(int socket, std::span<std::byte> message, std::array<int, 2>& descriptors) {
    iovec part{message.data(), message.size()};
    Control control;
    msghdr header{};
    header.msg_iov = &part;
    header.msg_iovlen = 1;
    header.msg_control = control.bytes.data();
    header.msg_controllen = control.bytes.size();
    ssize_t received;
    do received = ::recvmsg(socket, &header, MSG_CMSG_CLOEXEC);
    while (received < 0 && errno == EINTR);
    if (received < 0) return false;
    for (cmsghdr* rights = CMSG_FIRSTHDR(&header); rights; rights = CMSG_NXTHDR(&header, rights)) {
        if (rights->cmsg_level != SOL_SOCKET || rights->cmsg_type != SCM_RIGHTS) continue;
        const std::size_t count = std::min((rights->cmsg_len - CMSG_LEN(0)) / sizeof(int), kMostDescriptors);
        std::memcpy(descriptors.data(), CMSG_DATA(rights), count * sizeof(int));
    }
    return received == static_cast<ssize_t>(message.size());
}

}  // namespace codec
}  // namespace cutis
