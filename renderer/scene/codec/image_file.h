// What an image file says about itself before anything of it is decoded.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "renderer/scene/codec/image_codec.h"

namespace cutis {

// A file's format by its first bytes as OpenImageIO names it ("png", "jpeg", "webp", …), empty when unknown.
std::string imageFormat(std::span<const std::byte> file);

// What the header of a PNG or JPEG claims to hold: width, height and type, uint8 or uint16. Zeros for what it
// does not tell, and for other formats.
PixelLayout claimedLayout(std::span<const std::byte> file);

// What is wrong with a PNG or JPEG that is cut off, or whose data cannot possibly hold the pixels that it
// claims: decoders of JPEG make the rest up without a word. Empty for a file that seems whole, and for other
// formats, whose decoders say it themselves. `format` as imageFormat() gives it.
std::string findDamage(std::span<const std::byte> file, const std::string& format);

}  // namespace cutis
