// What cutis and `cutis-codec` say to each other, over Unix sockets that carry descriptors.
#pragma once

#include <array>
#include <span>

#include "renderer/scene/codec/image_codec.h"

namespace cutis::codec {

enum class Operation : std::uint32_t { decodeMemory, decodeFile, encode, decodeDraco };

// One message, with the descriptors of the socket for the Reply and, where there is `dataBytes`, of the file
// or samples.
struct Request {
    Operation operation = Operation::decodeFile;
    PixelLayout layout;             // of samples to encode
    PixelLimits limits{};           // of decoding; of a mesh its bytes alone
    std::uint64_t dataBytes = 0;    // beside the message
    std::uint64_t memoryBytes = 0;  // that the work may take
    std::uint32_t seconds = 0;      // of processor time that it may take
    std::array<char, 16> format{};  // of encode, as OpenImageIO names it
    std::array<char, 4096> path{};  // of decodeFile
};

// One message, with the descriptor of the samples or the file where there are any.
struct Reply {
    PixelLayout layout;  // of decoded samples
    std::uint64_t dataBytes = 0;
    std::array<char, 512> why{};  // why it failed; empty when it did not
};

// A message with its descriptors; -1: none.
template <class Message>
struct Parcel {
    Message message;
    std::array<int, 2> descriptors{-1, -1};
};

// False when the other side is gone.
bool sendBytes(int socket, std::span<const std::byte> message, std::span<const int> descriptors);
// Takes over the descriptors. False at the end of the conversation or when the message has another size.
bool receiveBytes(int socket, std::span<std::byte> message, std::array<int, 2>& descriptors);

template <class Message>
bool send(int socket, const Parcel<Message>& parcel) {
    return sendBytes(socket, std::as_bytes(std::span(&parcel.message, 1)), parcel.descriptors);
}

template <class Message>
bool receive(int socket, Parcel<Message>& parcel) {
    return receiveBytes(socket, std::as_writable_bytes(std::span(&parcel.message, 1)), parcel.descriptors);
}

}  // namespace cutis::codec
