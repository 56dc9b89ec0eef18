// Lets one header declare a struct for both C++ and GLSL. Include it first in every file under shaders/shared/, put
// declarations between CUTIS_SHARED_BEGIN and CUTIS_SHARED_END, and give every field its unit:
//
//     CUTIS_SHARED_BEGIN
//     struct LightSample {
//         vec3 position;  // metres, world
//         float radius;   // metres
//         mat4 toLight;   // world to clip
//     };
//     const uint kMaxTextures = 16;
//     CUTIS_SHARED_FUNCTION uint half(uint n) { return n / 2u; }
//     CUTIS_SHARED_END
//
// GLSL blocks that hold such structs use `layout(scalar)`: then both sides have the same offsets, without padding
// (vec3 is 12 bytes, every scalar is 4 bytes, so a struct is as long as the sum of its fields). Use no bool.
#ifndef CUTIS_SHADERS_SHARED_INTEROP_H
#define CUTIS_SHADERS_SHARED_INTEROP_H

#ifdef __cplusplus

#include <cstdint>
#include <glm/glm.hpp>

namespace cutis::shared {
using uint = std::uint32_t;
using vec2 = glm::vec2;
using vec3 = glm::vec3;
using vec4 = glm::vec4;
using ivec2 = glm::ivec2;
using ivec3 = glm::ivec3;
using ivec4 = glm::ivec4;
using uvec2 = glm::uvec2;
using uvec3 = glm::uvec3;
using uvec4 = glm::uvec4;
using mat2 = glm::mat2;
using mat3 = glm::mat3;
using mat4 = glm::mat4;
using mat4x3 = glm::mat4x3;  // 4 columns of vec3
static_assert(sizeof(vec3) == 12 && sizeof(mat3) == 36 && sizeof(mat4) == 64, "glm must pack as layout(scalar)");
}  // namespace cutis::shared

#define CUTIS_SHARED_BEGIN namespace cutis::shared {
#define CUTIS_SHARED_END }
#define CUTIS_SHARED_FUNCTION inline

#else

#extension GL_EXT_scalar_block_layout : require

#define CUTIS_SHARED_BEGIN
#define CUTIS_SHARED_END
#define CUTIS_SHARED_FUNCTION

#endif

#endif
