#include "tests/support/walking_body.h"

#include <cmath>
#include <numbers>

#include "tests/unit_scene/gltf_file.h"

namespace cutis::test {
namespace {

using nlohmann::json;

constexpr double kPi = std::numbers::pi;
constexpr double kLength = 0.8, kKnee = 0.4, kRadius = 0.06, kApart = 0.13;
constexpr int kSides = 12, kRings = 33;

// A tube from y = 0 to kLength that is open at its ends, round x = z = 0, its upper half bound to joint 0 and
// its lower half to joint 1, blended over 0.2 m. leg: 0 or 1, its half of the texture.
json legPrimitive(GltfFile& file, int leg) {
    std::vector<float> positions, normals, uvs, weights;
    std::vector<std::uint8_t> joints;
    std::vector<std::uint16_t> indices;
    for (int ring = 0; ring < kRings; ++ring) {
        for (int side = 0; side <= kSides; ++side) {
            const double y = kLength * ring / (kRings - 1), angle = 2 * kPi * side / kSides;
            const double x = std::sin(angle), z = -std::cos(angle);
            for (const double v : {kRadius * x, y, kRadius * z}) positions.push_back(float(v));
            for (const double v : {x, 0.0, z}) normals.push_back(float(v));
            for (const double v : {(leg + double(side) / kSides) / 2, 1 - double(ring) / (kRings - 1)})
                uvs.push_back(float(v));
            const auto upper = float(std::clamp((y - kKnee) / 0.2 + 0.5, 0.0, 1.0));
            for (const float w : {upper, 1 - upper, 0.f, 0.f}) weights.push_back(w);
            for (const std::uint8_t j : {0, 1, 0, 0}) joints.push_back(j);
            if (side == kSides || ring + 1 == kRings) continue;
            const auto a = std::uint16_t(ring * (kSides + 1) + side), b = std::uint16_t(a + kSides + 1);
            for (const int i : {a + 0, b + 0, a + 1, a + 1, b + 0, b + 1})
                indices.push_back(std::uint16_t(i));
        }
    }
    const std::size_t count = positions.size() / 3;
    return {{"attributes",
             {{"POSITION", file.addAccessor(positions, "VEC3", kFloat, count)},
              {"NORMAL", file.addAccessor(normals, "VEC3", kFloat, count)},
              {"TEXCOORD_0", file.addAccessor(uvs, "VEC2", kFloat, count)},
              {"JOINTS_0", file.addAccessor(joints, "VEC4", kUnsignedByte, count)},
              {"WEIGHTS_0", file.addAccessor(weights, "VEC4", kFloat, count)}}},
            {"indices", file.addAccessor(indices, "SCALAR", kUnsignedShort, indices.size())},
            {"material", 0}};
}

json floorPrimitive(GltfFile& file) {
    const std::vector<float> positions{-2, 0, 2, 2, 0, 2, 2, 0, -2, -2, 0, -2};
    return {{"attributes", {{"POSITION", file.addAccessor(positions, "VEC3", kFloat, 4)}}},
            {"indices", file.addAccessor<std::uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR", kUnsignedShort, 6)},
            {"material", 1}};
}

class Walk {
  public:
    explicit Walk(GltfFile& file) : file_(file) {
        times_ = file.addAccessor<float>({0, 0.5f, 1, 1.5f, 2}, "SCALAR", kFloat, 5);
    }
    void add(int node, const char* path, int output, const char* interpolation) {
        samplers_.push_back({{"input", times_}, {"output", output}, {"interpolation", interpolation}});
        channels_.push_back(
            {{"sampler", samplers_.size() - 1}, {"target", {{"node", node}, {"path", path}}}});
    }
    // Turns about +X, in degrees; a cubic spline stands still at each key.
    void turn(int node, const std::vector<double>& degrees, bool cubic) {
        std::vector<float> values;
        const auto still = [&] { values.insert(values.end(), 4, 0.f); };
        for (const double angle : degrees) {
            if (cubic) still();
            for (const double v : {std::sin(angle * kPi / 360), 0.0, 0.0, std::cos(angle * kPi / 360)})
                values.push_back(float(v));
            if (cubic) still();
        }
        add(node, "rotation", file_.addAccessor(values, "VEC4", kFloat, values.size() / 4),
            cubic ? "CUBICSPLINE" : "LINEAR");
    }
    json animation() const { return {{"name", "walk"}, {"samplers", samplers_}, {"channels", channels_}}; }

  private:
    GltfFile& file_;
    int times_;
    json samplers_ = json::array(), channels_ = json::array();
};

}  // namespace

std::filesystem::path writeWalkingBody(const std::filesystem::path& folder) {
    GltfFile file;
    file.json["materials"] = {{{"name", "leg"},
                               {"extras", {{"skin", true}}},
                               {"pbrMetallicRoughness", {{"baseColorFactor", {0.8, 0.6, 0.5, 1}}}}},
                              {{"name", "floor"}, {"pbrMetallicRoughness", {{"metallicFactor", 0}}}}};
    file.json["meshes"] = {{{"name", "left leg"}, {"primitives", {legPrimitive(file, 0)}}},
                           {{"name", "floor"}, {"primitives", {floorPrimitive(file)}}},
                           {{"name", "right leg"}, {"primitives", {legPrimitive(file, 1)}}}};
    const std::vector<float> bind{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -float(kLength), 0, 1,
                                  1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -float(kKnee),   0, 1};
    const int matrices = file.addAccessor(bind, "MAT4", kFloat, 2);
    file.json["skins"] = {{{"joints", {2, 3}}, {"inverseBindMatrices", matrices}, {"skeleton", 1}},
                          {{"joints", {4, 5}}, {"inverseBindMatrices", matrices}, {"skeleton", 1}}};
    const auto hip = [&](double x, int knee) {
        return json{{"translation", {x, 0, 0}}, {"children", {knee}}};
    };
    const json knee = {{"translation", {0, kKnee - kLength, 0}}};
    file.json["nodes"] = {{{"name", "walker"}, {"children", {1, 6, 7}}},
                          {{"name", "hips"}, {"translation", {0, kLength, 0}}, {"children", {2, 4}}},
                          hip(kApart / 2, 3),
                          knee,
                          hip(-kApart / 2, 5),
                          knee,
                          {{"name", "left"}, {"mesh", 0}, {"skin", 0}},
                          {{"name", "right"}, {"mesh", 2}, {"skin", 1}},
                          {{"name", "floor"}, {"mesh", 1}}};
    file.json["scenes"] = {{{"nodes", {0, 8}}}};
    Walk walk(file);
    std::vector<float> way;
    for (int key = 0; key < 5; ++key) {
        for (const double v : {0.0, kLength, 0.15 * key}) way.push_back(float(v));
    }
    walk.add(1, "translation", file.addAccessor(way, "VEC3", kFloat, 5), "LINEAR");
    walk.turn(2, {-25, 0, 25, 0, -25}, false);
    walk.turn(4, {25, 0, -25, 0, 25}, false);
    walk.turn(3, {0, 5, 10, 40, 0}, true);
    walk.turn(5, {10, 40, 0, 5, 10}, true);
    file.json["animations"] = {walk.animation()};
    return file.saveGlb(folder, "walker.glb");
}

}  // namespace cutis::test
