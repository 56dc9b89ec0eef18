// Energy balance between the specular layer and the diffusion below it: the coupled matte of Kelemen &
// Szirmay-Kalos 2001 (DESIGN §1.1). And of diffusion at the ends of a body.
#pragma once

namespace cutis::skin {

// 1 - s·ρ_dt clamped to [0,1]: what passes the surface of the light that arrives at cosine μ. `albedo` is
// ρ_dt(μ, m).
double transmittedFraction(double s, double albedo);

// X(μ) = (1 - s·ρ_dt(μ, m)) / (1 - s·ρ̄_dt(m)): how the diffused light leaves by angle; its cosine-weighted
// mean is 1. `meanAlbedo` is that of specular.h for this s. 0 where nothing passes the surface at all.
double exitScale(double s, double albedo, double meanAlbedo);

// What a Gaussian (variance in mm²) gathers from all of a body whose surface has this area in mm²: ∫ G dA = 1 - exp(-A / 2πv).
// That is exact on a sphere, at any of its points, and at the centre of a disc; and on any body whose size is far below
// the Gaussian's, where G = 1/2πv wherever light falls.
double gatheredShare(double variance, double area);

}  // namespace cutis::skin
