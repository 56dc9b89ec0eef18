// Visibility of a light sample from its light maps. The includer declares
//   sampler2DArrayShadow lightDepthCompare and, unless LIGHT_MAPS_COMPARE_ONLY, sampler2DArray lightDepth;
// with LIGHT_MAPS_PROJECTION_ONLY, neither.
#ifndef CUTIS_LIGHT_MAPS_GLSL
#define CUTIS_LIGHT_MAPS_GLSL

struct LightMapPoint {
    vec3 uvDepth;       // place in the map and depth to compare
    vec2 slope;         // change of depth with u and v over the receiver's plane
    float texel;        // width of a texel of the map there, metres
    float distance;     // along the view's axis, metres
    bool inside;
};

float lightMapDistance(LightView view, float depth) {
    return view.depthToDistance.y == 0.0 ? view.depthToDistance.z * depth
                                         : view.depthToDistance.x / (view.depthToDistance.y + view.depthToDistance.z * depth);
}

vec3 projectToLightMap(LightView view, vec3 p) {
    vec4 clip = view.worldToClip * vec4(p, 1.0);
    return clip.w > 0.0 ? vec3(clip.xy / clip.w * 0.5 + 0.5, clip.z / clip.w) : vec3(-1.0);
}

#ifndef LIGHT_MAPS_PROJECTION_ONLY

// p: point to light; n: its unit normal, towards the light's side; l: unit direction to the light.
LightMapPoint locateInLightMap(LightView view, vec3 p, vec3 n, vec3 l) {
    LightMapPoint at;
    vec3 here = projectToLightMap(view, p);
    at.distance = lightMapDistance(view, here.z);
    at.texel = view.texelSize * (view.depthToDistance.y == 0.0 ? 1.0 : at.distance);
    // Moving the receiver along its normal by the height that a slanted surface gains over one texel removes acne
    // without detaching shadows where light is perpendicular.
    float cosine = clamp(dot(n, l), 0.0, 1.0);
    vec3 lifted = p + n * (at.texel * (0.25 + 1.5 * sqrt(1.0 - cosine * cosine)));
    at.uvDepth = projectToLightMap(view, lifted);
    at.inside = all(greaterThanEqual(at.uvDepth.xy, vec2(0.0))) && all(lessThanEqual(at.uvDepth.xy, vec2(1.0))) &&
                at.uvDepth.z > 0.0;
    // The receiver's plane in map space, from two tangents; bounded, since it is vertical at the terminator.
    vec3 t, b;
    orthonormalBasis(n, t, b);
    vec3 dt = projectToLightMap(view, lifted + t * at.texel) - at.uvDepth;
    vec3 db = projectToLightMap(view, lifted + b * at.texel) - at.uvDepth;
    float det = dt.x * db.y - dt.y * db.x;
    float scale = length(dt.xy) * length(db.xy);
    if (abs(det) > 0.05 * scale && scale > 0.0) {
        at.slope = vec2(dt.z * db.y - db.z * dt.y, db.z * dt.x - dt.z * db.x) / det;
    } else {
        at.slope = vec2(0.0);
    }
    return at;
}

float compareLightMap(uint layer, LightMapPoint at, vec2 offset) {
    // A plane that falls towards the light is followed; one that rises is too, so that the receiver never shadows
    // itself within the filter.
    float depth = at.uvDepth.z + dot(at.slope, offset);
    return texture(lightDepthCompare, vec4(at.uvDepth.xy + offset, float(layer), clamp(depth, 0.0, 1.0)));
}

// Whether light of an orthographic view reaches p: one comparison, for many directions that are averaged. clearance: how
// far, in metres, what is drawn in the map may stand above the true surface. Where the map holds but the
// far sides of p's own surface (not its `ownSide`), p needs no lift, and what lies close above it casts its shadow.
bool lightMapReaches(LightView view, vec3 p, vec3 n, vec3 l, float clearance, bool ownSide) {
    float cosine = clamp(dot(n, l), 0.0, 1.0);
    float lift = clearance + view.texelSize * (0.25 + 1.5 * sqrt(1.0 - cosine * cosine));
    vec3 lifted = ownSide ? p + n * lift : p;
    vec3 at = (view.worldToClip * vec4(lifted, 1.0)).xyz;
    return texture(lightDepthCompare, vec4(at.xy * 0.5 + 0.5, float(view.layer), clamp(at.z, 0.0, 1.0))) > 0.5;
}

// Points that fill the unit disc evenly (Vogel 1979), one after the other: `heading` is turned by the golden angle, and
// begins as (1, 0).
vec2 nextOfDisc(inout vec2 heading, int i, int n) {
    vec2 point = heading * sqrt((float(i) + 0.5) / float(n));
    const float c = -0.7373688780783197, s = 0.6754902942615238;
    heading = vec2(heading.x * c - heading.y * s, heading.x * s + heading.y * c);
    return point;
}

#ifndef LIGHT_MAPS_COMPARE_ONLY
const float kWidestFilter = 48.0;  // texels

// The lit share of a light sample at p, in [0,1]. `extent` is the radius of the source in metres at `lightDistance`
// metres (directional: radians and 1): the blocker's distance makes the penumbra (Fernando 2005). What it is where the
// answer is not `wanted` does not matter.
float lightMapVisibility(LightView view, vec3 p, vec3 n, vec3 l, float extent, float lightDistance, bool directional,
                         bool wanted) {
    LightMapPoint at = locateInLightMap(view, p, n, l);
    vec2 texel = 1.0 / vec2(textureSize(lightDepth, 0).xy);
    float filterTexels = 0.75;  // radius; at the least the tent of three texels that hides the map's own steps
    const int kBlockers = 5, kTaps = 8;
    // No blocker nearer to the light than the map's near plane can widen the penumbra further than this.
    float gapLimit = max(at.distance - lightMapDistance(view, 0.0), 0.0);
    float reach = directional ? extent * gapLimit : extent * gapLimit / max(at.distance, 1e-12);
    float reachTexels = clamp(reach / at.texel, 1.0, kWidestFilter);
    float sum = 0.0, count = 0.0;
    // Loops end when no invocation goes on: that is all that a software device leaves out.
    vec2 heading = vec2(1.0, 0.0);
    int i = 0, end = wanted && at.inside && extent > 0.0 ? kBlockers : 1;
    do {
        vec2 offset = nextOfDisc(heading, i, kBlockers) * reachTexels * texel;
        float depth = textureLod(lightDepth, vec3(at.uvDepth.xy + offset, float(view.layer)), 0.0).x;
        bool blocks = depth < at.uvDepth.z + dot(at.slope, offset);
        sum += blocks ? lightMapDistance(view, depth) : 0.0;
        count += blocks ? 1.0 : 0.0;
    } while (++i < end);
    if (extent > 0.0) {
        float blocker = count > 0.0 ? sum / count : at.distance, gap = max(at.distance - blocker, 0.0);
        float radius = directional ? extent * gap : extent * gap / max(blocker, 1e-6);
        filterTexels = clamp(radius / at.texel, filterTexels, kWidestFilter);
    }
    heading = vec2(1.0, 0.0);
    float lit = compareLightMap(view.layer, at, nextOfDisc(heading, 0, kTaps) * filterTexels * texel);
    // Where all blockers and the first tap agree, no shadow's edge is near.
    bool edge = extent <= 0.0 || !(count == 0.0 && lit == 1.0 || count == float(kBlockers) && lit == 0.0);
    i = 1;
    end = wanted && at.inside && edge ? kTaps : 1;
    float taps = 1.0;
    do {
        float tap = compareLightMap(view.layer, at, nextOfDisc(heading, i, kTaps) * filterTexels * texel);
        lit += tap;
        taps += 1.0;
    } while (++i < end);
    return at.inside ? lit / taps : 1.0;
}

#endif

#endif

#endif
