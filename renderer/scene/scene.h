// The scene as plain data: what a glTF file holds once it is loaded, checked and made explicit.
// Units: metres, radians, linear Rec.709. Light quantities follow KHR_lights_punctual.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/light.h"
#include "renderer/scene/motion.h"
#include "renderer/skin/profile.h"

namespace cutis {

enum class Wrap { repeat, mirroredRepeat, clampToEdge };

struct Sampler {
    Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;
    bool nearest = false;  // magnification and minification without interpolation
    bool mipmapped = true;
    bool operator==(const Sampler&) const = default;
};

// rgba8: as stored in the file (sRGB or linear, see Texture::srgb); rgba16f: linear, never with Texture::srgb.
enum class TexelFormat { rgba8, rgba16f };

// A decoded image. Row 0 is the top row, as glTF's texture coordinates have it.
struct Image {
    std::string name;  // file, or "images[3]" when embedded; for messages
    int width = 0, height = 0;
    TexelFormat format = TexelFormat::rgba8;
    bool opaque = true;              // no texel has alpha below 1
    std::vector<std::byte> texels;  // width · height · 4 components, tightly packed
};

// An image as a material samples it. The same image used once as colour and once as data is two textures.
struct Texture {
    int image = -1;     // index into Scene::images
    bool srgb = false;  // decode sRGB before filtering (base colour, emissive)
    Sampler sampler;
    bool operator==(const Texture&) const = default;
};

// Where a material reads a texture: uv' = transform · (uv, 1), KHR_texture_transform included.
struct TextureSlot {
    int texture = -1;  // index into Scene::textures; -1: none
    int texCoord = 0;  // TEXCOORD_0 or TEXCOORD_1
    glm::mat3 transform{1};
    explicit operator bool() const { return texture >= 0; }
};

// Skin parameters of one material, `material.extras.skin` of DESIGN §2.2.
struct SkinMaterial {
    skin::Profile profile = skin::threeLayerProfile();  // variances in mm² at scale 1
    double scale = 1;        // multiplies lengths of the profile (variances by scale²)
    double mix = 0.5;        // pre/post-scatter mix in [0,1]: albedo^mix before, albedo^(1-mix) after
    double roughness = 0.3;  // m, Beckmann rms slope, in (0, 1]
    double specular = 1;     // s, specular scale, ≥ 0
    bool translucency = true;
    double mmPerUnit = 1000;  // millimetres in one scene unit
    // A second, narrower lobe of the same layer: f_s = s·((1 - w) f(m) + w f(ratio·m)).
    double lobeWeight = 0;   // w, in [0,1]; 0: there is none
    double lobeRatio = 0.5;  // its rms slope over that of the first, in (0,1]
    // Relief of pores where textures resolve none (skin/detail.h): feeds the specular layer alone.
    double detail = 0;       // multiplies its slopes, ≥ 0; 0: there is none
    double detailScale = 8;  // mm after which the relief repeats, > 0
};

enum class AlphaMode { opaque, mask, blend };

// How a surface that is no metal reflects: KHR_materials_ior and KHR_materials_specular.
struct Dielectric {
    float ior = 1.5f;            // ≥ 1; 0: reflects everything
    float specular = 1;          // scales the reflection, in [0,1]
    glm::vec3 specularColor{1};  // at normal incidence, ≥ 0
    TextureSlot specularTexture, specularColorTexture;  // A; RGB
};

// KHR_materials_clearcoat: a clear lacquer over everything else.
struct Clearcoat {
    float factor = 0, roughness = 0;        // in [0,1]
    TextureSlot texture, roughnessTexture;  // R; G
    TextureSlot normalTexture;              // none: the lacquer follows the smooth surface
    float normalScale = 1;
};

// KHR_materials_sheen: fibres that stand on the surface, as those of velvet.
struct Sheen {
    glm::vec3 color{0};                          // in [0,1]; 0: none
    float roughness = 0;                         // in [0,1]
    TextureSlot colorTexture, roughnessTexture;  // RGB; A
};

struct Material {
    std::string name;
    glm::vec4 baseColor{1};
    TextureSlot baseColorTexture;
    float metallic = 1, roughness = 1;
    TextureSlot metallicRoughnessTexture;  // G roughness, B metallic
    TextureSlot normalTexture;
    float normalScale = 1;
    TextureSlot occlusionTexture;  // R
    float occlusionStrength = 1;
    glm::vec3 emissive{0};  // KHR_materials_emissive_strength multiplied in
    TextureSlot emissiveTexture;
    AlphaMode alphaMode = AlphaMode::opaque;
    float alphaCutoff = 0.5f;
    bool doubleSided = false;
    bool unlit = false;  // KHR_materials_unlit
    // Of what is neither skin nor unlit:
    Dielectric dielectric;
    Clearcoat clearcoat;
    Sheen sheen;
    float transmission = 0;           // KHR_materials_transmission, in [0,1]: light goes straight through
    TextureSlot transmissionTexture;  // R
    std::optional<SkinMaterial> skin;

    bool layered() const { return !skin && !unlit; }  // has the four above
    // What lies behind it is seen through it.
    bool seenThrough() const { return alphaMode == AlphaMode::blend || (layered() && transmission > 0); }
    // The normal map that tangents are for; empty without one.
    const TextureSlot& tangentTexture() const { return normalTexture ? normalTexture : clearcoat.normalTexture; }
    // All slots, in the order of the SLOT_ bits of shaders/shared/scene.h.
    std::array<const TextureSlot*, 13> slots() const {
        return {&baseColorTexture, &metallicRoughnessTexture, &normalTexture, &occlusionTexture,
                &emissiveTexture, &dielectric.specularTexture, &dielectric.specularColorTexture,
                &clearcoat.texture, &clearcoat.roughnessTexture, &clearcoat.normalTexture,
                &sheen.colorTexture, &sheen.roughnessTexture, &transmissionTexture};
    }
};

// Triangles of one material, in the pose that the scene is in. Arrays have one element a vertex, or none where noted.
struct Primitive {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;   // always present and of unit length: computed when the file has none
    std::vector<glm::vec4> tangents;  // present when the material has Material::tangentTexture: w is the bitangent's sign
    std::vector<glm::vec2> uv0, uv1;  // may be empty
    std::vector<glm::vec4> colors;    // linear RGBA; may be empty
    std::vector<std::uint32_t> indices;  // three a triangle; degenerate and out-of-range triangles are gone
    int material = -1;                   // index into Scene::materials, always valid (a default one is added)
    std::shared_ptr<const Deformation> deformation;  // what poseScene computes its vertices from; null: it is rigid
    std::vector<glm::vec3> restPositions;  // in the pose at rest; empty where they never differ from `positions`
};

// A mesh with a deformation is that of one node alone.
struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
};

struct Node {
    std::string name;
    int parent = -1;
    std::vector<int> children;
    glm::dmat4 local{1};
    glm::dmat4 world{1};  // filled by updateWorldTransforms
    int mesh = -1, camera = -1, light = -1;
    int skin = -1;                  // index into Scene::skins, of the mesh
    std::vector<double> weights;    // of the mesh's morph targets, at rest
    std::optional<Transform> rest;  // `local` at rest, of a node that some animation moves
};

struct Camera {
    std::string name;
    bool orthographic = false;
    double yfov = 0.6;          // vertical field of view, radians (perspective)
    double xmag = 1, ymag = 1;  // half extents in metres (orthographic)
    double aspect = 0;          // 0: the picture's own
    double znear = 0.01;
    double zfar = 0;  // 0: infinite
    glm::dmat4 world{1};  // camera to world; looks along its -Z, +Y up
};

struct Bounds {
    glm::dvec3 min{std::numeric_limits<double>::infinity()}, max{-std::numeric_limits<double>::infinity()};
    bool empty() const { return !(min.x <= max.x); }
    void extend(const glm::dvec3& p) { min = glm::min(min, p), max = glm::max(max, p); }
    void extend(const Bounds& b) { if (!b.empty()) extend(b.min), extend(b.max); }
    glm::dvec3 centre() const { return (min + max) * 0.5; }
    glm::dvec3 size() const { return max - min; }
};

// A connected part of the node tree with skin material.
struct Character {
    std::string name;
    int root = -1;           // the topmost node that belongs to this character alone
    std::vector<int> nodes;  // nodes with a mesh, of this character, skin or not
    Bounds bounds;           // world, of all its meshes
};

struct Scene {
    std::string name;
    std::filesystem::path file;  // empty for a scene made in code
    std::vector<Image> images;
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Node> nodes;
    std::vector<Camera> cameras;  // in node order, world transforms resolved
    std::vector<Light> lights;    // KHR_lights_punctual, world placement resolved
    std::vector<Skin> skins;
    std::vector<Animation> animations;
    std::vector<Character> characters;
    std::vector<int> nodeCharacter;  // per node: index into characters, or -1
    Bounds bounds;                   // world, of all meshes
};

}  // namespace cutis
