// What each part of `speed` prints: Markdown tables of medians, least and largest times.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/frame/renderer.h"

namespace cutis::speed {

struct Spread {
    double median = 0, least = 0, most = 0;  // ms
};
// Of all values but the first quarter, which warms up.
Spread spreadOf(std::vector<double> values);
std::string toText(const Spread& spread);

// The repeated times of one row of the pass table; of all rows when the name is empty.
Spread timeOf(const RenderStats& stats, const std::string& pass);

// Diffusion of a fully covered atlas against what the device takes to copy its irradiance texture.
void printDiffusion(gpu::Device& device, int repeats);

// What one more light costs, against a light map and its share of irradiance measured alone.
void printLights(gpu::Device& device, int repeats);

// A frame of the default scene with eight lights: everything anew, one light moved, the camera moved; and the camera alone where
// nothing is skin.
void printFrames(gpu::Device& device, const std::filesystem::path& sceneFile, int repeats);
// The same scene with 1 to 16 characters.
void printCharacters(gpu::Device& device, const std::filesystem::path& sceneFile, int repeats);

}  // namespace cutis::speed
