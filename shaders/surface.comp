#version 460
// The surface behind each atlas texel: position, normals, albedo and the shape of a millimetre in texels.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
// features: TEXTURED
#include "shared/atlas_tiles.h"
#include "shared/scene.h"
#include "lib/geometry.glsl"
#include "lib/metric.glsl"
#include "lib/octahedral.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform utexture2D triangles;  // triangle + 1; 0: no surface
layout(binding = 1, scalar) readonly buffer IndexBuffer { uint indices[]; };
layout(binding = 2, scalar) readonly buffer PositionBuffer { vec3 positions[]; };
layout(binding = 3, scalar) readonly buffer AttributeBuffer { VertexAttributes attributes[]; };
layout(binding = 4, scalar) readonly buffer AtlasVertexBuffer { AtlasVertex atlasVertices[]; };
layout(binding = 5, scalar) readonly buffer TriangleDrawBuffer { uint triangleDraws[]; };
layout(binding = 6, scalar) readonly buffer DrawBuffer { DrawInfo draws[]; };
layout(binding = 7, scalar) readonly buffer MaterialBuffer { Material materials[]; };
layout(binding = 8, rgba32f) writeonly uniform image2D position;  // xyz: metres; w: draw + 1, 0 where uncovered
layout(binding = 9, rgba16f) writeonly uniform image2D normal;    // octahedral: smooth (xy), with normal map (zw)
layout(binding = 10, rgba16f) writeonly uniform image2D albedo;   // rgb
layout(binding = 11, rgba32f) writeonly uniform image2D stretch;  // Cholesky factor of (JᵀJ)⁻¹: a, b, c; w: island
layout(binding = 13, scalar) buffer TileStateBuffer { AtlasTileState states[]; };
#ifdef TEXTURED
layout(binding = 12) uniform sampler2DArray materialTextures[MAX_TEXTURE_GROUPS];
#include "lib/material_textures.glsl"
#endif

layout(push_constant, scalar) uniform Push {
    TilePush tiles;
} push;

#include "lib/atlas_tiles.glsl"
#include "lib/tile_stretch.glsl"

// Where a texel's shading point lies for a smooth surface: outside the flat triangle wherever its vertex normals
// say that the surface bulges (Hanika 2021), so that coarse triangles do not shadow themselves at the terminator.
vec3 smoothPosition(vec3 p, vec3 w, Triangle t, vec3 na, vec3 nb, vec3 nc) {
    vec3 a = p - min(0.0, dot(p - t.a, na)) * na;
    vec3 b = p - min(0.0, dot(p - t.b, nb)) * nb;
    vec3 c = p - min(0.0, dot(p - t.c, nc)) * nc;
    return interpolate(w, a, b, c);
}

void main() {
    ivec2 texel;
    uint tile;
    if (!tileTexel(texel, tile)) return;
    uint id = texelFetch(triangles, texel, 0).x;
    if (id == 0u) {
        imageStore(position, texel, vec4(0.0));
        imageStore(normal, texel, vec4(0.0));
        imageStore(albedo, texel, vec4(0.0));
        imageStore(stretch, texel, vec4(0.0));
        return;
    }
    uint triangleIndex = id - 1u;
    uint drawIndex = triangleDraws[triangleIndex];
    Material material = materials[draws[drawIndex].material];
    uvec3 v = uvec3(indices[triangleIndex * 3u], indices[triangleIndex * 3u + 1u], indices[triangleIndex * 3u + 2u]);
    Triangle triangle = Triangle(v, positions[v.x], positions[v.y], positions[v.z]);
    AtlasVertex aa = atlasVertices[v.x], ab = atlasVertices[v.y], ac = atlasVertices[v.z];
    vec2 centre = vec2(texel) + 0.5;
    vec3 w = clampBarycentric(barycentricInPlane(centre, aa.texel, ab.texel, ac.texel));

    VertexAttributes va = attributes[v.x], vb = attributes[v.y], vc = attributes[v.z];
    vec3 p = interpolate(w, triangle.a, triangle.b, triangle.c);
    vec3 face = safeNormalize(cross(triangle.b - triangle.a, triangle.c - triangle.a), va.normal);
    vec3 n = safeNormalize(interpolate(w, va.normal, vb.normal, vc.normal), face);
    p = smoothPosition(p, w, triangle, va.normal, vb.normal, vc.normal);

    vec4 color = interpolate(w, va.color, vb.color, vc.color);
    vec3 rho = material.baseColor.rgb * color.rgb;
    vec3 mapped = n;
#ifdef TEXTURED
    // Texture coordinates one texel to the right and below give the footprint of this texel.
    vec3 wx = barycentricInPlane(centre + vec2(1, 0), aa.texel, ab.texel, ac.texel);
    vec3 wy = barycentricInPlane(centre + vec2(0, 1), aa.texel, ab.texel, ac.texel);
    SurfaceUv uv = surfaceUv(w, wx, wy, va, vb, vc);
    if ((TEXTURE_SLOTS & SLOT_BASE_COLOR) != 0u && material.baseColorTexture.group >= 0) rho *= sampleMaterial(material.baseColorTexture, uv).rgb;
    if ((TEXTURE_SLOTS & SLOT_NORMAL) != 0u && material.normalTexture.group >= 0) {
        vec4 tangent = interpolate(w, va.tangent, vb.tangent, vc.tangent);
        mapped = mappedNormal(n, tangent, sampleMaterial(material.normalTexture, uv).xy, material.normalScale);
    }
#endif
    imageStore(position, texel, vec4(p, float(drawIndex + 1u)));
    imageStore(normal, texel, vec4(encodeOctahedral(n), encodeOctahedral(mapped)));
    imageStore(albedo, texel, vec4(clamp(rho, 0.0, 1.0), 1.0));
    vec3 metric = interpolate(w, aa.metric, ab.metric, ac.metric);
    vec3 factor = inverseMetricFactor(metric);
    imageStore(stretch, texel, vec4(factor, aa.island));
    noteStretch(tile, factor);
}
