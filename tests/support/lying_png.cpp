#include "lying_png.h"

#include <stdexcept>

namespace cutis::test {
namespace {

std::string bigEndian(std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
    return bytes;
}

}  // namespace

std::string pngChunk(const std::string& typeAndData) {
    std::uint32_t crc = 0xffffffffu;
    for (const unsigned char byte : typeAndData) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    return bigEndian(static_cast<std::uint32_t>(typeAndData.size()) - 4) + typeAndData + bigEndian(~crc);
}

std::string lyingPng(std::uint32_t side, char bits) {
    const std::string header = bigEndian(side) + bigEndian(side) + bits + std::string("\x06\0\0\0", 4);
    const std::string data("\x78\x9c\x63\x60\x60\x60\x60\x00\x00\x00\x05\x00\x01", 13);
    return "\x89PNG\r\n\x1a\n" + pngChunk("IHDR" + header) + pngChunk("IDAT" + data) + pngChunk("IEND");
}

std::string lyingJpeg(std::string file, std::uint16_t width, std::uint16_t height) {
    const std::size_t frame = file.find("\xff\xc0");
    if (frame == std::string::npos || frame + 9 > file.size()) throw std::runtime_error("no baseline JPEG");
    // After the marker: length (2 bytes), precision (1), height, width.
    file.replace(frame + 5, 4, bigEndian(std::uint32_t(height) << 16 | width));
    return file;
}

}  // namespace cutis::test
