#include "renderer/scene/codec/image_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace cutis {
using namespace std::string_view_literals;
namespace {

// An unsigned integer of so many bytes, the highest first.
std::uint32_t bigEndian(std::span<const std::byte> bytes, std::size_t at, std::size_t count) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < count; ++i) word = word << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
    return word;
}

// CRC-32 of ISO 3309, as PNG chunks carry it.
std::uint32_t crc32(std::span<const std::byte> bytes) {
    static const auto table = [] {
        std::array<std::uint32_t, 256> entries;
        for (std::uint32_t i = 0; i < 256; ++i) {
            entries[i] = i;
            for (int bit = 0; bit < 8; ++bit)
                entries[i] = entries[i] >> 1 ^ (entries[i] & 1 ? 0xedb88320u : 0);
        }
        return entries;
    }();
    std::uint32_t crc = ~0u;
    for (const std::byte b : bytes) crc = table[(crc ^ std::to_integer<std::uint32_t>(b)) & 0xff] ^ crc >> 8;
    return ~crc;
}

std::string findPngDamage(std::span<const std::byte> file) {
    constexpr std::size_t kSignature = 8, kFrame = 12;  // length, type and CRC of a chunk
    constexpr std::uint32_t kEnd = 0x49454e44;          // IEND
    for (std::size_t at = kSignature;;) {
        if (at + kFrame > file.size() || bigEndian(file, at, 4) > file.size() - at - kFrame)
            return "the PNG is truncated";
        const std::size_t length = bigEndian(file, at, 4);
        if (crc32(file.subspan(at + 4, length + 4)) != bigEndian(file, at + 8 + length, 4))
            return "the PNG is damaged: a checksum does not fit";
        if (bigEndian(file, at + 4, 4) == kEnd) return {};
        at += kFrame + length;
    }
}

// The segments of a JPEG file (ITU-T T.81, annex B), from its first byte to its end marker.
class JpegFile {
  public:
    explicit JpegFile(std::span<const std::byte> file) : file_(file) {}

    std::string findDamage() {
        for (std::size_t at = 0;;) {
            const std::size_t start = at;
            while (at < file_.size() && file_[at] != kMark) ++at;
            coded_ += at - start;
            while (at < file_.size() && file_[at] == kMark) ++at;
            if (at == file_.size()) return kTruncated;
            const auto code = std::to_integer<std::uint8_t>(file_[at++]);
            if (code == 0xd9) break;  // the end
            // A byte of the data (0xff, followed by 0), and markers without a segment: TEM, RST0 to RST7,
            // SOI.
            if (code <= 0x01 || (code >= 0xd0 && code <= 0xd8)) {
                ++coded_;
                continue;
            }
            if (file_.size() - at < 2) return kTruncated;
            const std::size_t length = bigEndian(file_, at, 2);
            if (length < 2 || length > file_.size() - at) return kTruncated;
            // A frame, unless it is a table (DHT, DAC) or reserved (JPG).
            if ((code & 0xf0) == 0xc0 && code != 0xc4 && code != 0xc8 && code != 0xcc)
                readFrame(file_.subspan(at + 2, length - 2), code);
            at += length;
        }
        if (8 * coded_ >= leastBits_) return {};
        return "the JPEG is truncated: its " + std::to_string(coded_) + " bytes of data cannot hold " +
               std::to_string(width_) + " x " + std::to_string(height_) + " texels";
    }

    // Of the frame that findDamage() came by; 0 before.
    int width() const { return width_; }
    int height() const { return height_; }

  private:
    static constexpr std::byte kMark{0xff};
    static constexpr const char* kTruncated = "the JPEG is truncated";

    // In Huffman codes, which have a bit or more each, a block of 8 x 8 has one code for its mean, and one at
    // least for its other coefficients (that there are none; T.81, F.1.2) where the frame is sequential:
    // progressive scans pass over those of thousands of blocks in one code (G.1.2.2). Arithmetic codes have
    // no such bound.
    void readFrame(std::span<const std::byte> frame, std::uint8_t code) {
        if (frame.size() < 6) return;  // its decoder refuses it
        height_ = static_cast<int>(bigEndian(frame, 1, 2));
        width_ = static_cast<int>(bigEndian(frame, 3, 2));
        const std::uint64_t codes = code < 0xc2 ? 2 : code == 0xc2 ? 1 : 0;  // of a block
        const std::size_t components = std::min<std::size_t>(bigEndian(frame, 5, 1), (frame.size() - 6) / 3);
        std::uint64_t widest = 1, highest = 1;
        const auto across = [&](std::size_t c) { return bigEndian(frame, 7 + 3 * c, 1) >> 4; };
        const auto down = [&](std::size_t c) { return bigEndian(frame, 7 + 3 * c, 1) & 15; };
        for (std::size_t c = 0; c < components; ++c) {
            widest = std::max<std::uint64_t>(widest, across(c));
            highest = std::max<std::uint64_t>(highest, down(c));
        }
        leastBits_ = 0;
        for (std::size_t c = 0; c < components; ++c) {
            const auto blocks = [](int texels, std::uint64_t share, std::uint64_t of) {
                return (std::uint64_t(texels) * share + 8 * of - 1) / (8 * of);
            };
            leastBits_ += blocks(width_, across(c), widest) * blocks(height_, down(c), highest) * codes;
        }
    }

    std::span<const std::byte> file_;
    std::uint64_t coded_ = 0;  // bytes outside of segments
    std::uint64_t leastBits_ = 0;
    int width_ = 0, height_ = 0;
};

}  // namespace

std::string imageFormat(std::span<const std::byte> file) {
    const std::string_view head(reinterpret_cast<const char*>(file.data()),
                                std::min<std::size_t>(file.size(), 12));
    const auto starts = [&](std::string_view magic) { return head.starts_with(magic); };
    if (starts("\x89PNG")) return "png";
    if (starts("\xff\xd8\xff")) return "jpeg";
    if (starts("RIFF") && head.size() == 12 && head.substr(8) == "WEBP") return "webp";
    for (const std::string_view tiff :
         {"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv})  // and those beyond 4 GiB
        if (starts(tiff)) return "tiff";
    if (starts("\x76\x2f\x31\x01")) return "openexr";
    if (starts("#?")) return "hdr";
    if (starts("BM")) return "bmp";
    if (starts("GIF8")) return "gif";
    return {};
}

PixelLayout claimedLayout(std::span<const std::byte> file) {
    const std::string format = imageFormat(file);
    if (format == "png" && file.size() >= 25) {  // signature; the header's length, type, width, height, depth
        return {static_cast<int>(bigEndian(file, 16, 4)), static_cast<int>(bigEndian(file, 20, 4)), 0,
                std::to_integer<int>(file[24]) > 8 ? SampleType::uint16 : SampleType::uint8};
    }
    if (format != "jpeg") return {};
    JpegFile jpeg(file);
    jpeg.findDamage();
    return {jpeg.width(), jpeg.height()};
}

std::string findDamage(std::span<const std::byte> file, const std::string& format) {
    if (format == "png") return findPngDamage(file);
    if (format == "jpeg") return JpegFile(file).findDamage();
    return {};
}

}  // namespace cutis
