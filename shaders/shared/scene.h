// What C++ uploads and shaders read: one definition for both. Scalar layout everywhere.
// Lengths are metres relative to the scene's origin (the centre of its bounds), unless a name says mm.
#ifndef CUTIS_SHARED_SCENE_H
#define CUTIS_SHARED_SCENE_H
#include "shared/interop.h"
CUTIS_SHARED_BEGIN

const uint MATERIAL_SKIN = 1u;
const uint MATERIAL_UNLIT = 2u;
const uint MATERIAL_DOUBLE_SIDED = 4u;
const uint MATERIAL_MASK = 8u;
const uint MATERIAL_BLEND = 16u;
const uint MATERIAL_TRANSLUCENT = 32u;

// What a translucent shadow map holds in place of a place in the atlas: nothing, or what is not skin; and a surface that lets
// part of the light through, of which the map shows a pattern.
const uint ENTRY_NONE = 0xffffffffu;
const uint ENTRY_VEILED = 0xfffffffeu;

const int MAX_TEXTURE_GROUPS = 16;
const uint NO_CHART = 0xffffffffu;

// Bits of the specialization constant TEXTURE_SLOTS: which textures any material of the scene has.
const uint SLOT_BASE_COLOR = 1u;
const uint SLOT_METALLIC_ROUGHNESS = 2u;
const uint SLOT_NORMAL = 4u;
const uint SLOT_OCCLUSION = 8u;
const uint SLOT_EMISSIVE = 16u;
const uint SLOT_SPECULAR = 32u;
const uint SLOT_SPECULAR_COLOR = 64u;
const uint SLOT_COAT = 128u;
const uint SLOT_COAT_ROUGHNESS = 256u;
const uint SLOT_COAT_NORMAL = 512u;
const uint SLOT_SHEEN_COLOR = 1024u;
const uint SLOT_SHEEN_ROUGHNESS = 2048u;
const uint SLOT_TRANSMISSION = 4096u;
// Of them, the slots that hold normals.
const uint SLOTS_OF_NORMALS = SLOT_NORMAL | SLOT_COAT_NORMAL;

// Bits of the specialization constant LAYERS: what any material of the scene has.
const uint LAYER_COAT = 1u;
const uint LAYER_SHEEN = 2u;
const uint LAYER_THROUGH = 4u;
const uint LAYER_SECOND_LOBE = 8u;  // of skin

// A texture as a layer of one of the bound arrays (textures of equal size, format and sampler share an array).
struct TextureRef {
    int group;     // index into materialTextures; -1: no texture
    int layer;     // layer of that array
    int texCoord;  // 0 or 1
    vec3 u, v;     // uv' = (dot(u, (uv,1)), dot(v, (uv,1)))
};

struct Material {
    vec4 baseColor;
    vec3 emissive;  // radiance
    float metallic;
    float roughness;  // perceptual, glTF (alpha = roughness²)
    float normalScale;
    float occlusionStrength;
    float alphaCutoff;
    uint flags;  // MATERIAL_*
    // Skin (DESIGN §2.2)
    float slope;           // m, Beckmann rms slope
    float specularScale;   // s
    float mix;             // pre/post-scatter mix
    float mmPerUnit;       // millimetres in one scene unit
    float meanAlbedo;      // mean directional albedo at m, not yet multiplied by s
    uint albedoRow;        // row of the directional-albedo table: of both lobes together
    float slope2;          // m of the second, narrower lobe
    float lobeWeight;      // its share of the specular layer; 0: there is none
    uint albedoRow2;       // row of the second lobe alone
    uint matteLayer;       // index of m among the environment's prefiltered matte maps
    // What is not skin (docs/model.md)
    vec3 reflectance;    // of the dielectric at normal incidence, of colour and index of refraction
    float specular;      // scales that
    vec3 sheen;          // colour
    float sheenRoughness;
    float coat, coatRoughness, coatNormalScale;
    float transmission;
    float clear;         // share of light that passes straight through it, of base colour and transmission texture 1
    TextureRef baseColorTexture, metallicRoughnessTexture, normalTexture, occlusionTexture, emissiveTexture;
    TextureRef specularTexture, specularColorTexture, coatTexture, coatRoughnessTexture, coatNormalTexture;
    TextureRef sheenColorTexture, sheenRoughnessTexture, transmissionTexture;
};

// One primitive placed in the world.
struct DrawInfo {
    uint material;
    uint character;      // 1-based; 0: belongs to none
    uint receiverGroup;  // which of a light sample's views holds it
    uint chart;          // index of its atlas chart, or NO_CHART when it is not skin
    uint firstVertex;    // in the vertex streams
    uint firstProbe;     // not skin: probe of its first vertex (environment visibility)
};

struct VertexAttributes {
    vec3 normal;
    vec4 tangent;  // w: sign of the bitangent; 0: none
    vec2 uv0, uv1;
    vec4 color;
};

// Skin vertices only.
struct AtlasVertex {
    vec2 texel;    // place in the atlas, in texels
    vec3 metric;   // G = JᵀJ as (G00, G01, G11) in mm² per texel², J = d(position)/d(texel)
    float island;  // 1-based number of its UV island
};

// The other side of the body at a skin vertex.
struct OppositeVertex {
    vec2 texel;       // its place in the atlas
    float thickness;  // mm
    float island;     // that it lies on, 0: there is none within reach
};

struct GaussianTerm {
    vec3 weight;
    float variance;  // mm²
};

const uint LIGHT_DIRECTIONAL = 1u;
const uint LIGHT_COSINE = 2u;  // emission falls with the cosine to its direction, front only
const uint LIGHT_SHADOW = 4u;

struct LightSampleData {
    vec3 position;
    uint flags;      // LIGHT_*
    vec3 direction;  // where it shines to
    float cosInner;  // spot cone
    vec3 intensity;  // lux when directional, else candela on axis
    float cosOuter;
    float range;    // 0: none
    float radius;   // of the source it stands for: metres, or radians when directional
    uint firstView;  // its views, one a receiver group
    uint light;      // samples of one light are neighbours and share this number: its layer of lightVisibility
};

// A light map's camera.
struct LightView {
    mat4 worldToClip;
    vec3 depthToDistance;  // distance along the axis from depth d: x / (y + z·d), or z·d from the near plane when y is 0
    float texelSize;       // width of a texel in metres (orthographic), or at unit distance (perspective)
    uint layer;
};

// The camera of the picture.
struct ViewCamera {
    mat4 worldToClip;
    vec3 origin;  // eye (perspective) or centre of the near plane (orthographic)
    uint orthographic;
    vec3 right;    // from the picture's centre to its right edge, at unit depth (perspective) or in metres
    float znear;
    vec3 up;       // likewise to its top edge
    float exposure;
    vec3 forward;  // unit
    float pad;
};

// A piece of surface that a pixel sees, shaded once.
struct ShadingPoint {
    uint triangle;
    uint pixel;    // x | y << 16, within the tile
    uint offset;   // where in the pixel, two 16-bit fractions
    float weight;  // share of the pixel; negative: lies behind the point before it
};

const uint POINT_DATA = 0x80000000u;  // bit of a list entry: this point fills the pixel's data channels

// The light that a shading point sends to the eye.
struct ShadedPoint {
    vec3 diffuse;   // radiance, times its coverage; what is emitted counts as diffuse
    vec3 specular;  // likewise
    vec3 through;   // share of the light from behind that is seen
};

struct EnvironmentSettingsData {
    float cosRotation, sinRotation;
    float intensity;
    // EnvironmentSource that follow in the same buffer (shared/environment.h): what surfaces of medium roughness reflect
    // apart, then what rough ones do.
    uint mediumSources, roughSources;
};

// Directions in which the environment's visibility is known, a multiple of 32: enough that a hemisphere's irradiance is
// within 2 %.
const uint VISIBILITY_DIRECTIONS = 128u;

// A direction in which the environment's visibility is known, and the light that arrives from around it.
struct EnvironmentDirection {
    vec3 flux;      // lux arriving from the cell of this direction
    vec3 direction;  // unit, flux-weighted mean of the cell
};

CUTIS_SHARED_END
#endif
