// What arrives from a light sample, visibility aside.
#ifndef CUTIS_LIGHTS_GLSL
#define CUTIS_LIGHTS_GLSL

struct Incident {
    vec3 direction;    // unit, to the light
    float distance;    // metres; 1 when directional
    vec3 irradiance;   // on a surface that faces the light
};

Incident incidentLight(LightSampleData light, vec3 p) {
    Incident incident;
    if ((light.flags & LIGHT_DIRECTIONAL) != 0u) {
        incident.direction = -light.direction;
        incident.distance = 1.0;
        incident.irradiance = light.intensity;
        return incident;
    }
    vec3 d = light.position - p;
    // Scaled by its largest component, so that neither tiny nor huge distances leave the range of floats.
    float scale = max(max(abs(d.x), abs(d.y)), max(abs(d.z), 1e-18));
    vec3 unit = d / scale;
    float len = length(unit);
    incident.direction = len > 0.0 ? unit / len : -light.direction;
    incident.distance = max(len, 1e-18) * scale;
    float cosine = -dot(incident.direction, light.direction);
    vec3 e = light.intensity / incident.distance;
    if ((light.flags & LIGHT_COSINE) != 0u) {
        // A piece of a rect light, 2 radius wide: irradianceFrom in scene/light_samples.h.
        float across = light.radius / incident.distance;
        e *= max(cosine, 0.0) / (1.0 + 4.0 / 3.14159265358979 * across * across * max(3.0 * cosine * cosine - 2.0, 0.0));
    }
    e /= incident.distance;
    if (light.cosOuter > -1.0) {
        float t = clamp((cosine - light.cosOuter) / max(light.cosInner - light.cosOuter, 1e-6), 0.0, 1.0);
        e *= t * t;  // KHR_lights_punctual's recommended falloff
    }
    if (light.range > 0.0) {
        float x = incident.distance / light.range;
        e *= clamp(1.0 - x * x * x * x, 0.0, 1.0);
    }
    incident.irradiance = e;
    return incident;
}

#endif
