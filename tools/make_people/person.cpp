#include "person.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numeric>

#include "eye.h"
#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "skin_map.h"

namespace cutis::people {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr double kMetres = 0.1;  // MakeHuman's unit
// Where MakeHuman put the 2048² skin map in morse's human_rig.blend, once decompressed.
constexpr std::size_t kMorseMapOffset = 11420240;

ordered_json vector(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}
ordered_json quaternion(const glm::dquat& q) {
    return {q.x, q.y, q.z, q.w};
}

// How much each vertex follows the head: all of it above the neck, a part of it along the neck.
std::vector<double> headWeights(const BaseMesh& base) {
    const auto follows = [](const std::string& bone) {
        constexpr std::pair<const char*, double> kNeck[] = {
            {"neck01", 0.2}, {"neck02", 0.5}, {"neck03", 0.8}};
        for (const auto& [name, share] : kNeck)
            if (bone.starts_with(name)) return share;
        constexpr const char* kBody[] = {"root",     "spine",    "pelvis",   "clavicle", "shoulder",
                                         "upperarm", "lowerarm", "wrist",    "metac",    "finger",
                                         "breast",   "upperleg", "lowerleg", "foot",     "toe"};
        for (const char* name : kBody)
            if (bone.starts_with(name)) return 0.0;
        return 1.0;
    };
    std::vector<double> weights(base.mesh.positions.size());
    for (std::size_t i = 0; i < weights.size(); ++i)
        for (int k = 0; k < 4; ++k) {
            const double w = base.boneWeights[i][k];
            if (w > 0) weights[i] += w * follows(base.bones.at(base.boneIndices[i][k]));
        }
    return weights;
}

// The body in metres with its origin between the eyes, the head turned on the neck.
struct Pose {
    glm::dvec3 origin, pivot;  // decimetres
    glm::dquat head;

    glm::dvec3 apply(const glm::dvec3& p, double weight) const {
        const glm::dquat turn = glm::slerp(glm::dquat(1, 0, 0, 0), head, weight);
        return kMetres * (turn * (p - pivot) + pivot - origin);
    }
};

// A bust: head, neck and shoulders, without the insides of mouth and eye sockets and without arms.
QuadMesh selectBust(const BaseMesh& base, const std::vector<glm::dvec3>& positions) {
    constexpr double kCut = 4.3,
                     kArms = 2.45;  // decimetres on the base mesh, whose edge loops run along these cuts
    const auto body = std::find(base.groups.begin(), base.groups.end(), "body") - base.groups.begin();
    QuadMesh mesh = base.mesh;
    mesh.positions = positions;
    return selectFaces(mesh, [&](std::size_t f) {
        if (base.faceGroup[f] != body) return false;
        const QuadMesh::Face& face = base.mesh.faces[f];
        for (int k = 0; k < 4; ++k) {
            const glm::dvec3& p = base.mesh.positions[face.vertex[k]];
            const glm::dvec2& uv = base.mesh.uvs[face.uv[k]];
            if (p.y < kCut || std::abs(p.x) > kArms || !(onHead(uv) || onShoulders(uv))) return false;
        }
        return true;
    });
}

TriangleMesh makeSkinMesh(const QuadMesh& bust, int levels) {
    QuadMesh fine = subdivide(bust, levels);
    TriangleMesh mesh = triangulate(fine);
    mesh.sourceUvs = mesh.uvs;
    for (glm::dvec2& uv : mesh.uvs) uv = layoutUv(uv);
    computeTangents(mesh);
    return mesh;
}

int addMeshNode(GltfFile& file, const std::string& name, const TriangleMesh& mesh, int material) {
    return file.addNode({{"name", name}, {"mesh", file.addMesh(name, mesh, material)}});
}

int addSkin(GltfFile& file, const fs::path& folder, const Sources& sources, const PersonRecipe& person,
            const Recipe& recipe, const TriangleMesh& mesh) {
    const Raster source = person.skin.map == "morse"
                              ? readPackedColors(sources.morseSkin, kMorseMapOffset)
                              : readColors(sources.makeHuman / "public/data/skins" / person.skin.map);
    unsigned seed = 0;
    for (const char c : person.name) seed = seed * 31 + unsigned(c);
    const SkinMaps maps = makeSkinMaps(rasterizeSurfels(mesh, recipe.mapSize), source, person.skin, seed);
    const std::string albedo = person.name + "-albedo.png", normal = person.name + "-normal.png";
    writePng8(folder / albedo, maps.albedo, true);
    writePng8(folder / normal, maps.normal, false);
    ordered_json material;
    material["name"] = person.name + " skin";
    material["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", file.addTexture(albedo)}}},
                                        {"metallicFactor", 0},
                                        {"roughnessFactor", 0.5}};
    material["normalTexture"] = {{"index", file.addTexture(normal)}};
    material["extras"]["skin"] = {
        {"profile", "three-layer"},         {"mix", person.skin.mix}, {"roughness", person.skin.roughness},
        {"specular", person.skin.specular}, {"translucency", true},   {"mm_per_unit", 1000}};
    return addMeshNode(file, person.name + " skin", mesh, file.addMaterial(material));
}

int addEyes(GltfFile& file, const fs::path& folder, const Sources& sources, const PersonRecipe& person,
            const std::vector<Eye>& eyes, const TriangleMesh& skin) {
    const std::string colors = person.name + "-eye.png";
    writePng8(folder / colors,
              makeEyeColors(readColors(sources.makeHuman / "public/data/proxies/eyes/HighPolyEyes/textures" /
                                       (person.iris + "_eye.png"))),
              true);
    ordered_json material;
    material["name"] = person.name + " eyes";
    material["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", file.addTexture(colors)}}},
                                        {"metallicFactor", 0},
                                        {"roughnessFactor", 0.12}};
    const int index = file.addMaterial(material);
    std::vector<int> nodes;
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        TriangleMesh ball = makeEyeball(eyes[i], person.irisScale);
        shadeByOpenness(ball, eyes[i], skin);
        nodes.push_back(addMeshNode(file, person.name + (i == 0 ? " left eye" : " right eye"), ball, index));
    }
    return file.addNode({{"name", person.name + " eyes"}, {"children", nodes}});
}

int addHair(GltfFile& file, const fs::path& folder, const Sources& sources, const std::string& person,
            const HairRecipe& hair, const BaseMesh& base, const std::vector<glm::dvec3>& positions,
            const Pose& pose, const std::vector<double>& headWeight) {
    const Proxy proxy = loadProxy(sources.makeHuman, hair.proxy);
    QuadMesh fitted = fitProxy(proxy, base, positions);
    for (std::size_t i = 0; i < fitted.positions.size(); ++i) {
        double weight = 0;
        for (int k = 0; k < 3; ++k) weight += proxy.weights[i][k] * headWeight.at(proxy.references[i][k]);
        fitted.positions[i] = pose.apply(fitted.positions[i], std::clamp(weight, 0.0, 1.0));
    }
    const std::string name = person + " " + fs::path(hair.proxy).filename().string();
    std::string image = name + ".png";
    std::replace(image.begin(), image.end(), ' ', '-');
    Raster colors = readColors(proxy.texture);
    for (std::size_t i = 0; i < colors.values.size(); ++i)
        if (i % colors.channels < 3) colors.values[i] *= float(hair.gain[int(i % colors.channels)]);
    writePng8(folder / image, colors, true);

    ordered_json material;
    material["name"] = name;
    material["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", file.addTexture(image)}}},
                                        {"metallicFactor", 0},
                                        {"roughnessFactor", hair.roughness}};
    material["doubleSided"] = true;
    material["alphaMode"] = hair.cutoff > 0 ? "MASK" : "BLEND";
    if (hair.cutoff > 0) material["alphaCutoff"] = hair.cutoff;
    return addMeshNode(file, name, triangulate(fitted), file.addMaterial(material));
}

}  // namespace

int addPerson(GltfFile& file, const fs::path& folder, const Sources& sources, const BaseMesh& base,
              const PersonRecipe& person, const Recipe& recipe, const glm::dvec3& lookAt) {
    const std::vector<glm::dvec3> positions = applyTargets(sources.makeHuman, base, person.targets);
    const std::vector<double> headWeight = headWeights(base);
    const auto radians = [](double degrees) { return degrees * 3.14159265358979323846 / 180; };
    const auto gather = [&](const char* group, const std::vector<glm::dvec3>& from) {
        std::vector<glm::dvec3> points;
        for (const int v : base.groupVertices(group)) points.push_back(from[v]);
        return points;
    };
    Pose pose{};
    pose.origin = 0.5 * (fitEye(gather("helper-l-eye", positions)).centre +
                         fitEye(gather("helper-r-eye", positions)).centre);
    pose.pivot = glm::mix(base.joint("neck", positions), base.joint("head", positions), 0.6);
    pose.head =
        glm::dquat(glm::dvec3(radians(person.headNod), radians(person.headTurn), radians(person.headTilt)));
    std::vector<glm::dvec3> posed(positions.size());
    for (std::size_t i = 0; i < posed.size(); ++i) posed[i] = pose.apply(positions[i], headWeight[i]);

    const TriangleMesh skin = makeSkinMesh(selectBust(base, posed), recipe.levels);
    const glm::dquat turn(glm::dvec3(0, radians(person.turn), 0));
    std::vector<Eye> eyes;
    for (const char* group : {"helper-l-eye", "helper-r-eye"}) {
        Eye eye = fitEye(gather(group, posed));
        eye.gaze = glm::normalize(glm::inverse(turn) * (lookAt - person.eyes) - eye.centre);
        eyes.push_back(eye);
    }
    std::vector<int> children{addSkin(file, folder, sources, person, recipe, skin),
                              addEyes(file, folder, sources, person, eyes, skin)};
    for (const HairRecipe& hair : person.hair)
        children.push_back(
            addHair(file, folder, sources, person.name, hair, base, positions, pose, headWeight));
    return file.addNode({{"name", person.name},
                         {"translation", vector(person.eyes)},
                         {"rotation", quaternion(turn)},
                         {"children", children}});
}

}  // namespace cutis::people
