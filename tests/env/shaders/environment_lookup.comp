#version 460
// Evaluates lib/environment.glsl for a list of normals and views.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/environment.h"
#include "shared/scene.h"

layout(local_size_x = 64) in;

struct Query {
    vec3 normal, view;
};

layout(binding = 0, scalar) readonly buffer QueryBuffer { Query queries[]; };
layout(binding = 1, scalar) writeonly buffer ResultBuffer { vec3 results[]; };
layout(binding = 2, scalar) readonly buffer EnvironmentBuffer {
    EnvironmentSettingsData environment;
    EnvironmentSource environmentSources[];
};
layout(binding = 3, scalar) readonly buffer AlbedoTableBuffer { float albedoTable[]; };
layout(binding = 4) uniform samplerCube environmentIrradiance;
layout(binding = 5) uniform samplerCubeArray environmentRadiance;
layout(binding = 6) uniform samplerCubeArray environmentMatte;
#define ALBEDO_TABLE(i) albedoTable[i]
float environmentVisibility(vec3 direction) {
    return 1.0;
}
#include "lib/environment.glsl"

layout(push_constant, scalar) uniform Push {
    uint what;    // 0 irradiance, 1 matte, 2 skin specular, 3 GGX specular, 4 radiance
    uint count;
    float roughness;  // m or alpha
    float scale;      // s or F0
} push;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    vec3 n = queries[i].normal, v = queries[i].view;
    vec3 result;
    if (push.what == 0u) {
        result = environmentIrradianceAt(n);
    } else if (push.what == 1u) {
        result = textureLod(environmentMatte, vec4(toEnvironment(n), 0.0), 0.0).rgb * environment.intensity;
    } else if (push.what == 2u) {
        float albedo = directionalAlbedo(clamp(dot(n, v), 1e-3, 1.0), 0u), scale = clampedSpecularScale(push.scale, albedo);
        result = environmentSpecularSkin(n, v, push.roughness, 1.0, scale, scale * albedo, 0u, true);
    } else if (push.what == 3u) {
        result = environmentSpecularGgx(n, v, push.roughness, vec3(push.scale), vec3(1.0), true);
    } else {
        result = environmentRadianceAt(n, environmentLobeNumber(push.roughness), ENVIRONMENT_ALL);
    }
    results[i] = result;
}
