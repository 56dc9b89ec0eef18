// Deterministic noise in three dimensions: the same on every machine.
#pragma once

#include <glm/glm.hpp>

namespace cutis::people {

// Smooth noise with features of about one unit, in [-1, 1], mean 0.
double gradientNoise(const glm::dvec3& p, unsigned seed);

// Σ gradientNoise over octaves, each twice as fine and half as strong; about [-1, 1].
double fractalNoise(const glm::dvec3& p, int octaves, unsigned seed);

// Distances to the nearest and second nearest of one jittered point a unit cell.
struct Cells {
    double nearest, second;
    unsigned id;  // hash of the nearest point
};
Cells cellNoise(const glm::dvec3& p, unsigned seed);

// A hash in [0, 1).
double hashUnit(unsigned x);

}  // namespace cutis::people
