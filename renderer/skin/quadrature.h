// Gauss-Legendre quadrature.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace cutis::skin {

// Nodes on (-1, 1) and weights: exact for polynomials of degree 2N - 1.
template <int N>
struct GaussLegendre {
    std::array<double, N> node, weight;

    GaussLegendre() {
        for (int i = 0; i < N; ++i) {
            double x = std::cos(std::numbers::pi * (i + 0.75) / (N + 0.5)), slope = 1;
            for (int step = 0; step < 50; ++step) {  // Newton on P_N
                double p0 = 1, p1 = x;
                for (int k = 2; k <= N; ++k) {
                    const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
                    p0 = p1, p1 = p2;
                }
                slope = N * (x * p1 - p0) / (x * x - 1);
                const double dx = p1 / slope;
                x -= dx;
                if (std::abs(dx) < 1e-15) break;
            }
            node[i] = x;
            weight[i] = 2 / ((1 - x * x) * slope * slope);
        }
    }

    // ∫_a^b f(x) dx
    template <typename F>
    double integrate(double a, double b, F&& f) const {
        const double centre = 0.5 * (a + b), half = 0.5 * (b - a);
        double sum = 0;
        for (int i = 0; i < N; ++i) sum += weight[i] * f(centre + half * node[i]);
        return sum * half;
    }
};

}  // namespace cutis::skin
