#include "renderer/reference/random.h"

namespace cutis::reference {
namespace {

std::uint32_t reverseBits(std::uint32_t x) {
    x = (x >> 16) | (x << 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

// Each bit flips by a hash of the bits above it: an Owen scramble in base 2.
std::uint32_t scramble(std::uint32_t x, std::uint32_t seed) {
    x = reverseBits(x);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return reverseBits(x);
}

// The second dimension of Sobol's sequence at the index whose reversed bits are x. Its matrix is Pascal's
// triangle modulo 2, ((P, P), (0, P)) of its own half P: the upper half of the bits takes in the lower one,
// and so on in each half.
std::uint32_t sobolSecond(std::uint32_t x) {
    x ^= x << 16;
    x ^= (x & 0x00ff00ffu) << 8;
    x ^= (x & 0x0f0f0f0fu) << 4;
    x ^= (x & 0x33333333u) << 2;
    return x ^ ((x & 0x55555555u) << 1);
}

double toUnit(std::uint32_t x) {
    return (x + 0.5) * 0x1p-32;
}

}  // namespace

std::uint64_t RandomNumbers::mix(std::uint64_t x) {
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9u;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

glm::dvec2 RandomNumbers::pair(std::uint32_t purpose) const {
    const std::uint64_t a = mix(key_ + 0x9e3779b97f4a7c15u * (purpose + 1)), b = mix(a + 0x9e3779b97f4a7c15u);
    const std::uint32_t reversed = reverseBits(scramble(index_, static_cast<std::uint32_t>(a >> 32)));
    return {toUnit(scramble(reversed, static_cast<std::uint32_t>(a))),
            toUnit(scramble(sobolSecond(reversed), static_cast<std::uint32_t>(b)))};
}

}  // namespace cutis::reference
