// Skin as the eye sees it: diffused light from the exitance texture, and what its surface reflects. Part of shade.comp.
#ifndef CUTIS_SKIN_SURFACE_GLSL
#define CUTIS_SKIN_SURFACE_GLSL

void shadeSkin(inout Shade shade, Material material, vec2 atlasTexel, float island, vec3 p, vec3 smoothNormal, vec3 n, vec3 view) {
    // Facing away from the viewer by the normal map alone: the closest direction that is still seen.
    float mu = max(dot(n, view), 1e-4);
    AtlasLookup at = atlasLookup(exitance, surfaceNormal, atlasTexel, island, smoothNormal);
    vec3 m = lookUp(exitance, at).rgb;
    vec3 after = material.mix >= 1.0 ? vec3(1.0) : pow(shade.albedo, vec3(1.0 - material.mix));
    float through = transmittedFraction(mu, material.specularScale, material.albedoRow) /
                    max(1.0 - material.meanAlbedo, 1e-4);
    shade.diffuse += after * m / kPi * through;
#ifdef AOVS
    shade.irradiance = lookUp(incident, at).rgb;
    shade.atlas = vec3(atlasTexel, 1.0);
    shade.thickness = texelFetch(incident, clamp(ivec2(atlasTexel), ivec2(0), textureSize(incident, 0) - 1), 0).a;
#endif
    float scale = clampedSpecularScale(material.specularScale, directionalAlbedo(mu, material.albedoRow));
    float visible = 1.0;
    uint current = 0xffffffffu;
    for (uint i = 0u; i < push.lightCount; ++i) {
        LightSampleData light = lights[i];
        Incident from = incidentLight(light, p);
        float cosine = dot(n, from.direction);
#ifdef SHADOWS
        // The share of each light that the irradiance pass found to arrive: of all its samples together.
        if (light.light != current) {
            current = light.light;
            visible = lightShare(lightVisibility, at, int(current));
        }
#endif
        if (cosine <= 0.0 || dot(smoothNormal, from.direction) <= 0.0) continue;
        float lobe = kelemenSpecular(n, view, from.direction, material.slope);
        shade.specular += from.irradiance * (cosine * scale * lobe * visible);
    }
#ifdef ENVIRONMENT
    vec4 open = textureLod(openSky, atlasTexel / vec2(textureSize(exitance, 0)), 0.0);
    setSky(open.a > 0.0 ? open.xyz / open.a : smoothNormal, smoothNormal);
    shade.specular += environmentSpecularSkin(n, view, material.slope, material.specularScale, material.albedoRow);
#endif
}

#endif
