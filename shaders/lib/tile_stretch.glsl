// The most that any texel of a tile stretches a Gaussian. The includer declares states[].
#ifndef CUTIS_TILE_STRETCH_GLSL
#define CUTIS_TILE_STRETCH_GLSL

// factor: of a texel of the tile, by inverseMetricFactor (lib/metric.glsl).
void noteStretch(uint tile, vec3 factor) {
    // Bits of floats that are not negative compare as the floats do.
    atomicMax(states[tile].perMmU, floatBitsToUint(factor.x * factor.x));
    atomicMax(states[tile].perMmV, floatBitsToUint(factor.y * factor.y + factor.z * factor.z));
    atomicMax(states[tile].perMmMixed, floatBitsToUint(abs(factor.x * factor.y)));
}

#endif
