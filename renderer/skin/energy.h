// Energy balance between the specular layer and the diffusion below it: the coupled matte of Kelemen &
// Szirmay-Kalos 2001 (DESIGN §1.1).
#pragma once

namespace cutis::skin {

// 1 - s·ρ_dt clamped to [0,1]: what passes the surface of the light that arrives at cosine μ. `albedo` is
// ρ_dt(μ, m).
double transmittedFraction(double s, double albedo);

// X(μ) = (1 - s·ρ_dt(μ, m)) / (1 - s·ρ̄_dt(m)): how the diffused light leaves by angle; its cosine-weighted
// mean is 1. `meanAlbedo` is that of specular.h for this s. 0 where nothing passes the surface at all.
double exitScale(double s, double albedo, double meanAlbedo);

}  // namespace cutis::skin
