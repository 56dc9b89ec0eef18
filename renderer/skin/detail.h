// The relief of pores that skin shows where textures resolve none: a tile of slopes, made here and the same
// everywhere.
//
// The relief is part of the roughness, not added to it: a lobe of rms slope m stands for the slopes E|s|² =
// m² of all that is too fine to see (a Beckmann distribution has p(s) = exp(-|s|²/m²) / πm²). Where a view
// resolves slopes of variance V, they turn the normal and the lobe keeps m² - V. So skin looks the same from
// afar with and without, and its energy balance needs no change. This is what LEAN (Olano & Baker 2010) and
// Toksvig (2005) do, read backwards.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "shaders/shared/detail.h"

namespace cutis::skin {

inline constexpr int kDetailSize = DETAIL_SIZE, kDetailLevels = DETAIL_LEVELS;

struct DetailTile {
    // Slopes ∂h/∂x, ∂h/∂y of a height that repeats after the tile; level k has (kDetailSize >> k)² of them,
    // row by row, each the mean of four of the level before.
    std::array<std::vector<glm::vec2>, kDetailLevels> slopes;
    // E|s|² of each level between whose texels one interpolates. That of level 0 is kDetailVariance.
    std::array<double, kDetailLevels> variance;

    // Slopes at a place of the tile, of which it is 1 wide, bilinear within a level.
    glm::dvec2 lookUp(int level, const glm::dvec2& place) const;
    // The same between two levels.
    glm::dvec2 lookUp(double level, const glm::dvec2& place) const;
    // E|s|² of that: with a share f of the coarser level, which is a mean of the finer one,
    // (1-f)² v_k + (1 - (1-f)²) v_{k+1}.
    double varianceAt(double level) const;
};

inline constexpr double kDetailVariance = 0.02;  // E|s|² at strength 1: an rms slope of 8 degrees

// Pixels wider than this share of the tile show less than a hundredth of its variance: texels of level 5 and
// coarser, two pixels each, hold no more.
inline constexpr double kDetailWidest = 16.0 / kDetailSize;

// Made at the first call, in a tenth of a second.
const DetailTile& detailTile();

// The strength that a material's relief really has: as asked for, but never more than leaves its narrowest
// lobe, of rms slope m, half of m².
double detailStrength(double asked, double narrowest);

// The rms slope of a material's narrowest lobe: its roughness m, or with a second lobe that lobe's.
double narrowestSlope(double m, double lobeWeight, double lobeRatio);

}  // namespace cutis::skin
