// Triangles, their attributes, and where a ray or a texel meets them.
#ifndef CUTIS_GEOMETRY_GLSL
#define CUTIS_GEOMETRY_GLSL

struct Triangle {
    uvec3 vertex;
    vec3 a, b, c;
};

// Barycentric coordinates of the point where the line origin + t·direction meets the plane of the triangle.
vec3 barycentricOnRay(Triangle triangle, vec3 origin, vec3 direction) {
    vec3 e1 = triangle.b - triangle.a, e2 = triangle.c - triangle.a;
    vec3 p = cross(direction, e2);
    float det = dot(e1, p);
    // A triangle seen edge-on covers no area: any point of it will do.
    if (abs(det) < 1e-30) return vec3(1.0 / 3.0);
    vec3 s = origin - triangle.a;
    float u = dot(s, p) / det;
    float v = dot(direction, cross(s, e1)) / det;
    return vec3(1.0 - u - v, u, v);
}

// Barycentric coordinates of a point in a plane triangle given by three points.
vec3 barycentricInPlane(vec2 point, vec2 a, vec2 b, vec2 c) {
    vec2 e1 = b - a, e2 = c - a, s = point - a;
    float det = e1.x * e2.y - e1.y * e2.x;
    if (abs(det) < 1e-30) return vec3(1.0 / 3.0);
    float u = (s.x * e2.y - s.y * e2.x) / det;
    float v = (e1.x * s.y - e1.y * s.x) / det;
    return vec3(1.0 - u - v, u, v);
}

// The point of the triangle that stands for coordinates outside it.
vec3 clampBarycentric(vec3 w) {
    w = max(w, 0.0);
    return w / (w.x + w.y + w.z);
}

vec3 interpolate(vec3 w, vec3 a, vec3 b, vec3 c) { return w.x * a + w.y * b + w.z * c; }
vec2 interpolate(vec3 w, vec2 a, vec2 b, vec2 c) { return w.x * a + w.y * b + w.z * c; }
vec4 interpolate(vec3 w, vec4 a, vec4 b, vec4 c) { return w.x * a + w.y * b + w.z * c; }

// normalize() that answers `fallback` where there is no direction.
vec3 safeNormalize(vec3 v, vec3 fallback) {
    float scale = max(abs(v.x), max(abs(v.y), abs(v.z)));
    if (!(scale > 0.0)) return fallback;
    v /= scale;
    return v * inversesqrt(dot(v, v));
}

// Two unit vectors that complete n to an orthonormal basis (Duff et al. 2017).
void orthonormalBasis(vec3 n, out vec3 t, out vec3 b) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float c = n.x * n.y * a;
    t = vec3(1.0 + s * n.x * n.x * a, s * c, -s * n.x);
    b = vec3(c, s + n.y * n.y * a, -n.y);
}

// A normal that looks away from the viewer, by interpolation or by a map, is bent back to the horizon.
vec3 facingNormal(vec3 n, vec3 view, vec3 smoothNormal) {
    float facing = dot(n, view);
    return facing < 0.02 ? safeNormalize(n + view * (0.02 - facing), smoothNormal) : n;
}

#endif
