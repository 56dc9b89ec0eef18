#include "renderer/scene/gltf_writer.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/core/parallel.h"
#include "renderer/scene/image_io.h"
#include "renderer/scene/light_samples.h"
#include "renderer/scene/skin_material.h"

namespace cutis {
namespace {

using nlohmann::json;

// Numbers that the glTF 2.0 specification gives its enumerations.
enum : int {
    kFloat = 5126,
    kUnsignedInt = 5125,
    kVertexView = 34962,
    kIndexView = 34963,
    kNearest = 9728,
    kLinear = 9729,
    kNearestMipmapNearest = 9984,
    kLinearMipmapLinear = 9987,
};

template <int N, typename T>
json toJson(const glm::vec<N, T>& v) {
    json array = json::array();
    for (int i = 0; i < N; ++i) array.push_back(v[i]);
    return array;
}

class GlbWriter {
  public:
    explicit GlbWriter(const Scene& scene) : scene_(scene) {}

    std::vector<std::byte> write() {
        root_["asset"] = {{"version", "2.0"}, {"generator", "cutis"}};
        writeMaterials();
        writeTextures();
        writeMeshes();
        writeNodes();
        if (!extensions_.empty()) root_["extensionsUsed"] = extensions_;
        if (!binary_.empty()) root_["buffers"].push_back({{"byteLength", binary_.size()}});
        return container();
    }

  private:
    // Appends bytes to the binary chunk; returns the index of their buffer view.
    int addView(std::span<const std::byte> bytes, int target = 0) {
        binary_.resize((binary_.size() + 3) / 4 * 4);
        json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
        if (target) view["target"] = target;
        binary_.insert(binary_.end(), bytes.begin(), bytes.end());
        root_["bufferViews"].push_back(std::move(view));
        return int(root_["bufferViews"].size()) - 1;
    }

    template <typename T>
    int addAccessor(const std::vector<T>& values, const char* type, int componentType, int target) {
        const int view = addView(std::as_bytes(std::span(values)), target);
        root_["accessors"].push_back({{"bufferView", view},
                                      {"componentType", componentType},
                                      {"count", values.size()},
                                      {"type", type}});
        return int(root_["accessors"].size()) - 1;
    }

    json textureInfo(const TextureSlot& slot) {
        json info = {{"index", slot.texture}};
        if (slot.texCoord) info["texCoord"] = slot.texCoord;
        if (slot.transform == glm::mat3(1)) return info;
        // uv' = T R S uv with R = (cos sin; -sin cos), see readTransform of the loader.
        const glm::vec2 u(slot.transform[0]), v(slot.transform[1]);
        const double rotation = std::atan2(-u.y, u.x);
        const glm::vec2 across(std::sin(rotation), std::cos(rotation));
        info["extensions"]["KHR_texture_transform"] = {{"offset", toJson(glm::vec2(slot.transform[2]))},
                                                       {"rotation", rotation},
                                                       {"scale", {glm::length(u), glm::dot(v, across)}}};
        extensions_.insert("KHR_texture_transform");
        return info;
    }

    void writeMaterials() {
        for (const Material& material : scene_.materials) {
            json m = json::object();
            if (!material.name.empty()) m["name"] = material.name;
            json& pbr = m["pbrMetallicRoughness"];
            pbr = {{"baseColorFactor", toJson(material.baseColor)},
                   {"metallicFactor", material.metallic},
                   {"roughnessFactor", material.roughness}};
            if (material.baseColorTexture) pbr["baseColorTexture"] = textureInfo(material.baseColorTexture);
            if (material.metallicRoughnessTexture) {
                pbr["metallicRoughnessTexture"] = textureInfo(material.metallicRoughnessTexture);
            }
            if (material.normalTexture) {
                m["normalTexture"] = textureInfo(material.normalTexture);
                m["normalTexture"]["scale"] = material.normalScale;
            }
            if (material.occlusionTexture) {
                m["occlusionTexture"] = textureInfo(material.occlusionTexture);
                m["occlusionTexture"]["strength"] = material.occlusionStrength;
            }
            if (material.emissiveTexture) m["emissiveTexture"] = textureInfo(material.emissiveTexture);
            writeEmissive(m, material);
            if (material.alphaMode == AlphaMode::mask) m["alphaMode"] = "MASK";
            if (material.alphaMode == AlphaMode::blend) m["alphaMode"] = "BLEND";
            if (material.alphaMode == AlphaMode::mask) m["alphaCutoff"] = material.alphaCutoff;
            if (material.doubleSided) m["doubleSided"] = true;
            if (material.unlit) {
                m["extensions"]["KHR_materials_unlit"] = json::object();
                extensions_.insert("KHR_materials_unlit");
            }
            writeLayers(m, material);
            if (material.skin) m["extras"]["skin"] = skinMaterialJson(*material.skin);
            root_["materials"].push_back(std::move(m));
        }
    }

    void writeTexture(json& owner, const char* key, const TextureSlot& slot) {
        if (slot) owner[key] = textureInfo(slot);
    }

    // The extensions over metallic-roughness, each where it says more than nothing.
    void writeLayers(json& m, const Material& material) {
        const auto add = [&](const char* name, json content) {
            m["extensions"][name] = std::move(content);
            extensions_.insert(name);
        };
        const Dielectric& d = material.dielectric;
        if (d.ior != 1.5f) add("KHR_materials_ior", {{"ior", d.ior}});
        if (d.specular != 1 || d.specularColor != glm::vec3(1) || d.specularTexture ||
            d.specularColorTexture) {
            json specular = {{"specularFactor", d.specular},
                             {"specularColorFactor", toJson(d.specularColor)}};
            writeTexture(specular, "specularTexture", d.specularTexture);
            writeTexture(specular, "specularColorTexture", d.specularColorTexture);
            add("KHR_materials_specular", std::move(specular));
        }
        if (const Clearcoat& c = material.clearcoat; c.factor > 0) {
            json coat = {{"clearcoatFactor", c.factor}, {"clearcoatRoughnessFactor", c.roughness}};
            writeTexture(coat, "clearcoatTexture", c.texture);
            writeTexture(coat, "clearcoatRoughnessTexture", c.roughnessTexture);
            writeTexture(coat, "clearcoatNormalTexture", c.normalTexture);
            if (c.normalTexture) coat["clearcoatNormalTexture"]["scale"] = c.normalScale;
            add("KHR_materials_clearcoat", std::move(coat));
        }
        if (const Sheen& s = material.sheen; s.color != glm::vec3(0)) {
            json sheen = {{"sheenColorFactor", toJson(s.color)}, {"sheenRoughnessFactor", s.roughness}};
            writeTexture(sheen, "sheenColorTexture", s.colorTexture);
            writeTexture(sheen, "sheenRoughnessTexture", s.roughnessTexture);
            add("KHR_materials_sheen", std::move(sheen));
        }
        if (material.transmission > 0) {
            json through = {{"transmissionFactor", material.transmission}};
            writeTexture(through, "transmissionTexture", material.transmissionTexture);
            add("KHR_materials_transmission", std::move(through));
        }
    }

    // glTF wants factors in [0, 1]; what exceeds that is the extension's strength.
    void writeEmissive(json& m, const Material& material) {
        const glm::vec3 emissive = material.emissive;
        const float strength = std::max({emissive.r, emissive.g, emissive.b, 1.f});
        if (emissive != glm::vec3(0)) m["emissiveFactor"] = toJson(emissive / strength);
        if (strength > 1) {
            m["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", strength}};
            extensions_.insert("KHR_materials_emissive_strength");
        }
    }

    void writeTextures() {
        std::vector<std::vector<std::byte>> files(scene_.images.size());
        parallelFor(files.size(), [&](std::size_t i) { files[i] = encodePng(scene_.images[i]); });
        for (std::size_t i = 0; i < files.size(); ++i) {
            json image = {{"mimeType", "image/png"}, {"bufferView", addView(files[i])}};
            if (!scene_.images[i].name.empty()) image["name"] = scene_.images[i].name;
            root_["images"].push_back(std::move(image));
        }
        for (const Texture& texture : scene_.textures) {
            const auto wrap = [](Wrap w) {
                return w == Wrap::repeat ? 10497 : w == Wrap::mirroredRepeat ? 33648 : 33071;
            };
            const Sampler& s = texture.sampler;
            const int minFilter = s.mipmapped ? (s.nearest ? kNearestMipmapNearest : kLinearMipmapLinear)
                                              : (s.nearest ? kNearest : kLinear);
            root_["samplers"].push_back({{"wrapS", wrap(s.wrapU)},
                                         {"wrapT", wrap(s.wrapV)},
                                         {"magFilter", s.nearest ? kNearest : kLinear},
                                         {"minFilter", minFilter}});
            root_["textures"].push_back(
                {{"source", texture.image}, {"sampler", root_["samplers"].size() - 1}});
        }
    }

    void writeMeshes() {
        for (const Mesh& mesh : scene_.meshes) {
            json m = {{"primitives", json::array()}};
            if (!mesh.name.empty()) m["name"] = mesh.name;
            for (const Primitive& primitive : mesh.primitives)
                m["primitives"].push_back(primitiveJson(primitive));
            root_["meshes"].push_back(std::move(m));
        }
    }

    json primitiveJson(const Primitive& p) {
        json primitive = {{"attributes", json::object()}};
        json& attributes = primitive["attributes"];
        const auto add = [&](const char* name, const auto& values, const char* type) {
            if (!values.empty()) attributes[name] = addAccessor(values, type, kFloat, kVertexView);
        };
        add("POSITION", p.positions, "VEC3");
        if (!p.positions.empty()) {
            glm::vec3 low = p.positions[0], high = p.positions[0];
            for (const glm::vec3& v : p.positions) low = glm::min(low, v), high = glm::max(high, v);
            root_["accessors"].back()["min"] = toJson(low);
            root_["accessors"].back()["max"] = toJson(high);
        }
        add("NORMAL", p.normals, "VEC3");
        add("TANGENT", p.tangents, "VEC4");
        add("TEXCOORD_0", p.uv0, "VEC2");
        add("TEXCOORD_1", p.uv1, "VEC2");
        add("COLOR_0", p.colors, "VEC4");
        if (!p.indices.empty())
            primitive["indices"] = addAccessor(p.indices, "SCALAR", kUnsignedInt, kIndexView);
        if (p.material >= 0) primitive["material"] = p.material;
        return primitive;
    }

    void writeNodes() {
        std::vector<bool> cameraPlaced(scene_.cameras.size()), lightPlaced(scene_.lights.size());
        json roots = json::array();
        for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
            const Node& node = scene_.nodes[i];
            json n = json::object();
            if (!node.name.empty()) n["name"] = node.name;
            if (!node.children.empty()) n["children"] = node.children;
            writeMatrix(n, node.local);
            if (node.mesh >= 0) n["mesh"] = node.mesh;
            if (node.camera >= 0) {
                n["camera"] = addCamera(scene_.cameras[node.camera]);
                cameraPlaced[node.camera] = true;
            }
            if (node.light >= 0) {
                addLight(n, scene_.lights[node.light]);
                lightPlaced[node.light] = true;
            }
            if (node.parent < 0) roots.push_back(i);
            root_["nodes"].push_back(std::move(n));
        }
        const auto addRoot = [&](json n) {
            roots.push_back(root_["nodes"].size());
            root_["nodes"].push_back(std::move(n));
        };
        for (std::size_t i = 0; i < scene_.cameras.size(); ++i) {
            if (cameraPlaced[i]) continue;
            json n = {{"name", scene_.cameras[i].name}, {"camera", addCamera(scene_.cameras[i])}};
            writeMatrix(n, scene_.cameras[i].world);
            addRoot(std::move(n));
        }
        for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
            if (lightPlaced[i]) continue;
            json n = {{"name", scene_.lights[i].name}};
            writeMatrix(n, lightFrame(scene_.lights[i]));
            if (addLight(n, scene_.lights[i])) addRoot(std::move(n));
        }
        json scene = json::object();
        if (!roots.empty()) scene["nodes"] = roots;
        if (!scene_.name.empty()) scene["name"] = scene_.name;
        root_["scenes"].push_back(std::move(scene));
        root_["scene"] = 0;
    }

    static void writeMatrix(json& node, const glm::dmat4& matrix) {
        if (matrix == glm::dmat4(1)) return;
        for (int c = 0; c < 4; ++c) {
            for (int r = 0; r < 4; ++r) node["matrix"].push_back(matrix[c][r]);
        }
    }

    // Looks along its -Z, as glTF's lights do.
    static glm::dmat4 lightFrame(const Light& light) {
        const glm::dvec3 z = -glm::normalize(light.direction);
        const glm::dvec3 up = std::abs(z.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        const glm::dvec3 x = glm::normalize(glm::cross(up, z));
        return {glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0),
                glm::dvec4(light.position, 1)};
    }

    int addCamera(const Camera& camera) {
        json c = json::object();
        if (!camera.name.empty()) c["name"] = camera.name;
        if (camera.orthographic) {
            c["type"] = "orthographic";
            // zfar is required here; an endless one is far enough at 1e6 times the near plane.
            const double zfar = camera.zfar > 0 ? camera.zfar : std::max(1.0, camera.znear) * 1e6;
            c["orthographic"] = {
                {"xmag", camera.xmag}, {"ymag", camera.ymag}, {"znear", camera.znear}, {"zfar", zfar}};
        } else {
            c["type"] = "perspective";
            c["perspective"] = {{"yfov", camera.yfov}, {"znear", camera.znear}};
            if (camera.zfar > 0) c["perspective"]["zfar"] = camera.zfar;
            if (camera.aspect > 0) c["perspective"]["aspectRatio"] = camera.aspect;
        }
        root_["cameras"].push_back(std::move(c));
        return int(root_["cameras"].size()) - 1;
    }

    // False when glTF has no such light.
    bool addLight(json& node, const Light& light) {
        if (light.type == LightType::rect) {
            warn("glTF has no rect lights: \"" + light.name + "\" is left out");
            return false;
        }
        glm::dvec3 color = light.color;
        if (light.temperature) color *= colorFromTemperature(*light.temperature);
        const double excess = std::max({color.r, color.g, color.b, 1.0});  // glTF's colours are in [0, 1]
        json l = {{"type", light.type == LightType::directional ? "directional"
                           : light.type == LightType::spot      ? "spot"
                                                                : "point"},
                  {"color", toJson(color / excess)},
                  {"intensity", light.intensity * excess}};
        if (!light.name.empty()) l["name"] = light.name;
        if (light.range > 0 && light.type != LightType::directional) l["range"] = light.range;
        if (light.type == LightType::spot) {
            l["spot"] = {{"innerConeAngle", light.innerConeAngle}, {"outerConeAngle", light.outerConeAngle}};
        }
        json& lights = root_["extensions"]["KHR_lights_punctual"]["lights"];
        lights.push_back(std::move(l));
        node["extensions"]["KHR_lights_punctual"]["light"] = lights.size() - 1;
        extensions_.insert("KHR_lights_punctual");
        return true;
    }

    // glTF 2.0, §4.4: a header and two chunks, each padded to 4 bytes, JSON with spaces and binary with
    // zeros.
    std::vector<std::byte> container() {
        std::string text = root_.dump(-1, ' ', false, json::error_handler_t::replace);
        text.resize((text.size() + 3) / 4 * 4, ' ');
        binary_.resize((binary_.size() + 3) / 4 * 4);
        const std::uint64_t total = 12 + 8 + text.size() + (binary_.empty() ? 0 : 8 + binary_.size());
        if (total > std::numeric_limits<std::uint32_t>::max()) {
            throw Error("cannot write scene", "a .glb file holds at most 4 GiB", scene_.name);
        }
        std::vector<std::byte> file;
        file.reserve(total);
        const auto put = [&](const void* data, std::size_t size) {
            const auto* bytes = static_cast<const std::byte*>(data);
            file.insert(file.end(), bytes, bytes + size);
        };
        const auto put32 = [&](std::uint64_t value) {
            const auto word = static_cast<std::uint32_t>(value);
            put(&word, sizeof word);
        };
        put("glTF", 4), put32(2), put32(total);
        put32(text.size()), put("JSON", 4), put(text.data(), text.size());
        if (!binary_.empty()) put32(binary_.size()), put("BIN\0", 4), put(binary_.data(), binary_.size());
        return file;
    }

    const Scene& scene_;
    json root_;
    std::vector<std::byte> binary_;
    std::set<std::string> extensions_;
};

}  // namespace

void writeGlb(const Scene& scene, const std::filesystem::path& path) {
    writeFileAtomically(path, GlbWriter(scene).write());
}

}  // namespace cutis
