#include "renderer/frame/skin_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "renderer/frame/spans.h"

namespace cutis {
namespace {

// Edges at which more triangles meet belong to no surface that light could follow.
constexpr std::size_t kMostAtOneEdge = 16;
constexpr int kOverlapCells = 1024;

struct Key {
    glm::vec3 p;
    glm::vec2 uv;
    std::uint64_t owner;
    std::uint32_t part;
    bool operator==(const Key&) const = default;
};

struct KeyHash {
    std::size_t operator()(const Key& k) const {
        std::size_t h = k.owner * 0x9e3779b97f4a7c15u + k.part;
        for (float f : {k.p.x, k.p.y, k.p.z, k.uv.x, k.uv.y}) {
            h = h * 0x9e3779b97f4a7c15u + std::hash<float>{}(f);
        }
        return h ^ (h >> 29);
    }
};

// Vertices that stand at one place are one vertex of the surface, those with one uv as well one of the layout, however
// the file split them.
std::vector<std::uint32_t> weldVertices(const Geometry& geometry, bool layout) {
    std::unordered_map<Key, std::uint32_t, KeyHash> first;
    first.reserve(geometry.skinVertexCount);
    std::vector<std::uint32_t> weld(geometry.skinVertexCount);
    for (const GeometryDraw& draw : geometry.draws) {
        if (!draw.skin) break;
        const auto character = static_cast<std::uint64_t>(draw.character);
        const std::uint64_t owner = layout ? character << 32 | static_cast<std::uint32_t>(draw.material) : character;
        for (std::uint32_t v = draw.firstVertex; v < draw.firstVertex + draw.vertexCount; ++v) {
            const glm::vec2 uv = layout ? geometry.layoutUv[v] : glm::vec2(0);
            const std::uint32_t part = layout ? geometry.layoutParts[v] : 0;
            weld[v] = first.try_emplace(Key{geometry.positions[v], uv, owner, part}, v).first->second;
        }
    }
    return weld;
}

std::uint32_t startOf(const Geometry& geometry, HalfEdge h) { return geometry.indices[h]; }
std::uint32_t endOf(const Geometry& geometry, HalfEdge h) { return geometry.indices[h % 3 == 2 ? h - 2 : h + 1]; }

// Calls body(halfEdges) for the half-edges between each pair of welded vertices.
template <class Body>
void forEachEdge(const Geometry& geometry, const std::vector<std::uint32_t>& weld, Body body) {
    struct Entry {
        std::uint64_t ends;
        HalfEdge h;
        bool operator<(const Entry& other) const { return ends != other.ends ? ends < other.ends : h < other.h; }
    };
    std::vector<Entry> entries;
    entries.reserve(std::size_t(geometry.skinTriangleCount) * 3);
    for (HalfEdge h = 0; h < geometry.skinTriangleCount * 3; ++h) {
        const std::uint32_t a = weld[startOf(geometry, h)], b = weld[endOf(geometry, h)];
        if (a != b) entries.push_back({std::uint64_t(std::min(a, b)) << 32 | std::max(a, b), h});
    }
    std::sort(entries.begin(), entries.end());
    std::vector<HalfEdge> group;
    for (std::size_t i = 0; i < entries.size();) {
        group.clear();
        const std::uint64_t ends = entries[i].ends;
        for (; i < entries.size() && entries[i].ends == ends; ++i) group.push_back(entries[i].h);
        body(group);
    }
}

glm::dvec3 normalOf(const Geometry& geometry, std::uint32_t triangle) {
    const std::uint32_t* v = &geometry.indices[std::size_t(triangle) * 3];
    const glm::dvec3 a = geometry.positions[v[0]], b = geometry.positions[v[1]], c = geometry.positions[v[2]];
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double length = glm::length(n);
    return length > 0 ? n / length : glm::dvec3(0);
}

// Of several triangles at one edge each goes on into the one that bends least away from it; of those that bend alike, as where
// a body has no thickness, into the one that turns the same side outwards.
void joinEdges(const Geometry& geometry, const std::vector<std::uint32_t>& places, SkinMesh& mesh) {
    mesh.across.assign(std::size_t(geometry.skinTriangleCount) * 3, kNoHalfEdge);
    forEachEdge(geometry, places, [&](const std::vector<HalfEdge>& edges) {
        if (edges.size() < 2 || edges.size() > kMostAtOneEdge) return;
        for (const HalfEdge h : edges) {
            double best = -3;
            const glm::dvec3 n = normalOf(geometry, h / 3);
            for (const HalfEdge other : edges) {
                if (other / 3 == h / 3) continue;
                const bool opposed = places[startOf(geometry, other)] != places[startOf(geometry, h)];
                const double sameSide = opposed ? 1e-9 : 0;
                const double flat = glm::dot(n, normalOf(geometry, other / 3)) * (opposed ? 1 : -1) + sameSide;
                if (flat > best) best = flat, mesh.across[h] = other;
            }
        }
    });
}

// Needs `across`.
void findSealed(const Geometry& geometry, const std::vector<std::uint32_t>& places, SkinMesh& mesh) {
    mesh.sealed.assign(geometry.receiverGroups.size(), true);
    for (HalfEdge h = 0; h < geometry.skinTriangleCount * 3; ++h) {
        const std::uint32_t a = places[startOf(geometry, h)], b = places[endOf(geometry, h)];
        if (a == b) continue;
        const HalfEdge other = mesh.across[h];
        if (other == kNoHalfEdge || places[startOf(geometry, other)] != b)
            mesh.sealed[geometry.draws[geometry.triangleDraws[h / 3]].character] = false;
    }
}

std::uint32_t findRoot(std::vector<std::uint32_t>& parent, std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
}

void findIslands(const Geometry& geometry, SkinMesh& mesh) {
    std::vector<std::uint32_t> parent(mesh.weld.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto join = [&](std::uint32_t a, std::uint32_t b) {
        a = findRoot(parent, a), b = findRoot(parent, b);
        parent[std::max(a, b)] = std::min(a, b);
    };
    for (HalfEdge h = 0; h < geometry.skinTriangleCount * 3; ++h) {
        join(mesh.weld[startOf(geometry, h)], mesh.weld[endOf(geometry, h)]);
    }
    std::unordered_map<std::uint32_t, std::uint32_t> number;
    mesh.islandOf.resize(geometry.skinTriangleCount);
    for (std::uint32_t t = 0; t < geometry.skinTriangleCount; ++t) {
        const std::uint32_t root = findRoot(parent, mesh.weld[geometry.indices[std::size_t(t) * 3]]);
        const auto found = number.try_emplace(root, static_cast<std::uint32_t>(mesh.islands.size()));
        if (found.second) mesh.islands.emplace_back();
        mesh.islandOf[t] = found.first->second;
        mesh.islands[mesh.islandOf[t]].triangles.push_back(t);
    }
}

// Islands that lie upon others, as far as a grid of kOverlapCells² places over the layout of their material shows.
void findOverlaps(const Geometry& geometry, SkinMesh& mesh) {
    struct Layout {
        glm::dvec2 low{1e300}, high{-1e300};
        std::vector<std::uint32_t> islands;
    };
    std::map<std::pair<int, int>, Layout> layouts;
    const auto uvOf = [&](HalfEdge corner) { return glm::dvec2(geometry.layoutUv[geometry.indices[corner]]); };
    for (std::uint32_t i = 0; i < mesh.islands.size(); ++i) {
        const GeometryDraw& draw = geometry.draws[geometry.triangleDraws[mesh.islands[i].triangles.front()]];
        Layout& layout = layouts[{draw.character, draw.material}];
        layout.islands.push_back(i);
        for (const std::uint32_t t : mesh.islands[i].triangles) {
            for (HalfEdge h = t * 3; h < t * 3 + 3; ++h) {
                layout.low = glm::min(layout.low, uvOf(h)), layout.high = glm::max(layout.high, uvOf(h));
            }
        }
    }
    for (const auto& [key, layout] : layouts) {
        if (layout.islands.size() < 2) continue;
        std::vector<std::uint32_t> owner(std::size_t(kOverlapCells) * kOverlapCells, kNoHalfEdge);
        const glm::dvec2 scale = double(kOverlapCells) / glm::max(layout.high - layout.low, 1e-30);
        for (const std::uint32_t island : layout.islands) {
            for (const std::uint32_t t : mesh.islands[island].triangles) {
                const glm::dvec2 a = (uvOf(t * 3) - layout.low) * scale, b = (uvOf(t * 3 + 1) - layout.low) * scale,
                                 c = (uvOf(t * 3 + 2) - layout.low) * scale;
                forEachCellWithin(a, b, c, glm::ivec2(kOverlapCells), [&](int x, int y) {
                    std::uint32_t& first = owner[std::size_t(y) * kOverlapCells + x];
                    if (first == kNoHalfEdge) first = island;
                    if (first != island) mesh.islands[first].overlaps = mesh.islands[island].overlaps = true;
                });
            }
        }
    }
}

// Edges that meet no other as a whole may lie along a longer one, or along several: a grid finds those near each.
class OpenEdges {
  public:
    OpenEdges(const Geometry& geometry, const SkinMesh& mesh) : geometry_(geometry) {
        double total = 0;
        for (const HalfEdge h : mesh.borders) {
            if (mesh.across[h] != kNoHalfEdge) continue;
            const double length = glm::length(b(h) - a(h));
            if (!(length > 0)) continue;
            edges_.push_back(h);
            total += length;
        }
        cell_ = edges_.empty() ? 1 : std::max(total / static_cast<double>(edges_.size()), 1e-9);
        for (const HalfEdge h : edges_) forEachCell(h, [&](std::uint64_t cell) { cells_[cell].push_back(h); });
    }

    std::vector<PartialEdge> match() {
        std::vector<PartialEdge> found;
        std::vector<HalfEdge> near;
        for (const HalfEdge h : edges_) {
            near.clear();
            forEachCell(h, [&](std::uint64_t cell) {
                const std::vector<HalfEdge>& there = cells_[cell];
                if (there.size() <= kMostNear) near.insert(near.end(), there.begin(), there.end());
            });
            std::sort(near.begin(), near.end());
            near.erase(std::unique(near.begin(), near.end()), near.end());
            for (const HalfEdge other : near) tryPair(h, other, found);
        }
        return found;
    }

  private:
    static constexpr std::size_t kMostNear = 256, kMostCells = 512;

    glm::dvec3 a(HalfEdge h) const { return geometry_.positions[startOf(geometry_, h)]; }
    glm::dvec3 b(HalfEdge h) const { return geometry_.positions[endOf(geometry_, h)]; }

    template <class Body>
    void forEachCell(HalfEdge h, Body body) const {
        const double margin = kTolerance * glm::length(b(h) - a(h));
        const glm::dvec3 low = glm::floor((glm::min(a(h), b(h)) - margin) / cell_);
        const glm::dvec3 high = glm::floor((glm::max(a(h), b(h)) + margin) / cell_);
        const glm::dvec3 extent = high - low + 1.0;
        if (extent.x * extent.y * extent.z > kMostCells) return;
        const glm::i64vec3 first(low), last(high);
        for (std::int64_t z = first.z; z <= last.z; ++z) {
            for (std::int64_t y = first.y; y <= last.y; ++y) {
                for (std::int64_t x = first.x; x <= last.x; ++x) {
                    body(static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u ^
                         static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fu ^
                         static_cast<std::uint64_t>(z) * 0x165667b19e3779f9u);
                }
            }
        }
    }

    void tryPair(HalfEdge h, HalfEdge other, std::vector<PartialEdge>& found) const {
        if (other / 3 == h / 3) return;
        const GeometryDraw &mine = geometry_.draws[geometry_.triangleDraws[h / 3]],
                           &its = geometry_.draws[geometry_.triangleDraws[other / 3]];
        if (mine.character != its.character) return;
        const glm::dvec3 along = b(h) - a(h), otherAlong = b(other) - a(other);
        const double length = glm::length(along), otherLength = glm::length(otherAlong);
        const glm::dvec3 unit = along / length;
        const double tolerance = kTolerance * std::max(length, otherLength);
        // Both ends of the shorter one lie on the line of the longer one.
        const bool shorter = otherLength < length;
        const glm::dvec3 origin = shorter ? a(h) : a(other), axis = shorter ? unit : otherAlong / otherLength;
        for (const glm::dvec3& p : {shorter ? a(other) : a(h), shorter ? b(other) : b(h)}) {
            const glm::dvec3 off = p - origin;
            if (glm::length(off - axis * glm::dot(off, axis)) > tolerance) return;
        }
        double from = glm::dot(a(other) - a(h), unit) / length, to = glm::dot(b(other) - a(h), unit) / length;
        if (from > to) std::swap(from, to);
        from = std::max(from, 0.0), to = std::min(to, 1.0);
        if ((to - from) * length > 2 * tolerance) found.push_back({h, other, from, to});
    }

    static constexpr double kTolerance = 1e-3;  // of the longer edge
    const Geometry& geometry_;
    std::vector<HalfEdge> edges_;
    double cell_ = 1;
    std::unordered_map<std::uint64_t, std::vector<HalfEdge>> cells_;
};

}  // namespace

HalfEdge SkinMesh::beyond(HalfEdge edge, double share) const {
    if (across[edge] != kNoHalfEdge) return across[edge];
    const auto byEdge = [](const PartialEdge& part, HalfEdge e) { return part.edge < e; };
    for (auto part = std::lower_bound(partial.begin(), partial.end(), edge, byEdge);
         part != partial.end() && part->edge == edge; ++part) {
        if (share >= part->from && share <= part->to) return part->other;
    }
    return kNoHalfEdge;
}

bool SkinMesh::continues(HalfEdge edge) const {
    if (across[edge] != kNoHalfEdge) return true;
    return std::binary_search(partial.begin(), partial.end(), PartialEdge{edge, 0, 0, 0},
                              [](const PartialEdge& a, const PartialEdge& b) { return a.edge < b.edge; });
}

SkinMesh makeSkinMesh(const Geometry& geometry) {
    SkinMesh mesh;
    if (geometry.skinTriangleCount == 0) return mesh;
    mesh.weld = weldVertices(geometry, true);
    const std::vector<std::uint32_t> places = weldVertices(geometry, false);
    joinEdges(geometry, places, mesh);
    findSealed(geometry, places, mesh);
    findIslands(geometry, mesh);
    findOverlaps(geometry, mesh);
    forEachEdge(geometry, mesh.weld, [&](const std::vector<HalfEdge>& edges) {
        if (edges.size() == 1) mesh.borders.push_back(edges[0]);
    });
    std::sort(mesh.borders.begin(), mesh.borders.end());
    mesh.partial = OpenEdges(geometry, mesh).match();  // by edge, as the borders are
    for (const HalfEdge h : mesh.borders) {
        if (!mesh.continues(h)) continue;
        ++mesh.seams;
        mesh.islands[mesh.islandOf[h / 3]].continued = true;
    }
    return mesh;
}

}  // namespace cutis
