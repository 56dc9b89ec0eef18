#include "renderer/reference/diffusion.h"

#include <algorithm>
#include <cmath>

#include "renderer/reference/directions.h"

namespace cutis::reference {
namespace {

enum Purpose : std::uint32_t { kOffset, kFirstHit };

// A point of the surface whose weight in M is w is lit with probability w / kLitWeight where that is below 1.
constexpr double kLitWeight = 0.05;

}  // namespace

// E'(y) = ρ^mix Σ E (1 - s·ρ_dt(N·L)).
glm::dvec3 Diffusion::enteringAt(const SurfacePoint& y, const RandomNumbers& random) const {
    thread_local std::vector<Incident> incident;
    lighting_->gather(y, y.normal, nullptr, random, incident);
    const SkinModel& model = modelOf(y);
    glm::dvec3 sum(0);
    for (const Incident& from : incident)
        sum += from.irradiance * model.transmitted(glm::dot(y.normal, from.direction));
    return sum * model.before(albedoOf(y));
}

// Points y are found by probe lines: an offset is drawn from a mixture of the profile's own Gaussians in the
// plane, and a line through it, along the normal of x, meets the surface. So a Gaussian of 0.08 mm costs what
// one of 3 mm does, and none is held in a grid or a point cloud, whose spacing would be an error of its own.
// (King, Kulla, Conty & Fajardo, "BSSRDF Importance Sampling", SIGGRAPH 2013 talks.) Unlike there, kernels
// are of the straight distance |x-y|, every point on the line counts, and lines along two more axes are cast
// each time, for what stands edge-on to the first.
//
// A line along axis a finds a piece of surface at y with density p_a = |N_y·a| Σ_k p_k G(v_k, r_a), r_a the
// distance from x to y across a. The three share the integral by (N_y·a)², which sums to 1 whatever N_y: what
// axis a finds counts
//   (N_y·a)² kernel(|x-y|) / p_a = |N_y·a| · Σ_k w_k G(v_k, |x-y|) / Σ_k p_k G(v_k, r_a),
// which is bounded, since r_a ≤ |x-y|, and exactly kernel over density on a plane, where the first axis finds
// everything. (The balance heuristic hands far points to lines that pass close to x and nearly along the
// surface, because narrow Gaussians are dense there: that is rarely hit and noisy.)
glm::dvec3 Diffusion::exitance(const SurfacePoint& x, const RandomNumbers& random) const {
    const SkinModel& model = modelOf(x);
    const std::vector<SkinModel::Term>& terms = model.terms();
    const glm::dvec2 u = random.pair(kOffset);
    const double radius = model.offsetAt(u.x), phi = 2 * kPi * u.y;
    const double along = radius * std::cos(phi), across = radius * std::sin(phi), reach = model.reach();

    const Frame frame(x.face);
    const glm::dvec3 axes[3] = {frame.n, frame.t, frame.b};
    thread_local std::vector<Hit> hits;
    glm::dvec3 sum(0);
    std::uint32_t found = kFirstHit;
    for (int a = 0; a < 3; ++a) {
        const glm::dvec3 middle = x.position + axes[(a + 1) % 3] * along + axes[(a + 2) % 3] * across;
        rays_->findSkin(x.mesh->character, middle - axes[a] * reach, axes[a], 2 * reach, hits);
        // Embree reports hits in an order of its own: random numbers go by distance.
        std::sort(hits.begin(), hits.end(), [](const Hit& p, const Hit& q) { return p.t < q.t; });
        for (const Hit& hit : hits) {
            const RandomNumbers own = random.branch(found++);
            SurfacePoint y = surfaceAt(*rays_, hit);
            if (!model.material().translucency && glm::dot(x.smooth, y.smooth) < 0) continue;
            const glm::dvec3 apart = y.position - x.position;
            const double distance2 = glm::dot(apart, apart);
            const double height = glm::dot(apart, axes[a]),
                         offset2 = std::max(distance2 - height * height, 0.0);
            glm::dvec3 kernel(0);
            double density = 0;
            for (const SkinModel::Term& term : terms) {
                const double g = 1 / term.variance;
                kernel += term.weight * (g * std::exp(-0.5 * distance2 * g));
                density += term.probability * g * std::exp(-0.5 * offset2 * g);
            }
            if (!(density > 0)) continue;
            const glm::dvec3 weight = kernel * (std::abs(glm::dot(y.face, axes[a])) / density);
            const double lit = std::min(1.0, std::max({weight.r, weight.g, weight.b}) / kLitWeight);
            if (!(lit > 0) || (lit < 1 && own.pair(kOffset).x >= lit)) continue;
            readTextures(y, hit);
            sum += weight / lit * enteringAt(y, own.branch(0));
        }
    }
    return sum;
}

}  // namespace cutis::reference
