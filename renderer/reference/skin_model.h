// What one skin material says, ready for evaluation. Lengths are scene units (metres, as a rule).
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.h"

namespace cutis::reference {

class SkinModel {
  public:
    // With gaussians > 0 the profile is reduced to so many.
    SkinModel(const SkinMaterial& material, int gaussians);

    struct Term {
        double variance;     // scene units²
        glm::dvec3 weight;   // RGB
        double probability;  // of sampling this Gaussian
    };

    const SkinMaterial& material() const { return material_; }
    const std::vector<Term>& terms() const { return terms_; }
    double reach() const { return reach_; }  // beyond this distance the profile is nothing
    // Length of an offset across a line, with density Σ_k p_k G(v_k, r) in the plane, p_k the probabilities.
    // It grows with u in (0,1), so that stratified numbers give stratified lengths whatever Gaussian they
    // belong to.
    double offsetAt(double u) const;

    // 1 - s·ρ_dt(μ): what passes the surface of light that arrives at cosine μ.
    double transmitted(double mu) const;
    // X(μ): how diffused light leaves by angle.
    double exitScale(double mu) const;
    // A lobe of f_s: its share, and its rms slope where pores show slopes of E|s|² = `removed`.
    struct SpecularLobe {
        double share, roughness;
    };
    // One of them, or two.
    std::vector<SpecularLobe> lobes(double removed) const;
    // That lobe's part of f_s at unit vectors away from the surface, s included, in 1/sr.
    double specular(const SpecularLobe& lobe, const glm::dvec3& n, const glm::dvec3& v,
                    const glm::dvec3& l) const;
    // ρ^mix and ρ^(1-mix).
    glm::dvec3 before(const glm::dvec3& albedo) const;
    glm::dvec3 after(const glm::dvec3& albedo) const;

  private:
    SkinMaterial material_;
    double roughness_, narrower_, meanAlbedo_, reach_ = 0;  // m of both lobes
    std::vector<float> albedo_;  // ρ_dt of both lobes, see skin::directionalAlbedoRow
    std::vector<Term> terms_;
    std::vector<double> offsets_;  // squared, at equal steps of u: brackets for offsetAt
};

}  // namespace cutis::reference
