// Primitives that are compressed by KHR_draco_mesh_compression.
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include "renderer/scene/codec/draco_codec.h"
#include "renderer/scene/codec_client.h"
#include "renderer/scene/gltf_parts.h"

namespace cutis::gltf {
namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t(1) << 30;  // of one primitive, decoded

// A decoded block (codec/draco_codec.h), taken apart.
struct DracoMesh {
    DracoHeader header;
    std::vector<std::uint32_t> indices;
    struct Attribute {
        std::size_t components = 0;
        std::vector<float> values;
    };
    std::map<std::uint32_t, Attribute> attributes;  // by id
};

class Reader {
  public:
    Reader(std::span<const std::byte> bytes, const JsonView& where) : bytes_(bytes), where_(where) {}
    template <class T>
    std::vector<T> take(std::uint64_t count) {
        if (count > bytes_.size() / sizeof(T)) where_.fail("its decoder gave no mesh");
        std::vector<T> values(count);
        if (count > 0) std::memcpy(values.data(), bytes_.data(), count * sizeof(T));
        bytes_ = bytes_.subspan(count * sizeof(T));
        return values;
    }

  private:
    std::span<const std::byte> bytes_;
    const JsonView& where_;
};

DracoMesh decode(Document& document, const JsonView& extension) {
    const std::size_t view =
        extension.member("bufferView").index(document.count("bufferViews"), "bufferViews");
    const CodecResult result = decodeDraco(document.bufferView(view), kMaxBytes);
    if (!result.why.empty()) extension.fail(result.why);
    document.spend(result.data.bytes().size(), extension);
    Reader reader(result.data.bytes(), extension);
    DracoMesh mesh;
    mesh.header = reader.take<DracoHeader>(1)[0];
    const std::vector<DracoAttribute> attributes = reader.take<DracoAttribute>(mesh.header.attributes);
    mesh.indices = reader.take<std::uint32_t>(std::uint64_t(mesh.header.triangles) * 3);
    for (const DracoAttribute& a : attributes) {
        mesh.attributes[a.id] = {a.components,
                                 reader.take<float>(std::uint64_t(mesh.header.points) * a.components)};
    }
    return mesh;
}

// Numbers as the components of an accessor, as its buffer view would hold them.
template <class Stored, class T>
std::vector<std::byte> stored(const std::vector<T>& values) {
    std::vector<std::byte> bytes(values.size() * sizeof(Stored));
    for (std::size_t i = 0; i < values.size(); ++i) {
        double value = double(values[i]);
        if constexpr (std::is_integral_v<Stored>) {
            using Limits = std::numeric_limits<Stored>;
            value = std::isfinite(value)
                        ? std::clamp(std::round(value), double(Limits::min()), double(Limits::max()))
                        : 0;
        }
        const auto component = static_cast<Stored>(value);
        std::memcpy(bytes.data() + i * sizeof(Stored), &component, sizeof component);
    }
    return bytes;
}

template <class T>
std::vector<std::byte> storedAs(const JsonView& componentType, const std::vector<T>& values) {
    switch (componentType.integer()) {
        case 5120:
            return stored<std::int8_t>(values);
        case 5121:
            return stored<std::uint8_t>(values);
        case 5122:
            return stored<std::int16_t>(values);
        case 5123:
            return stored<std::uint16_t>(values);
        case 5125:
            return stored<std::uint32_t>(values);
        case 5126:
            return stored<float>(values);
        default:
            componentType.fail("no component type has the number " + std::to_string(componentType.integer()));
    }
}

std::size_t componentsOf(const JsonView& accessor) {
    const std::string type = accessor.member("type").string();
    return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 0;
}

}  // namespace

void decompressPrimitive(Document& document, const JsonView& primitive) {
    const auto extensions = primitive.find("extensions");
    const auto extension = extensions ? extensions->find("KHR_draco_mesh_compression") : std::nullopt;
    if (!extension) return;
    const JsonView attributes = primitive.member("attributes");
    const DracoMesh mesh = decode(document, *extension);
    const auto supply = [&](const JsonView& reference, std::size_t count, std::size_t components,
                            const auto& values) {
        const JsonView accessor = document.resolve(reference, "accessors");
        if (accessor.member("count").integer() != std::int64_t(count) ||
            componentsOf(accessor) != components) {
            reference.fail("its accessor is not of the " + std::to_string(count) + " elements of " +
                           std::to_string(components) + " that are compressed");
        }
        document.supply(reference.index(document.count("accessors"), "accessors"),
                        storedAs(accessor.member("componentType"), values));
    };
    for (const auto& [name, id] : extension->member("attributes").members()) {
        const auto found = mesh.attributes.find(static_cast<std::uint32_t>(id.integer()));
        if (found == mesh.attributes.end()) id.fail("there is no attribute " + std::to_string(id.integer()));
        supply(attributes.member(name.c_str()), mesh.header.points, found->second.components,
               found->second.values);
    }
    if (const auto indices = primitive.find("indices"))
        supply(*indices, mesh.indices.size(), 1, mesh.indices);
}

}  // namespace cutis::gltf
