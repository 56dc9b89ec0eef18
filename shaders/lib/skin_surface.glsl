// Skin as the eye sees it: diffused light from the exitance texture, and what its surface reflects. Part of shade.comp.
#ifndef CUTIS_SKIN_SURFACE_GLSL
#define CUTIS_SKIN_SURFACE_GLSL

layout(constant_id = 3) const uint LAYERS = LAYER_SECOND_LOBE;  // LAYER_ bits: what no skin of the scene has is not compiled

// The two lobes of a point's specular layer.
struct SkinLobes {
    vec3 n;          // with pores
    float narrowed;  // share of the rms slope m that pores leave to the first lobe, and to the second
    float narrowed2;
    float scale;     // of f_s: s, less where it would reflect more than arrives
};

// f_s at specular scale 1.
float skinSpecular(Material material, SkinLobes lobes, vec3 view, vec3 l) {
    float f = kelemenSpecular(lobes.n, view, l, material.slope * lobes.narrowed);
    if ((LAYERS & LAYER_SECOND_LOBE) != 0u && material.lobeWeight > 0.0) {
        f = mix(f, kelemenSpecular(lobes.n, view, l, material.slope2 * lobes.narrowed2), material.lobeWeight);
    }
    return f;
}

#ifdef ENVIRONMENT
vec3 skinEnvironment(Material material, SkinLobes lobes, vec3 view) {
    float mu = clamp(dot(lobes.n, view), 1e-3, 1.0), albedo = directionalAlbedo(mu, material.albedoRow);
    if ((LAYERS & LAYER_SECOND_LOBE) == 0u) {
        return environmentSpecularSkin(lobes.n, view, material.slope, lobes.narrowed, lobes.scale, lobes.scale * albedo,
                                       material.albedoRow, true);
    }
    // The row of the first lobe holds the albedo of both.
    float share = material.lobeWeight, second = share * directionalAlbedo(mu, material.albedoRow2);
    return environmentSpecularSkin(lobes.n, view, material.slope, lobes.narrowed, lobes.scale * (1.0 - share),
                                   lobes.scale * (albedo - second), material.albedoRow, true) +
           environmentSpecularSkin(lobes.n, view, material.slope2, lobes.narrowed2, lobes.scale * share,
                                   lobes.scale * second, material.albedoRow2, share > 0.0);
}
#endif

// detailed: n with pores; removed: E|s|² that they take from the roughness.
void shadeSkin(inout Shade shade, Material material, vec2 atlasTexel, float island, vec3 p, vec3 smoothNormal, vec3 n,
               vec3 detailed, float removed, vec3 view) {
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
    SkinLobes lobes;
    lobes.n = detailed;
    lobes.narrowed = removed > 0.0 ? sqrt(max(1.0 - removed / (material.slope * material.slope), 0.25)) : 1.0;
    lobes.narrowed2 = lobes.narrowed;
    if ((LAYERS & LAYER_SECOND_LOBE) != 0u && removed > 0.0) {
        lobes.narrowed2 = sqrt(max(1.0 - removed / (material.slope2 * material.slope2), 0.25));
    }
    lobes.scale = clampedSpecularScale(material.specularScale,
                                       directionalAlbedo(max(dot(detailed, view), 1e-4), material.albedoRow));
    float visible = 1.0;
    uint current = 0xffffffffu;
    for (uint i = 0u; i < push.lightCount; ++i) {
        LightSampleData light = lights[i];
        Incident from = incidentLight(light, p);
        float cosine = dot(detailed, from.direction);
#ifdef SHADOWS
        // The share of each light that the irradiance pass found to arrive: of all its samples together.
        if (light.light != current) {
            current = light.light;
            visible = lightShare(lightVisibility, at, int(current));
        }
#endif
        if (cosine <= 0.0 || dot(smoothNormal, from.direction) <= 0.0) continue;
        float f = skinSpecular(material, lobes, view, from.direction);
        shade.specular += from.irradiance * (cosine * lobes.scale * f * visible);
    }
#ifdef ENVIRONMENT
    vec4 open = textureLod(openSky, atlasTexel / vec2(textureSize(exitance, 0)), 0.0);
    setSky(open.a > 0.0 ? open.xyz / open.a : smoothNormal, smoothNormal);
    shade.specular += skinEnvironment(material, lobes, view);
#endif
}

#endif
