// Mip levels of material textures, made on the CPU: devices filter and round their blits each in their own way, and
// normal maps at grazing light turn that into pictures that differ.
#pragma once

#include <cstddef>
#include <vector>

#include "renderer/scene/scene.h"

namespace cutis {

// The next level of `texels`, width × height of `format`: max(1, size / 2) along each side, boxes of four texels (the last
// row or column of an odd size is left out). With `srgb`, colour is averaged in linear light.
std::vector<std::byte> halveTexels(const std::vector<std::byte>& texels, int width, int height, TexelFormat format,
                                   bool srgb);

}  // namespace cutis
