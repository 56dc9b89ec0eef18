// PNG and JPEG files that claim more than they hold.
#pragma once

#include <cstdint>
#include <string>

namespace cutis::test {

// A chunk (ISO/IEC 15948, 5.3), its checksum right, so that decoders believe it.
std::string pngChunk(const std::string& typeAndData);

// RGBA of side × side texels of so many bits; its data, one compressed pixel, ends long before it should.
std::string lyingPng(std::uint32_t side, char bits);

// A baseline JPEG with another size in its header (ITU-T T.81, B.2.2). Throws std::runtime_error when it has
// none.
std::string lyingJpeg(std::string file, std::uint16_t width, std::uint16_t height);

}  // namespace cutis::test
