// Which cells of a grid a triangle covers.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace cutis {

inline double cross2(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

// Calls body(x, y) for the cells of a grid of size.x × size.y, one unit wide, whose centres lie within the
// triangle and not on its edges. Takes as long as there are rows and cells to visit, however long and thin
// the triangle is.
template <class Body>
void forEachCellWithin(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::ivec2& size,
                       Body body) {
    constexpr double kMargin = 1e-6;  // of a cell, from the edges
    const glm::dvec2 corners[3] = {a, b, c};
    if (!(cross2(b - a, c - a) != 0)) return;
    const double low = std::min({a.y, b.y, c.y}), high = std::max({a.y, b.y, c.y});
    const int first = static_cast<int>(std::clamp(std::ceil(low - 0.5), 0.0, double(size.y)));
    const int last = static_cast<int>(std::clamp(std::floor(high - 0.5), -1.0, double(size.y - 1)));
    for (int y = first; y <= last; ++y) {
        const double line = y + 0.5;
        double from = 1e300, to = -1e300;
        for (int i = 0; i < 3; ++i) {
            const glm::dvec2 &p = corners[i], &q = corners[(i + 1) % 3];
            if ((p.y < line) == (q.y < line)) continue;
            const double x = p.x + (q.x - p.x) * ((line - p.y) / (q.y - p.y));
            from = std::min(from, x), to = std::max(to, x);
        }
        const int begin = static_cast<int>(std::clamp(std::ceil(from + kMargin - 0.5), 0.0, double(size.x)));
        const int end =
            static_cast<int>(std::clamp(std::floor(to - kMargin - 0.5), -1.0, double(size.x - 1)));
        for (int x = begin; x <= end; ++x) body(x, y);
    }
}

}  // namespace cutis
