// Counter-based random numbers: a sample's numbers follow from its name (seed, pixel, pass, index, purpose),
// never from the order of work, so that results do not depend on threads or interruptions.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace cutis::reference {

// The numbers of sample `index` of a sequence. Any pair runs through a randomly scrambled Sobol sequence, so
// that the samples so far fill the square more evenly than independent numbers do; each is uniform by itself,
// so that estimates stay unbiased. Pairs of different purposes, and sequences of different keys, are
// independent. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020, with the hash constants of
// Vegdahl 2021.
class RandomNumbers {
  public:
    RandomNumbers(std::uint64_t key, std::uint32_t index) : key_(key), index_(index) {}

    // Two numbers in (0,1) for a purpose.
    glm::dvec2 pair(std::uint32_t purpose) const;
    // Numbers for a part of the work: its purposes share no numbers with those of other parts.
    RandomNumbers branch(std::uint32_t part) const {
        return {mix(key_ + 0x632be59bd9b4e019u * (part + 1)), index_};
    }

    // A well-mixed 64-bit hash (splitmix64's finalizer, Steele et al. 2014).
    static std::uint64_t mix(std::uint64_t x);

  private:
    std::uint64_t key_;
    std::uint32_t index_;
};

}  // namespace cutis::reference
