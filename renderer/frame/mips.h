// How material textures lie on the device, and their mip levels. Both are made on the CPU: devices filter and round each
// in their own way, and normal maps at grazing light turn that into pictures that differ.
#pragma once

#include <cstddef>
#include <vector>

#include "renderer/scene/scene.h"

namespace cutis {

// srgb8, linear8: four bytes a texel. half4: four half floats. normal2: x and y of a unit vector as half floats of
// (x + 1) / 2; z is their remainder. Two half floats take the room of four bytes, and a lobe at grazing light shows what
// filtering in bytes rounds off.
enum class TexelEncoding { srgb8, linear8, half4, normal2 };

std::size_t bytesPerTexel(TexelEncoding encoding);

// Texels of `image`, a normal map of glTF, as normal2.
std::vector<std::byte> encodeNormals(const Image& image);

// The next level of `texels`, width × height: max(1, size / 2) along each side, boxes of four texels (the last row or
// column of an odd size is left out). Colour is averaged in linear light, normals as vectors.
std::vector<std::byte> halveTexels(const std::vector<std::byte>& texels, int width, int height, TexelEncoding encoding);

}  // namespace cutis
