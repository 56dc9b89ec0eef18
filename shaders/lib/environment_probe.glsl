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
#endif

#endif
