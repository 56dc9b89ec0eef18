// Image files through OpenImageIO in a process of its own (codec/codec_program.cpp), which cutis starts at
// the first use.
//
// Debian's libOpenImageIO brings 250 libraries and takes 0.3 s and 130 MB to load, which commands that touch
// no image should not pay; and a file can crash, hang or bloat the decoders below it, which must take no rig
// that is being edited with them.
#pragma once

#include <span>
#include <string>

#include "renderer/scene/codec/image_codec.h"
#include "renderer/scene/codec/shared_bytes.h"

namespace cutis {

// Samples of an image, interleaved, and what they are; or a mesh, or a file that was made.
struct CodecResult {
    std::string why;  // why it failed; empty when it did not
    PixelLayout layout;
    SharedBytes data;
};

// Starts the process in the background: a program that knows that it will need it calls this first thing.
void startCodec();

// Any thread may call these. Images are of the formats that codec/image_file.h knows, told apart by content;
// `format` of one that is made: as OpenImageIO names it ("png"). Work that crashes, takes longer than 4 s of
// processor time, one for every 2 MB of the file and one for every 150 MB that it has decoded, or takes more
// memory than twice what the limits allow and 512 MiB, has failed and says so. Throws Error when the process
// cannot be started.
CodecResult decodeImageMemory(std::span<const std::byte> file, const PixelLimits&);
CodecResult decodeImageFile(const std::string& path, const PixelLimits&);
// The block that codec/draco_codec.h describes, of up to `maxBytes`.
CodecResult decodeDraco(std::span<const std::byte> data, std::uint64_t maxBytes);
CodecResult encodeImage(const std::string& format, const PixelLayout&, std::span<const std::byte> samples);

}  // namespace cutis
