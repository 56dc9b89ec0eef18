#version 460
// The other side of thin skin at each atlas texel, from that of the vertices around it.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/atlas_tiles.h"
#include "shared/scene.h"
#include "lib/geometry.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform utexture2D triangles;  // triangle + 1; 0: no surface
layout(binding = 1, scalar) readonly buffer IndexBuffer { uint indices[]; };
layout(binding = 2, scalar) readonly buffer AtlasVertexBuffer { AtlasVertex atlasVertices[]; };
layout(binding = 3, scalar) readonly buffer OppositeBuffer { OppositeVertex oppositeVertices[]; };
layout(binding = 4, rgba32f) writeonly uniform image2D opposite;  // xy: place in texels, x < 0: none; z: thickness, mm
layout(binding = 5) uniform texture2D position;
layout(binding = 6, scalar) readonly buffer DrawBuffer { DrawInfo draws[]; };
layout(binding = 7, scalar) readonly buffer GaussianBuffer { GaussianTerm gaussians[]; };
layout(binding = 8, scalar) buffer TileStateBuffer { AtlasTileState states[]; };

layout(push_constant, scalar) uniform Push {
    TilePush tiles;
    uint entryStep;  // of the tiles where light enters
} push;

#include "lib/atlas_tiles.glsl"
#include "lib/entry_tiles.glsl"

const float kNoThickness = 60000.0;

// Whether an average of two places means something: they lie on one island, about as far apart as on this side.
bool together(OppositeVertex a, OppositeVertex b, float reach) {
    return a.island == b.island && distance(a.texel, b.texel) < reach;
}

void main() {
    ivec2 texel;
    uint tile;
    if (!tileTexel(texel, tile)) return;
    vec4 found = vec4(-1.0, -1.0, kNoThickness, 0.0);
    uint id = texelFetch(triangles, texel, 0).x;
    if (id != 0u) {
        uvec3 v = uvec3(indices[id * 3u - 3u], indices[id * 3u - 2u], indices[id * 3u - 1u]);
        vec2 a = atlasVertices[v.x].texel, b = atlasVertices[v.y].texel, c = atlasVertices[v.z].texel;
        vec3 w = clampBarycentric(barycentricInPlane(vec2(texel) + 0.5, a, b, c));
        OppositeVertex oa = oppositeVertices[v.x], ob = oppositeVertices[v.y], oc = oppositeVertices[v.z];
        // The far side may be unwrapped more widely than this one.
        float reach = 4.0 + 8.0 * max(max(distance(a, b), distance(b, c)), distance(c, a));
        if (oa.island != 0.0 && together(oa, ob, reach) && together(ob, oc, reach) && together(oc, oa, reach)) {
            found.xy = w.x * oa.texel + w.y * ob.texel + w.z * oc.texel;
            found.z = w.x * oa.thickness + w.y * ob.thickness + w.z * oc.thickness;
        } else {
            // The nearest vertex that has another side.
            vec3 weight = w * vec3(oa.island != 0.0, ob.island != 0.0, oc.island != 0.0);
            OppositeVertex nearest = weight.x >= weight.y && weight.x >= weight.z ? oa : weight.y >= weight.z ? ob : oc;
            if (nearest.island != 0.0) found.xyz = vec3(nearest.texel, nearest.thickness);
        }
    }
    imageStore(opposite, texel, found);
    if (found.x >= 0.0) markEntry(found.xy, found.z, push.entryStep);
}
