#include "renderer/scene/gltf_accessors.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <string_view>
#include <type_traits>

namespace cutis::gltf {
namespace {

enum class ComponentType {
    int8 = 5120,
    uint8 = 5121,
    int16 = 5122,
    uint16 = 5123,
    uint32 = 5125,
    float32 = 5126
};

std::size_t sizeOf(ComponentType type) {
    switch (type) {
        case ComponentType::int8:
        case ComponentType::uint8:
            return 1;
        case ComponentType::int16:
        case ComponentType::uint16:
            return 2;
        case ComponentType::uint32:
        case ComponentType::float32:
            return 4;
    }
    return 0;
}

ComponentType readComponentType(const JsonView& owner) {
    const JsonView value = owner.member("componentType");
    const std::int64_t code = value.integer();
    switch (code) {
        case 5120:
        case 5121:
        case 5122:
        case 5123:
        case 5125:
        case 5126:
            return ComponentType(code);
    }
    value.fail("no component type has the number " + std::to_string(code));
}

// Elements of equal layout in a buffer view: `count` times `components` values, `stride` bytes apart.
struct Elements {
    const std::byte* data = nullptr;  // nullptr: all zero
    std::size_t count = 0, components = 1, stride = 0;
    ComponentType type = ComponentType::float32;
    bool normalized = false;
};

// Finds `elements` (count, components and type given) in the view that `owner` names, and checks that they
// fit.
void locate(Document& document, const JsonView& owner, Elements& elements, bool mayInterleave) {
    const JsonView reference = owner.member("bufferView");
    const std::size_t index = reference.index(document.count("bufferViews"), "bufferViews");
    const auto bytes = document.bufferView(index);
    const JsonView view = document.entry("bufferViews", index);
    const std::size_t size = sizeOf(elements.type) * elements.components;
    const std::size_t offset = owner.natural("byteOffset", 0);
    elements.stride = mayInterleave ? view.natural("byteStride", size) : size;
    if (elements.stride < size || elements.stride > 252 + size) {
        view.member("byteStride")
            .fail("a stride of " + std::to_string(elements.stride) + " bytes for elements of " +
                  std::to_string(size));
    }
    // All factors are below 2^53 and stride below 2^9: no product overflows 64 bits before count is known to
    // be sane.
    const std::size_t room = offset <= bytes.size() ? bytes.size() - offset : 0;
    if (elements.count > 0 && (room < size || elements.count - 1 > (room - size) / elements.stride)) {
        owner.fail(std::to_string(elements.count) + " elements of " + std::to_string(size) +
                   " bytes at offset " + std::to_string(offset) + " exceed their buffer view of " +
                   std::to_string(bytes.size()));
    }
    elements.data = bytes.data() + offset;
}

// One component as T; integers are normalized to [0, 1] or [-1, 1] (glTF 2.0, §3.6.2.2) when T is float.
template <typename T, typename Stored>
T convert(const std::byte* at, bool normalized) {
    Stored stored;
    std::memcpy(&stored, at, sizeof stored);
    if constexpr (std::is_floating_point_v<T> && std::is_integral_v<Stored>) {
        if (normalized) return std::max(T(stored) / T(std::numeric_limits<Stored>::max()), T(-1));
    }
    return static_cast<T>(stored);
}

// Writes element i of `from` to out + indexOf(i) · width, `components` values of it.
template <typename T, typename Stored, typename IndexOf>
void copyAs(const Elements& from, T* out, std::size_t width, const IndexOf& indexOf) {
    for (std::size_t i = 0; i < from.count; ++i) {
        const std::byte* at = from.data + i * from.stride;
        T* target = out + indexOf(i) * width;
        for (std::size_t c = 0; c < from.components; ++c) {
            target[c] = convert<T, Stored>(at + c * sizeof(Stored), from.normalized);
        }
    }
}

template <typename T, typename IndexOf>
void copyElements(const Elements& from, T* out, std::size_t width, const IndexOf& indexOf) {
    switch (from.type) {
        case ComponentType::int8:
            return copyAs<T, std::int8_t>(from, out, width, indexOf);
        case ComponentType::uint8:
            return copyAs<T, std::uint8_t>(from, out, width, indexOf);
        case ComponentType::int16:
            return copyAs<T, std::int16_t>(from, out, width, indexOf);
        case ComponentType::uint16:
            return copyAs<T, std::uint16_t>(from, out, width, indexOf);
        case ComponentType::uint32:
            return copyAs<T, std::uint32_t>(from, out, width, indexOf);
        case ComponentType::float32:
            // A float out of an integer's range must not be converted to it; readers of integers refuse
            // floats.
            if constexpr (std::is_floating_point_v<T>) return copyAs<T, float>(from, out, width, indexOf);
    }
}

// The values that replace some of `all` (glTF 2.0, §3.6.2.3).
template <typename T>
void applySparse(Document& document, const JsonView& sparse, const Elements& all, T* out, std::size_t width) {
    Elements indices, values = all;
    indices.count = values.count = sparse.natural("count", 0);
    if (values.count > all.count) sparse.fail("it replaces more elements than there are");
    const JsonView indicesView = sparse.member("indices"), valuesView = sparse.member("values");
    indices.type = readComponentType(indicesView);
    if (indices.type != ComponentType::uint8 && indices.type != ComponentType::uint16 &&
        indices.type != ComponentType::uint32) {
        indicesView.fail("indices must be unsigned integers");
    }
    locate(document, indicesView, indices, false);
    locate(document, valuesView, values, false);
    std::vector<std::uint32_t> places(indices.count);
    copyElements(indices, places.data(), 1, [](std::size_t i) { return i; });
    for (const std::uint32_t place : places) {
        if (place >= all.count) {
            indicesView.fail("index " + std::to_string(place) + " of " + std::to_string(all.count) +
                             " elements");
        }
    }
    copyElements(values, out, width, [&](std::size_t i) { return std::size_t(places[i]); });
}

struct Shape {
    const char* type;
    std::size_t components;
};

// Reads an accessor whose type is one of `shapes` into values of `width` components; those that the file does
// not give keep `fill`.
template <typename T>
std::vector<T> readAccessor(Document& document, const JsonView& reference,
                            std::initializer_list<Shape> shapes, std::size_t width, T fill) {
    const JsonView accessor = document.resolve(reference, "accessors");
    Elements elements;
    elements.type = readComponentType(accessor);
    elements.normalized = accessor.boolean("normalized", false);
    const std::string type = accessor.member("type").string();
    const auto shape = std::ranges::find_if(shapes, [&](const Shape& s) { return s.type == type; });
    if (shape == shapes.end()) {
        reference.fail("its accessor is of type " + type + ", not " + std::string(shapes.begin()->type));
    }
    elements.components = shape->components;
    if (!std::is_floating_point_v<T> && elements.type != ComponentType::uint8 &&
        elements.type != ComponentType::uint16 && elements.type != ComponentType::uint32) {
        reference.fail("its accessor must hold unsigned integers");
    }
    const JsonView count = accessor.member("count");
    const std::int64_t stated = count.integer();
    if (stated < 1 || stated > std::int64_t(kMaxDecodedBytes))
        count.fail("there cannot be " + std::to_string(stated));
    elements.count = std::size_t(stated);
    // Before anything is allocated: the buffer is as large as the count says, or the memory is accounted for.
    const std::vector<std::byte>* supplied =
        document.suppliedTo(reference.index(document.count("accessors"), "accessors"));
    const bool stored = supplied || accessor.find("bufferView").has_value();
    if (supplied) {
        elements.stride = sizeOf(elements.type) * elements.components;
        elements.data = supplied->data();
        if (supplied->size() < elements.count * elements.stride) reference.fail("its compressed data is of another type");
    } else if (stored) {
        locate(document, accessor, elements, true);
    }
    document.spend(elements.count * width * sizeof(T), reference);

    std::vector<T> values(elements.count * width, T(0));
    for (std::size_t i = elements.components; i < width; ++i) {
        for (std::size_t e = 0; e < elements.count; ++e) values[e * width + i] = fill;
    }
    if (stored) {
        const bool packed = std::is_same_v<T, float> && elements.type == ComponentType::float32 &&
                            elements.components == width && elements.stride == width * sizeof(T);
        if (packed) {
            std::memcpy(values.data(), elements.data, values.size() * sizeof(T));
        } else {
            copyElements(elements, values.data(), width, [](std::size_t i) { return i; });
        }
    }
    if (const auto sparse = accessor.find("sparse"))
        applySparse(document, *sparse, elements, values.data(), width);
    return values;
}

// The same bytes as vectors.
template <typename Vector, typename T>
std::vector<Vector> grouped(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<Vector> && sizeof(Vector) % sizeof(T) == 0);
    std::vector<Vector> vectors(values.size() * sizeof(T) / sizeof(Vector));
    std::memcpy(static_cast<void*>(vectors.data()), values.data(), values.size() * sizeof(T));
    return vectors;
}

}  // namespace

std::vector<float> readScalars(Document& document, const JsonView& reference) {
    return readAccessor<float>(document, reference, {{"SCALAR", 1}}, 1, 0);
}

std::vector<glm::vec2> readVec2(Document& document, const JsonView& reference) {
    return grouped<glm::vec2>(readAccessor<float>(document, reference, {{"VEC2", 2}}, 2, 0));
}

std::vector<glm::vec3> readVec3(Document& document, const JsonView& reference) {
    return grouped<glm::vec3>(readAccessor<float>(document, reference, {{"VEC3", 3}}, 3, 0));
}

std::vector<glm::vec4> readVec4(Document& document, const JsonView& reference) {
    return grouped<glm::vec4>(readAccessor<float>(document, reference, {{"VEC4", 4}}, 4, 0));
}

std::vector<glm::mat4> readMat4(Document& document, const JsonView& reference) {
    return grouped<glm::mat4>(readAccessor<float>(document, reference, {{"MAT4", 16}}, 16, 0));
}

std::vector<glm::vec4> readColors(Document& document, const JsonView& reference) {
    return grouped<glm::vec4>(readAccessor<float>(document, reference, {{"VEC4", 4}, {"VEC3", 3}}, 4, 1));
}

std::vector<std::uint32_t> readIndices(Document& document, const JsonView& reference) {
    return readAccessor<std::uint32_t>(document, reference, {{"SCALAR", 1}}, 1, 0);
}

std::vector<glm::uvec4> readJoints(Document& document, const JsonView& reference) {
    return grouped<glm::uvec4>(readAccessor<std::uint32_t>(document, reference, {{"VEC4", 4}}, 4, 0));
}

}  // namespace cutis::gltf
