// What is not skin at one point, with all textures read: glTF metallic-roughness and what its extensions lay
// over it (docs/model.md, "Everything else"). shaders/lib/other_surface.glsl is the twin.
#pragma once

#include <glm/glm.hpp>

#include "renderer/reference/ray_scene.h"

namespace cutis::reference {

struct Layers {
    glm::dvec3 albedo{1};  // base colour in [0,1]
    double metallic = 0, alpha = 1;
    glm::dvec3 deepF0{0.04};  // Fresnel of the dielectric at normal incidence, and at grazing angles
    double deepF90 = 1;
    double transmission = 0;  // in [0,1]
    glm::dvec3 sheen{0};      // colour
    double sheenRoughness = 1;
    double coat = 0, coatAlpha = 1;
    double occlusion = 1;  // share of the environment

    // Fresnel of metal and dielectric together at V·H.
    glm::dvec3 fresnel(double cosine) const;
    // What the dielectric's reflection leaves for what lies below it.
    double belowFresnel(double cosine) const;
    // The share of everything below that the sheen leaves, at N·V.
    double belowSheen(double cosine) const;
    // The share of light that the coat reflects, at N·V of its own normal.
    double coatReflection(double cosine) const;
    // The share of light that goes straight through all layers, at N·V of the surface and of the coat.
    glm::dvec3 through(double cosine, double coatCosine) const;
};

// `base`: base colour there, textures and vertex colours multiplied.
Layers layersAt(const Hit& hit, const glm::dvec4& base);

// The share of light along a ray that passes the surface of a hit, in [0,1]: what it does not cover, and what
// goes through the rest. cosine: between the ray and the normal of the triangle.
glm::dvec3 lightThrough(const Hit& hit, double cosine);

// The sheen's lobe D · V at colour 1, in 1/sr, scaled so that it reflects no more than arrives.
double sheenLobe(const glm::dvec3& n, const glm::dvec3& v, const glm::dvec3& l, double roughness);
// ∫ D V (N·L) dω at N·V = μ, not scaled: by quadrature, then from a table.
double sheenAlbedo(double mu, double roughness);

}  // namespace cutis::reference
