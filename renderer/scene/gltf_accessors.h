// Accessors of a glTF file as plain arrays: strides, sparse values, normalized integers, bounds.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "renderer/scene/gltf_document.h"

namespace cutis::gltf {

// Each takes a reference (a JSON value that is an index into `accessors`), checks that the accessor is of the
// fitting type and lies within its buffer, and fails with the reference's path otherwise. Integers become
// floats: in [0, 1] or [-1, 1] where the accessor is normalized, as they are where it is not.
std::vector<float> readScalars(Document& document, const JsonView& reference);
std::vector<glm::vec2> readVec2(Document& document, const JsonView& reference);
std::vector<glm::vec3> readVec3(Document& document, const JsonView& reference);
std::vector<glm::vec4> readVec4(Document& document, const JsonView& reference);
std::vector<glm::mat4> readMat4(Document& document, const JsonView& reference);
// RGB gets alpha 1.
std::vector<glm::vec4> readColors(Document& document, const JsonView& reference);
// Unsigned integers, not normalized.
std::vector<std::uint32_t> readIndices(Document& document, const JsonView& reference);
std::vector<glm::uvec4> readJoints(Document& document, const JsonView& reference);

// The values of an attribute of `attributes`, by one of the above; none where it has no such. Fails unless there are as
// many as positions.
template <typename T>
std::vector<T> readAttribute(Document& document, const JsonView& attributes, const char* name,
                             std::size_t count, std::vector<T> (*read)(Document&, const JsonView&)) {
    const auto reference = attributes.find(name);
    if (!reference) return {};
    std::vector<T> values = read(document, *reference);
    if (values.size() != count) {
        reference->fail("it has " + std::to_string(values.size()) + " elements for " + std::to_string(count) +
                        " positions");
    }
    return values;
}

}  // namespace cutis::gltf
