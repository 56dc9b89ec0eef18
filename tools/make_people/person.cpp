#include "person.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numeric>

#include "eye.h"
#include "garment.h"
#include "hair.h"
#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "skin_map.h"

namespace cutis::people {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr double kMetres = 0.1;            // MakeHuman's unit
constexpr const char* kFineMap = "morse";  // how a recipe names the 2048² map

// Each person's own noise.
unsigned seedOf(const PersonRecipe& person) {
    unsigned seed = 0;
    for (const char c : person.name) seed = seed * 31 + static_cast<unsigned char>(c);
    return seed;
}

ordered_json vector(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}
ordered_json quaternion(const glm::dquat& q) {
    return {q.x, q.y, q.z, q.w};
}

// How much each vertex follows the head and the arms: all of it beyond the joint, a part of it around the
// joint.
struct Following {
    std::vector<double> head, leftArm, rightArm;
};

Following computeFollowing(const BaseMesh& base) {
    const auto begins = [](const std::string& bone, auto... names) {
        return (bone.starts_with(names) || ...);
    };
    const auto neck = [](const std::string& bone) {
        constexpr std::pair<const char*, double> kNeck[] = {
            {"neck01", 0.2}, {"neck02", 0.5}, {"neck03", 0.8}};
        for (const auto& [name, share] : kNeck)
            if (bone.starts_with(name)) return share;
        return 1.0;
    };
    Following out;
    const std::size_t count = base.mesh.positions.size();
    out.head.resize(count);
    out.leftArm.resize(count);
    out.rightArm.resize(count);
    for (std::size_t i = 0; i < count; ++i)
        for (int k = 0; k < 4; ++k) {
            const double w = base.boneWeights[i][k];
            const std::string& bone = base.bones.at(base.boneIndices[i][k]);
            if (w <= 0) continue;
            if (begins(bone, "upperarm", "lowerarm", "wrist", "metac", "finger"))
                (bone.find(".L") != std::string::npos ? out.leftArm : out.rightArm)[i] += w;
            else if (!begins(bone, "root", "spine", "pelvis", "clavicle", "shoulder", "breast", "upperleg",
                             "lowerleg", "foot", "toe"))
                out.head[i] += w * neck(bone);
        }
    return out;
}

// The body in metres with its origin between the eyes, the head turned on the neck and the arms hanging.
struct Pose {
    glm::dvec3 origin, neck, leftShoulder, rightShoulder;  // decimetres
    glm::dquat head, leftArm, rightArm;

    glm::dvec3 applyHead(const glm::dvec3& p, double weight) const {
        return kMetres * (rotate(p, neck, head, weight) - origin);
    }
    glm::dvec3 apply(glm::dvec3 p, const Following& following, std::size_t i) const {
        p = rotate(p, leftShoulder, leftArm, following.leftArm[i]);
        p = rotate(p, rightShoulder, rightArm, following.rightArm[i]);
        return applyHead(p, following.head[i]);
    }

  private:
    static glm::dvec3 rotate(const glm::dvec3& p, const glm::dvec3& pivot, const glm::dquat& q,
                             double weight) {
        return glm::slerp(glm::dquat(1, 0, 0, 0), q, weight) * (p - pivot) + pivot;
    }
};

// Faces of the body that keep(base position, texture coordinate) wants at all four corners, on `positions`.
template <class Keep>
QuadMesh selectBody(const BaseMesh& base, const std::vector<glm::dvec3>& positions, const Keep& keep) {
    const auto body = std::find(base.groups.begin(), base.groups.end(), "body") - base.groups.begin();
    QuadMesh mesh = base.mesh;
    mesh.positions = positions;
    return selectFaces(mesh, [&](std::size_t f) {
        if (base.faceGroup[f] != body) return false;
        const QuadMesh::Face& face = base.mesh.faces[f];
        for (int k = 0; k < 4; ++k)
            if (!keep(base.mesh.positions[face.vertex[k]], base.mesh.uvs[face.uv[k]])) return false;
        return true;
    });
}

// Head, neck and what a shirt leaves bare, with a margin under the cloth; without the insides of mouth and
// eye sockets.
QuadMesh selectSkin(const BaseMesh& base, const std::vector<glm::dvec3>& positions,
                    const ShirtRecipe& shirt) {
    constexpr double kMargin = 0.035;  // metres
    return selectBody(base, positions, [&](const glm::dvec3& p, const glm::dvec2& uv) {
        return onHead(uv) || (onShoulders(uv) && belowNeckline(p, shirt.drop) < kMargin);
    });
}

// The upper torso and the arms to above the elbow: what a shirt of a bust covers.
QuadMesh selectTorso(const BaseMesh& base, const std::vector<glm::dvec3>& positions,
                     const ShirtRecipe& shirt) {
    constexpr double kWaist = 2.4, kElbow = 2.75, kMargin = 0.03;  // decimetres on the base mesh; metres
    return selectBody(base, positions, [&](const glm::dvec3& p, const glm::dvec2& uv) {
        return !onHead(uv) && p.y > kWaist && std::abs(p.x) < kElbow &&
               belowNeckline(p, shirt.drop) > -kMargin;
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
            const Recipe& recipe, const TriangleMesh& mesh, const glm::dvec3& scalp) {
    const bool fine = person.skin.map == kFineMap;
    const Raster coarse =
        fine ? Raster() : readColors(sources.makeHuman / "public/data/skins" / person.skin.map);
    const SkinMaps maps =
        makeSkinMaps(rasterizeSurfels(mesh, recipe.mapSize), fine ? sources.fineMap : coarse,
                     fine ? nullptr : &sources.fineDetail, person.skin, scalp, seedOf(person));
    const std::string albedo = person.name + "-albedo.png", normal = person.name + "-normal.png";
    writePng8(folder / albedo, maps.albedo, true);
    writePng8(folder / normal, maps.normal, false);
    ordered_json material;
    material["name"] = person.name + " skin";
    material["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", file.addTexture(albedo)}}},
                                        {"metallicFactor", 0},
                                        {"roughnessFactor", 0.5}};
    material["normalTexture"] = {{"index", file.addTexture(normal)}};
    material["extras"]["skin"] = {{"profile", "three-layer"},
                                  {"mix", person.skin.mix},
                                  {"roughness", person.skin.roughness},
                                  {"specular", person.skin.specular},
                                  {"lobe_weight", person.skin.lobeWeight},
                                  {"detail", person.skin.detail},
                                  {"translucency", true},
                                  {"mm_per_unit", 1000}};
    return addMeshNode(file, person.name + " skin", mesh, file.addMaterial(material));
}

// The clear shell before an iris.
ordered_json makeCorneaMaterial(const std::string& name) {
    constexpr double kIor = 1.376;      // Atchison & Smith 2000
    constexpr double kRoughness = 0.1;  // of the tear film as one sees it; sharper shows lamps as points
    ordered_json material;
    material["name"] = name;
    material["pbrMetallicRoughness"] = {{"metallicFactor", 0}, {"roughnessFactor", kRoughness}};
    material["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", 1}};
    material["extensions"]["KHR_materials_ior"] = {{"ior", kIor}};
    return material;
}

int addEyes(GltfFile& file, const fs::path& folder, const Sources& sources, const PersonRecipe& person,
            const std::vector<Eye>& eyes, const TriangleMesh& skin) {
    const std::string colors = person.name + "-eye.png";
    writePng8(folder / colors,
              makeEyeColors(readColors(sources.makeHuman / "public/data/proxies/eyes/HighPolyEyes/textures" /
                                       (person.iris + "_eye.png")),
                            person.irisGain),
              true);
    const int texture = file.addTexture(colors);
    const auto painted = [&](const char* part, double roughness) {
        ordered_json material;
        material["name"] = person.name + " " + part;
        material["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", texture}}},
                                            {"metallicFactor", 0},
                                            {"roughnessFactor", roughness}};
        return material;
    };
    ordered_json iris = painted("irises", 1);
    // What lies before it has its own refractive index: it reflects nothing at its surface.
    iris["extensions"]["KHR_materials_specular"] = {{"specularFactor", 0}};
    const int scleraMaterial = file.addMaterial(painted("eyes", 0.12)), irisMaterial = file.addMaterial(iris),
              corneaMaterial = file.addMaterial(makeCorneaMaterial(person.name + " corneas"));
    std::vector<int> nodes;
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        const std::string side = person.name + (i == 0 ? " left " : " right ");
        TriangleMesh sclera = makeSclera(eyes[i], person.irisScale),
                     disc = makeIris(eyes[i], person.irisScale);
        shadeByOpenness(sclera, eyes[i], skin);
        shadeByOpenness(disc, eyes[i], skin);
        nodes.push_back(addMeshNode(file, side + "eye", sclera, scleraMaterial));
        nodes.push_back(addMeshNode(file, side + "iris", disc, irisMaterial));
        nodes.push_back(
            addMeshNode(file, side + "cornea", makeCornea(eyes[i], person.irisScale), corneaMaterial));
    }
    return file.addNode({{"name", person.name + " eyes"}, {"children", nodes}});
}

// One proxy of scalp hair, brows or lashes, posed with the head.
struct Hair {
    std::string name;
    HairRecipe recipe;
    TriangleMesh mesh;
    Raster colors;
    bool onScalp() const { return recipe.proxy.starts_with("hair/"); }
};

Hair makeHair(const Sources& sources, const std::string& person, const HairRecipe& recipe,
              const std::vector<glm::dvec3>& positions, const Pose& pose, const Following& following,
              const TriangleMesh& skin) {
    const Proxy proxy = loadProxy(sources.makeHuman, recipe.proxy);
    QuadMesh fitted = fitProxy(proxy, sources.base, positions);
    for (std::size_t i = 0; i < fitted.positions.size(); ++i) {
        double weight = 0;
        for (int k = 0; k < 3; ++k) weight += proxy.weights[i][k] * following.head.at(proxy.references[i][k]);
        fitted.positions[i] = pose.applyHead(fitted.positions[i], std::clamp(weight, 0.0, 1.0));
    }
    Hair hair{person + " " + fs::path(recipe.proxy).filename().string(), recipe,
              triangulate(subdivide(fitted, 1)), makeHairColors(readColors(proxy.texture), recipe)};
    if (hair.onScalp()) liftHair(hair.mesh, skin);
    return hair;
}

// Darkens the skin under scalp hair, so that roots do not end on bare skin.
glm::dvec3 coverScalp(TriangleMesh& skin, const std::vector<Hair>& hair) {
    constexpr double kShown = 0.75;  // of the hair's colour at full cover; the rest is skin between the roots
    glm::dvec3 color(0);
    for (const Hair& h : hair) {
        if (!h.onScalp()) continue;
        skin.cover = computeCover(skin, h.mesh, h.colors);
        for (double& share : skin.cover) share *= kShown;
        color = meanHairColor(h.colors);
    }
    return color;
}

int addHair(GltfFile& file, const fs::path& folder, const Hair& hair) {
    std::string image = hair.name + ".png";
    std::replace(image.begin(), image.end(), ' ', '-');
    writePng8(folder / image, hair.colors, true);
    ordered_json material;
    material["name"] = hair.name;
    material["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", file.addTexture(image)}}},
                                        {"metallicFactor", 0},
                                        {"roughnessFactor", hair.recipe.roughness}};
    material["doubleSided"] = true;
    material["alphaMode"] = hair.recipe.cutoff > 0 ? "MASK" : "BLEND";
    if (hair.recipe.cutoff > 0) material["alphaCutoff"] = hair.recipe.cutoff;
    return addMeshNode(file, hair.name, hair.mesh, file.addMaterial(material));
}

int addShirt(GltfFile& file, const fs::path& folder, const PersonRecipe& person, const TriangleMesh& mesh) {
    constexpr int kTile = 256;
    const char* image = "knit-normal.png";
    if (!fs::exists(folder / image)) writePng8(folder / image, makeKnit(kTile), false);
    ordered_json material;
    material["name"] = person.name + " shirt";
    const glm::dvec3& c = person.shirt.color;
    material["pbrMetallicRoughness"] = {
        {"baseColorFactor", {c.x, c.y, c.z, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0.85}};
    material["normalTexture"] = {{"index", file.addTexture(image, true)}, {"scale", 0.4}};
    // Fibres that stand off the cloth: a pale rim where one looks along it.
    const glm::dvec3 fuzz = 0.02 + 0.2 * c;
    material["extensions"]["KHR_materials_sheen"] = {{"sheenColorFactor", {fuzz.x, fuzz.y, fuzz.z}},
                                                     {"sheenRoughnessFactor", 0.5}};
    material["doubleSided"] = true;
    return addMeshNode(file, person.name + " shirt", mesh, file.addMaterial(material));
}

}  // namespace

Sources readSources(const fs::path& makeHuman, const fs::path& morseRig) {
    constexpr std::size_t kMapOffset = 11420240;  // of the PNG in morse's human_rig.blend, once decompressed
    Sources sources{makeHuman, loadBaseMesh(makeHuman), readPackedColors(morseRig, kMapOffset), {}};
    sources.fineDetail = computeDetail(sources.fineMap);
    return sources;
}

int addPerson(GltfFile& file, const fs::path& folder, const Sources& sources, const PersonRecipe& person,
              const Recipe& recipe, const glm::dvec3& lookAt) {
    const BaseMesh& base = sources.base;
    const std::vector<glm::dvec3> positions = applyTargets(sources.makeHuman, base, person.targets);
    const Following following = computeFollowing(base);
    const auto radians = [](double degrees) { return degrees * 3.14159265358979323846 / 180; };
    const auto gather = [&](const char* group, const std::vector<glm::dvec3>& from) {
        std::vector<glm::dvec3> points;
        for (const int v : base.groupVertices(group)) points.push_back(from[v]);
        return points;
    };
    Pose pose{};
    pose.origin = 0.5 * (fitEye(gather("helper-l-eye", positions)).centre +
                         fitEye(gather("helper-r-eye", positions)).centre);
    pose.neck = glm::mix(base.joint("neck", positions), base.joint("head", positions), 0.6);
    pose.head =
        glm::dquat(glm::dvec3(radians(person.headNod), radians(person.headTurn), radians(person.headTilt)));
    constexpr double kArmsDown = 30;  // degrees, from MakeHuman's outstretched arms
    pose.leftShoulder = base.joint("l-shoulder", positions);
    pose.rightShoulder = base.joint("r-shoulder", positions);
    pose.leftArm = glm::dquat(glm::dvec3(0, 0, -radians(kArmsDown)));
    pose.rightArm = glm::dquat(glm::dvec3(0, 0, radians(kArmsDown)));
    std::vector<glm::dvec3> posed(positions.size());
    for (std::size_t i = 0; i < posed.size(); ++i) posed[i] = pose.apply(positions[i], following, i);

    TriangleMesh skin = makeSkinMesh(selectSkin(base, posed, person.shirt), recipe.levels);
    const glm::dquat turn(glm::dvec3(0, radians(person.turn), 0));
    std::vector<Eye> eyes;
    for (const char* group : {"helper-l-eye", "helper-r-eye"}) {
        Eye eye = fitEye(gather(group, posed));
        eye.gaze = glm::normalize(glm::inverse(turn) * (lookAt - person.eyes) - eye.centre);
        eyes.push_back(eye);
    }
    std::vector<Hair> hair;
    for (const HairRecipe& h : person.hair)
        hair.push_back(makeHair(sources, person.name, h, positions, pose, following, skin));
    const glm::dvec3 scalp = coverScalp(skin, hair);
    std::vector<int> children{addSkin(file, folder, sources, person, recipe, skin, scalp),
                              addEyes(file, folder, sources, person, eyes, skin)};
    for (const Hair& h : hair) children.push_back(addHair(file, folder, h));
    const QuadMesh torso = selectTorso(base, posed, person.shirt),
                   baseTorso = selectTorso(base, base.mesh.positions, person.shirt);
    children.push_back(
        addShirt(file, folder, person, makeShirt(torso, baseTorso, person.shirt.drop, seedOf(person))));
    return file.addNode({{"name", person.name},
                         {"translation", vector(person.eyes)},
                         {"rotation", quaternion(turn)},
                         {"children", children}});
}

}  // namespace cutis::people
