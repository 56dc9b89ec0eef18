// Environment visibility is kept at half the atlas resolution: the texel that stands for a block of 2 × 2.
#ifndef CUTIS_ENVIRONMENT_PROBE_GLSL
#define CUTIS_ENVIRONMENT_PROBE_GLSL

#ifndef VERTICES
// The first covered texel of the block, or (-1, -1). `position` is declared by the includer.
ivec2 probeTexel(ivec2 probe) {
    ivec2 last = textureSize(position, 0) - 1, found = ivec2(-1);
    for (int i = 3; i >= 0; --i) {
        ivec2 texel = probe * 2 + ivec2(i & 1, i >> 1);
        bool covered = texelFetch(position, min(texel, last), 0).w > 0.0 && texel == min(texel, last);
        found = covered ? texel : found;
    }
    return found;
}

// Where the probe of a block lies: the mean over those of its texels that continue the surface of its first one, so that
// it stands for the whole block. normals: smooth (xy) and with normal map (zw), octahedral.
struct ProbePoint {
    vec3 position, smoothNormal, mappedNormal;
};

ProbePoint probePoint(ivec2 probe, ivec2 first) {
    ivec2 last = textureSize(position, 0) - 1;
    float draw = texelFetch(position, first, 0).w;
    vec3 facing = decodeOctahedral(texelFetch(normal, first, 0).xy);
    vec4 place = vec4(0.0);
    ProbePoint point = ProbePoint(vec3(0.0), vec3(0.0), vec3(0.0));
    for (int i = 0; i < 4; ++i) {
        ivec2 texel = min(probe * 2 + ivec2(i & 1, i >> 1), last);
        vec4 at = texelFetch(position, texel, 0), normals = texelFetch(normal, texel, 0);
        vec3 s = decodeOctahedral(normals.xy);
        float w = at.w == draw && dot(s, facing) > 0.7 ? 1.0 : 0.0;
        place += w * vec4(at.xyz, 1.0);
        point.smoothNormal += w * s;
        point.mappedNormal += w * decodeOctahedral(normals.zw);
    }
    point.position = place.xyz / max(place.w, 1.0);
    point.smoothNormal = safeNormalize(point.smoothNormal, facing);
    point.mappedNormal = safeNormalize(point.mappedNormal, facing);
    return point;
}
#endif

#endif
