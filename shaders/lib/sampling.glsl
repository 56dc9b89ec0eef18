// Directions: frames, cube faces and microfacet quantiles.
#ifndef CUTIS_SAMPLING_GLSL
#define CUTIS_SAMPLING_GLSL

// Columns: tangent x along the part of `v` that is perpendicular to the unit normal n (any perpendicular when there is
// none), bitangent, n.
mat3 frameAlong(vec3 n, vec3 v) {
    vec3 x = v - n * dot(n, v);
    if (dot(x, x) < 1e-8) x = abs(n.x) < 0.7 ? vec3(1.0, 0.0, 0.0) - n * n.x : vec3(0.0, 1.0, 0.0) - n * n.y;
    x = normalize(x);
    return mat3(x, cross(n, x), n);
}

// A cube face as Vulkan orders and turns them (Vulkan 1.3 specification, table "Cube map face and coordinate selection"):
// the point st ∈ [-1,1]² of it lies in direction axis + s·right + t·down.
struct CubeFace {
    vec3 right, down, axis;
};

CubeFace cubeFace(uint face) {
    if (face == 0u) return CubeFace(vec3(0.0, 0.0, -1.0), vec3(0.0, -1.0, 0.0), vec3(1.0, 0.0, 0.0));
    if (face == 1u) return CubeFace(vec3(0.0, 0.0, 1.0), vec3(0.0, -1.0, 0.0), vec3(-1.0, 0.0, 0.0));
    if (face == 2u) return CubeFace(vec3(1.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0), vec3(0.0, 1.0, 0.0));
    if (face == 3u) return CubeFace(vec3(1.0, 0.0, 0.0), vec3(0.0, 0.0, -1.0), vec3(0.0, -1.0, 0.0));
    if (face == 4u) return CubeFace(vec3(1.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0), vec3(0.0, 0.0, 1.0));
    return CubeFace(vec3(-1.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0), vec3(0.0, 0.0, -1.0));
}

// Not normalised.
vec3 cubeDirection(CubeFace face, vec2 st) {
    return face.axis + st.x * face.right + st.y * face.down;
}

// Centre of a texel of a face of n × n texels, in [-1,1]².
vec2 cubeTexelCentre(uvec2 texel, uint n) {
    return (vec2(texel) + 0.5) * (2.0 / float(n)) - 1.0;
}

// Solid angle of a texel of a cube face of n × n texels whose centre is at st: dω = 4/n² / (1 + s² + t²)^1.5.
float cubeTexelSolidAngle(vec2 st, uint n) {
    return 4.0 / float(n * n) * pow(1.0 + dot(st, st), -1.5);
}

// Point k of n of a spiral that covers the unit disc evenly (Vogel 1979): x the fraction of the area within, in (0,1),
// y the angle.
vec2 spiralPoint(int k, int n) {
    return vec2((float(k) + 0.5) / float(n), 2.39996323 * float(k));
}

#endif
