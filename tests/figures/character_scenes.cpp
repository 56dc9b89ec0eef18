// Writes the scenes of docs/characters.md: character_scenes FOLDER. layouts.glb: one head with eight layouts;
// moving.glb: a tube that bends and a ball that morphs; hints.glb: balls that other extensions hint at being
// skin; crowd.glb and crowd.rig.json: 16 heads and 64 lights.
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "renderer/scene/gltf_writer.h"
#include "renderer/scene/rig.h"
#include "tests/support/awkward_layouts.h"
#include "tests/support/render.h"
#include "tests/support/surfaces.h"
#include "tests/unit_scene/gltf_file.h"

namespace cutis::test {
namespace {

using nlohmann::json;

constexpr double kPi = std::numbers::pi;
const glm::vec4 kSkinColor(0.75f, 0.5f, 0.42f, 1);

glm::dmat4 at(double x, double y, double z) {
    return glm::translate(glm::dmat4(1), glm::dvec3(x, y, z) * kMm);
}

// A head with six charts, once as it is and then with layouts that do not serve.
Scene layouts() {
    constexpr double kApart = 74;  // mm
    const Primitive head = makeNosedSphere(30 * kMm);
    const std::pair<const char*, Primitive> heads[] = {
        {"plain", head},          {"mirrored", mirrored(head)},  {"stacked", stacked(head)},
        {"tiled", tiled(head)},   {"bare", bare(head)},          {"squeezed", squeezed(head)},
        {"uneven", uneven(head)}, {"shattered", shattered(head)}};
    SceneBuilder builder;
    const int skin = builder.addSkin(SkinMaterial(), glm::dvec3(kSkinColor));
    for (int i = 0; i < 8; ++i)
        builder.addObject(heads[i].first, heads[i].second, skin,
                          at(kApart * (i % 4 - 1.5), kApart * (0.5 - i / 4), 0) *
                              glm::rotate(glm::dmat4(1), 0.5, glm::dvec3(0, 1, 0)));
    builder.setOrthographicCamera(glm::dvec3(0, 0, 600) * kMm, {0, 0, 0}, 2 * kApart * kMm);
    return builder.scene();
}

// Vertices of a mesh that moves, as a glTF primitive with the given further attributes.
json addMoving(GltfFile& file, const Primitive& body, json attributes) {
    const auto flat = [](const auto& vectors) {
        std::vector<float> values;
        for (const auto& v : vectors)
            for (int c = 0; c < v.length(); ++c) values.push_back(v[c]);
        return values;
    };
    const std::size_t count = body.positions.size();
    attributes["POSITION"] = file.addAccessor(flat(body.positions), "VEC3", kFloat, count);
    attributes["NORMAL"] = file.addAccessor(flat(body.normals), "VEC3", kFloat, count);
    attributes["TEXCOORD_0"] = file.addAccessor(flat(body.uv0), "VEC2", kFloat, count);
    return {{"attributes", attributes},
            {"indices", file.addAccessor(body.indices, "SCALAR", kUnsignedInt, body.indices.size())},
            {"material", 0}};
}

// A tube with round ends from y = -1 to 1, of radius 0.3, in units of 60 mm.
SurfacePoint tubePoint(double s, double t) {
    constexpr double kRadius = 0.3, kSide = 2 - 2 * kRadius, kEnd = kRadius * kPi / 2;
    const double along = t * (kSide + 2 * kEnd), angle = 2 * kPi * s;
    const double polar = along < kEnd           ? along / kRadius - kPi / 2
                         : along < kEnd + kSide ? 0
                                                : (along - kEnd - kSide) / kRadius;
    const double y = std::clamp(along - kEnd, 0.0, kSide) - kSide / 2;
    const glm::dvec3 n(std::cos(polar) * std::sin(angle), std::sin(polar),
                       -std::cos(polar) * std::cos(angle));
    return {60 * kMm * (glm::dvec3(0, y, 0) + kRadius * n), n, 60 * kMm * glm::dvec2(2 * s, -along)};
}

json tubePrimitive(GltfFile& file) {
    ChartedMesh mesh(3 * kMm);
    mesh.addPatch(48, 72, tubePoint);
    const Primitive tube = mesh.finish();
    std::vector<std::uint8_t> joints;
    std::vector<float> weights;
    for (const glm::vec3& p : tube.positions) {
        const auto upper = float(std::clamp(p.y / (30 * kMm) + 0.5, 0.0, 1.0));
        for (const std::uint8_t j : {0, 1, 0, 0}) joints.push_back(j);
        for (const float w : {1 - upper, upper, 0.f, 0.f}) weights.push_back(w);
    }
    const std::size_t count = tube.positions.size();
    return addMoving(file, tube,
                     {{"JOINTS_0", file.addAccessor(joints, "VEC4", kUnsignedByte, count)},
                      {"WEIGHTS_0", file.addAccessor(weights, "VEC4", kFloat, count)}});
}

// A ball whose one target, a sparse accessor, draws a nose out of it.
json ballPrimitive(GltfFile& file) {
    const Primitive ball = makeSphere(30 * kMm, SphereMapping::latLong, glm::dmat3(1), 0.5);
    std::vector<std::uint16_t> places;
    std::vector<float> moves;
    for (std::size_t v = 0; v < ball.positions.size(); ++v) {
        const glm::vec3 n = ball.normals[v];
        const double share =
            std::clamp((glm::dot(n, glm::normalize(glm::vec3(1, 0, 2))) - 0.8) / 0.2, 0.0, 1.0);
        if (share <= 0) continue;
        places.push_back(std::uint16_t(v));
        for (int c = 0; c < 3; ++c) moves.push_back(float(22 * kMm * share * share * (3 - 2 * share) * n[c]));
    }
    json primitive = addMoving(file, ball, json::object());
    primitive["attributes"].erase("NORMAL");  // they follow the shape
    const int where = file.addView(places), what = file.addView(moves);
    const json sparse = {{"count", places.size()},
                         {"indices", {{"bufferView", where}, {"componentType", kUnsignedShort}}},
                         {"values", {{"bufferView", what}}}};
    primitive["targets"] = {{{"POSITION", file.addAccessorJson(-1, "VEC3", kFloat, ball.positions.size(),
                                                               {{"sparse", sparse}})}}};
    return primitive;
}

GltfFile moving() {
    GltfFile file;
    file.json["materials"] = {
        {{"name", "body"},
         {"extras", {{"skin", true}}},
         {"pbrMetallicRoughness", {{"baseColorFactor", {kSkinColor.r, kSkinColor.g, kSkinColor.b, 1}}}}}};
    file.json["meshes"] = {{{"name", "tube"}, {"primitives", {tubePrimitive(file)}}},
                           {{"name", "ball"}, {"primitives", {ballPrimitive(file)}}}};
    file.json["skins"] = {{{"joints", {1, 2}}}};
    file.json["nodes"] = {{{"name", "tube"}, {"mesh", 0}, {"skin", 0}},
                          {{"name", "lower"}, {"translation", {-0.06, 0, 0}}, {"children", {2}}},
                          {{"name", "upper"}},
                          {{"name", "ball"}, {"mesh", 1}, {"translation", {0.06, 0, 0}}}};
    file.json["scenes"] = {{{"nodes", {0, 1, 3}}}};
    constexpr double kBend = 100 * kPi / 180;
    const int times = file.addAccessor<float>({0, 1}, "SCALAR", kFloat, 2);
    const int turns = file.addAccessor<float>(
        {0, 0, 0, 1, 0, 0, float(std::sin(kBend / 2)), float(std::cos(kBend / 2))}, "VEC4", kFloat, 2);
    const int weights = file.addAccessor<float>({0, 1}, "SCALAR", kFloat, 2);
    file.json["animations"] = {
        {{"name", "move"},
         {"samplers", {{{"input", times}, {"output", turns}}, {{"input", times}, {"output", weights}}}},
         {"channels",
          {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "rotation"}}}},
           {{"sampler", 1}, {"target", {{"node", 3}, {"path", "weights"}}}}}}}};
    return file;
}

// Balls of 10 mm: grey matter, then ever more of what other programs say of things that light enters.
GltfFile hints() {
    const json thick = {{"thicknessFactor", 0.02}};
    const auto volume = [](double metres, std::vector<double> color) {
        return json{{"thicknessFactor", 0.02}, {"attenuationDistance", metres}, {"attenuationColor", color}};
    };
    const json transmits = {{"diffuseTransmissionFactor", 0.5}};
    const json extensions[] = {
        json::object(),
        {{"KHR_materials_diffuse_transmission", transmits}, {"KHR_materials_volume", thick}},
        {{"KHR_materials_diffuse_transmission", transmits},
         {"KHR_materials_volume", volume(0.002, {0.6, 0.1, 0.05})}},
        {{"KHR_materials_volume_scatter",
          {{"multiscatterColor", {0.85, 0.6, 0.45}}, {"scatterAnisotropy", 0.2}}},
         {"KHR_materials_volume", volume(0.0005, {0.4, 0.4, 0.4})}}};
    GltfFile file;
    file.json["extensionsUsed"] = {"KHR_materials_diffuse_transmission", "KHR_materials_volume",
                                   "KHR_materials_volume_scatter"};
    const json ball = addMoving(file, makeSphere(10 * kMm, SphereMapping::latLong), json::object());
    for (int i = 0; i < 4; ++i) {
        json material = {
            {"name", "ball " + std::to_string(i)},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", {0.8, 0.8, 0.8, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0.5}}}};
        if (!extensions[i].empty()) material["extensions"] = extensions[i];
        json primitive = ball;
        primitive["material"] = i;
        file.json["materials"].push_back(material);
        file.json["meshes"].push_back({{"primitives", {primitive}}});
        file.json["nodes"].push_back(
            {{"name", "ball " + std::to_string(i)}, {"mesh", i}, {"translation", {0.025 * (i - 1.5), 0, 0}}});
    }
    file.json["scenes"] = {{{"nodes", {0, 1, 2, 3}}}};
    return file;
}

// A colour of the rainbow, `hue` in [0, 1).
glm::dvec3 rainbow(double hue) {
    const glm::dvec3 phase(hue, hue - 1.0 / 3, hue - 2.0 / 3);
    return 0.6 + 0.4 * glm::pow(0.5 + 0.5 * glm::cos(2 * kPi * phase), glm::dvec3(1.5));
}

void writeCrowd(const std::filesystem::path& folder) {
    constexpr int kLights = 64;
    SceneBuilder builder;
    const Primitive head = makeNosedSphere(100 * kMm);
    for (int i = 0; i < 16; ++i) {
        SkinMaterial look;
        look.roughness = 0.25 + 0.02 * i;
        const double tone = 0.3 + 0.7 * ((i * 7) % 16) / 15;
        const int skin = builder.addSkin(look, glm::dvec3(0.75, 0.52, 0.42) * tone);
        builder.addObject("head " + std::to_string(i), head, skin,
                          at(270 * (i % 4 - 1.5), 270 * (1.5 - i / 4), 0) *
                              glm::rotate(glm::dmat4(1), 0.25 * (i % 4 - 1.5) + 0.3, glm::dvec3(0, 1, 0)));
    }
    builder.setOrthographicCamera(glm::dvec3(0, 0, 3), {0, 0, 0}, 1.1);
    writeGlb(builder.scene(), folder / "crowd.glb");
    Rig rig;
    rig.name = "64 lights round 16 heads";
    for (int i = 0; i < kLights; ++i) {
        const double angle = 2 * kPi * i / kLights;
        Light light = pointLight("light " + std::to_string(i),
                                 {1.6 * std::sin(angle), 1.6 * std::cos(angle), i % 2 ? 1.1 : 0.3}, 0.35);
        light.color = rainbow(double(i) / kLights);
        rig.lights.push_back(light);
    }
    saveRig(rig, folder / "crowd.rig.json");
}

}  // namespace
}  // namespace cutis::test

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: character_scenes FOLDER\n");
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    cutis::writeGlb(cutis::test::layouts(), folder / "layouts.glb");
    cutis::test::moving().saveGlb(folder, "moving.glb");
    cutis::test::hints().saveGlb(folder, "hints.glb");
    cutis::test::writeCrowd(folder);
}
