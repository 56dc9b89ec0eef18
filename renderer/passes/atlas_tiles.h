// The atlas in tiles, and which of them a picture needs: passes over texels run on those and no others
// (DESIGN §3).
//
// What a later step writes is what an earlier one reads, so tiles are listed in the order of the steps, from
// the last thing done to the first:
//
//     seen       pixels look the skin up there                             thickness, exitance
//     entries    light that shines through what is seen enters there
//     lookups    levels are looked up there, between texels of the coarsest one
//     read(k)    a texel of one of these reads level k there
//     level(k)   gutters of these go on there                              second direction of blur k
//     scratch(k) a texel of one of these reads there what stands between
//                the two directions of blur k                              first direction of blur k
//     read(-1)   likewise what level 0 is made from
//     lit        gutters of these go on there                              irradiance
//     probes     likewise what the sky's visibility there is made from     environment visibility and
//     occlusion
//
// A pass runs on the tiles of its step and of all before it. Shaders: tiles_*.comp, lib/atlas_tiles.glsl.
#pragma once

#include <span>

#include "renderer/passes/resources.h"
#include "shaders/shared/atlas_tiles.h"

namespace cutis {

struct AtlasTiles {
    std::uint64_t id = 0;  // no two that recordCoveredTiles has made share one
    gpu::Buffer charts, tiles, states;
    gpu::Buffer list, counts, dispatches;
    std::vector<std::uint32_t> receiverGroups;  // a chart
    std::uint32_t count = 0;                    // of tiles, needed or not
    bool wholeBodies = false;                   // some charts are needed as wholes: shared::AtlasChart::litWhole
    std::vector<bool> changed;  // of the receiver groups: what passes run on, keeping what they wrote elsewhere. Empty: all
    std::vector<std::uint32_t> shifts;  // of each level of diffusion: its side is the atlas' / 2^shift

    bool runsOn(std::uint32_t chart) const { return changed.empty() || changed[receiverGroups[chart]]; }
    std::uint32_t seen() const { return 0; }
    std::uint32_t entries() const { return 1; }
    std::uint32_t lookups() const { return 2; }
    std::uint32_t level(std::uint32_t k) const { return 3 * (levels() - k); }  // k from 0
    std::uint32_t scratch(std::uint32_t k) const { return level(k) + 1; }
    std::uint32_t lit() const { return 3 + 3 * levels(); }
    std::uint32_t probes() const { return lit() + 1; }
    std::uint32_t steps() const { return probes() + 1; }
    std::uint32_t levels() const { return static_cast<std::uint32_t>(shifts.size()); }
    // Of what level k is made from.
    std::uint32_t finerShift(std::uint32_t k) const { return k > 0 ? shifts[k - 1] : 0; }
};

// Finds the tiles that hold any of `triangles` (triangle + 1, 0: none) or a gutter, and lists them as seen.
// shifts: of each level.
AtlasTiles recordCoveredTiles(gpu::Device& device, gpu::Commands& commands, const gpu::Image& triangles,
                              std::span<const ChartRange> charts, std::vector<std::uint32_t> shifts,
                              const SeamLists& seams);

// Makes seen only the tiles in which the marked ones (1) of the skin's first triangles lie.
void recordSeenTiles(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene,
                     const gpu::Buffer& seenTriangles, AtlasTiles& tiles);

// From what is seen and from entry points, tile by tile, to all that is needed for it, texel by texel. taps: as recordDiffusion has them.
void recordNeededTiles(gpu::Device& device, gpu::Commands& commands, const SceneBuffers& scene, int taps,
                       AtlasTiles& tiles);

// The bindings of lib/atlas_tiles.glsl beside those given.
gpu::Bindings withTiles(gpu::Bindings bindings, const AtlasTiles& tiles);

// What to push, and where the group counts lie, for the tiles of one chart needed up to `step`.
shared::TilePush tilePush(const AtlasTiles& tiles, std::uint32_t chart, std::uint32_t step);
std::uint64_t tileGroups(const gpu::Program& program, const shared::TilePush& push, std::uint32_t shift = 0);

// A pass over the tiles needed up to `step`, chart by chart, with an invocation for each texel of 1/2^shift of
// the atlas' resolution, 64 or 256 a work group. Push begins with `TilePush tiles`, which is filled in.
template <class Push>
void dispatchTiles(gpu::Commands& commands, const gpu::Program& program, const gpu::Bindings& bindings,
                   Push push, const AtlasTiles& tiles, std::uint32_t step, std::uint32_t shift = 0) {
    const gpu::Bindings all = withTiles(bindings, tiles);
    for (std::uint32_t chart = 0; chart < tiles.receiverGroups.size(); ++chart) {
        if (!tiles.runsOn(chart)) continue;
        push.tiles = tilePush(tiles, chart, step);
        commands.dispatchIndirect(program, all, push, tiles.dispatches, tileGroups(program, push.tiles, shift));
    }
}

// Covered texels, all of them and those needed up to AtlasTiles::lit.
struct CoveredTexels {
    std::uint32_t all = 0, lit = 0;
};
CoveredTexels coveredTexels(const gpu::Readback& counts);  // of AtlasTiles::counts

}  // namespace cutis
