#version 460
// What each pixel has to shade. Samples of a pixel that see one smooth piece of surface become one shading point; the
// points of skin and those of everything else are listed apart, so that each kind is shaded by a program of its own
// with every invocation at work.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/scene.h"
#include "lib/geometry.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform utexture2DArray triangles;  // a layer of surfaces from the nearest; triangle + 1
layout(binding = 1, scalar) readonly buffer IndexBuffer { uint indices[]; };
layout(binding = 2, scalar) readonly buffer PositionBuffer { vec3 positions[]; };
layout(binding = 3, scalar) readonly buffer TriangleDrawBuffer { uint triangleDraws[]; };
layout(binding = 4, scalar) readonly buffer DrawBuffer { DrawInfo draws[]; };
layout(binding = 5, scalar) writeonly buffer PointBuffer { ShadingPoint points[]; };
layout(binding = 6, scalar) writeonly buffer SkinListBuffer { uint skinList[]; };    // of points
layout(binding = 7, scalar) writeonly buffer OtherListBuffer { uint otherList[]; };  // of points
layout(binding = 8, scalar) buffer CountBuffer {
    uint pointCount, skinCount, otherCount;
};
layout(binding = 9, rg32ui) writeonly uniform uimage2D pixels;  // first point and number of points of each pixel

layout(push_constant, scalar) uniform Push {
    ivec2 tileSize;     // pixels
    int supersampling;  // samples of `triangles` a pixel, along each axis
    int layers;         // of `triangles`
} push;

const int MAX_SAMPLES = 16;

ivec2 cellOf(int s) { return ivec2(s % push.supersampling, s / push.supersampling); }

uint triangleAt(ivec2 pixel, int s, int layer) {
    return texelFetch(triangles, ivec3(pixel * push.supersampling + cellOf(s), layer), 0).x;
}

vec2 placeOf(int s) { return (vec2(cellOf(s)) + 0.5) / float(push.supersampling); }

struct Facet {
    vec3 corner, normal;
    float size;
};

Facet facetOf(uint triangle) {
    vec3 a = positions[indices[triangle * 3u]], b = positions[indices[triangle * 3u + 1u]],
         c = positions[indices[triangle * 3u + 2u]];
    return Facet(a, safeNormalize(cross(b - a, c - a), vec3(0.0)), length(b - a) + length(c - a));
}

// Whether two triangles can be shaded as one: neighbours on a surface that hardly bends.
bool alike(uint first, uint second) {
    if (first == second) return true;
    if (triangleDraws[first] != triangleDraws[second]) return false;
    Facet a = facetOf(first), b = facetOf(second);
    return dot(a.normal, b.normal) > 0.85 && distance(a.corner, b.corner) < 2.0 * (a.size + b.size);
}

void append(uint index, ShadingPoint point, bool data) {
    points[index] = point;
    uint entry = index | (data ? POINT_DATA : 0u);
    if (draws[triangleDraws[point.triangle]].chart != NO_CHART) {
        skinList[atomicAdd(skinCount, 1u)] = entry;
    } else {
        otherList[atomicAdd(otherCount, 1u)] = entry;
    }
}

// Everything opaque: one point for each group of like samples, at their mean place.
void collectGroups(ivec2 pixel, uint packedPixel) {
    int total = push.supersampling * push.supersampling;
    uint leader[MAX_SAMPLES];
    ivec2 place[MAX_SAMPLES];  // sums, in samples
    int size[MAX_SAMPLES];
    int group[MAX_SAMPLES];  // of each sample; -1: sees nothing
    uint seen[MAX_SAMPLES];  // by each sample
    int groups = 0, largest = 0;
    for (int s = 0; s < total; ++s) {
        uint id = triangleAt(pixel, s, push.layers - 1);
        group[s] = -1;
        if (id == 0u) continue;
        int g = 0;
        while (g < groups && !alike(leader[g], id - 1u)) ++g;
        if (g == groups) {
            leader[g] = id - 1u;
            place[g] = ivec2(0);
            size[g] = 0;
            ++groups;
        }
        group[s] = g;
        seen[s] = id - 1u;
        place[g] += cellOf(s);
        ++size[g];
        if (size[g] > size[largest]) largest = g;
    }
    uint first = groups > 0 ? atomicAdd(pointCount, uint(groups)) : 0u;
    for (int g = 0; g < groups; ++g) {
        // Of its triangles the group is shaded on the one that is seen nearest to its mean place: in whole numbers, so
        // that ties are broken alike on every device.
        vec2 mean = (vec2(place[g]) / float(size[g]) + 0.5) / float(push.supersampling);
        int nearest = 0x7fffffff;
        for (int s = 0; s < total; ++s) {
            ivec2 apart = cellOf(s) * size[g] - place[g];
            int squared = apart.x * apart.x + apart.y * apart.y;
            if (group[s] == g && squared < nearest) nearest = squared, leader[g] = seen[s];
        }
        append(first + uint(g),
               ShadingPoint(leader[g], packedPixel, packUnorm2x16(mean),
                            float(size[g]) / float(total)),
               g == largest);
    }
    imageStore(pixels, pixel, uvec4(first, uint(groups), 0u, 0u));
}

// Whether two samples see like surfaces one behind the other.
bool alikeStacks(ivec2 pixel, int first, int second) {
    for (int layer = 0; layer < push.layers; ++layer) {
        uint a = triangleAt(pixel, first, layer), b = triangleAt(pixel, second, layer);
        if ((a == 0u) != (b == 0u) || (a != 0u && !alike(a - 1u, b - 1u))) return false;
    }
    return true;
}

// With surfaces that are seen through: the same for whole stacks of surfaces. A group is as many points as its stack has
// surfaces, from the nearest; a negative weight says that a point lies behind the one before it.
void collectLayers(ivec2 pixel, uint packedPixel) {
    int total = push.supersampling * push.supersampling;
    int leader[MAX_SAMPLES];  // sample
    ivec2 place[MAX_SAMPLES];
    int size[MAX_SAMPLES];
    int group[MAX_SAMPLES];
    int groups = 0;
    for (int s = 0; s < total; ++s) {
        int g = 0;
        while (g < groups && !alikeStacks(pixel, leader[g], s)) ++g;
        if (g == groups) {
            leader[g] = s;
            place[g] = ivec2(0);
            size[g] = 0;
            ++groups;
        }
        group[s] = g;
        place[g] += cellOf(s);
        ++size[g];
    }
    // Data channels show the largest group that sees something opaque, or else anything.
    uint count = 0u;
    int shown = -1;
    bool shownOpaque = false;
    for (int g = 0; g < groups; ++g) {
        uint surfaces = 0u;
        for (int layer = 0; layer < push.layers; ++layer) surfaces += triangleAt(pixel, leader[g], layer) != 0u ? 1u : 0u;
        count += surfaces;
        if (surfaces == 0u) continue;
        bool opaque = triangleAt(pixel, leader[g], push.layers - 1) != 0u;
        if (shown < 0 || (opaque && !shownOpaque) || (opaque == shownOpaque && size[g] > size[shown])) {
            shown = g;
            shownOpaque = opaque;
        }
    }
    uint first = count > 0u ? atomicAdd(pointCount, count) : 0u, next = first;
    for (int g = 0; g < groups; ++g) {
        vec2 mean = (vec2(place[g]) / float(size[g]) + 0.5) / float(push.supersampling);
        int nearest = 0x7fffffff, seen = leader[g];
        for (int s = 0; s < total; ++s) {
            ivec2 apart = cellOf(s) * size[g] - place[g];
            int squared = apart.x * apart.x + apart.y * apart.y;
            if (group[s] == g && squared < nearest) nearest = squared, seen = s;
        }
        float weight = float(size[g]) / float(total);
        bool front = true;
        for (int layer = 0; layer < push.layers; ++layer) {
            uint id = triangleAt(pixel, seen, layer);
            if (id == 0u) continue;
            bool fills = g == shown && (shownOpaque ? layer == push.layers - 1 : front);
            append(next++, ShadingPoint(id - 1u, packedPixel, packUnorm2x16(mean), front ? weight : -weight), fills);
            front = false;
        }
    }
    imageStore(pixels, pixel, uvec4(first, count, 0u, 0u));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, push.tileSize))) return;
    uint packedPixel = uint(pixel.x) | uint(pixel.y) << 16;
    // The nearest of the layers behind which more is seen is empty where nothing is seen through.
    bool layered = false;
    if (push.layers > 1) {
        int total = push.supersampling * push.supersampling;
        for (int s = 0; s < total; ++s) layered = layered || triangleAt(pixel, s, 0) != 0u;
    }
    if (layered) {
        collectLayers(pixel, packedPixel);
    } else {
        collectGroups(pixel, packedPixel);
    }
}
