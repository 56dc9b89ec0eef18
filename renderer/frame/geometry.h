// A scene flattened for the GPU: world-space vertex streams, triangles, draws, and the groups that light maps serve.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.h"
#include "shaders/shared/scene.h"

namespace cutis {

// One primitive placed in the world; index k of its vectors is index k of DrawInfo.
struct GeometryDraw {
    int node = -1, mesh = -1, primitive = -1;
    int material = -1;
    int character = -1;  // index into Scene::characters
    std::uint32_t firstIndex = 0, indexCount = 0;
    std::uint32_t firstVertex = 0, vertexCount = 0;
    std::vector<std::uint32_t> copies;  // the vertices of the primitive that its last ones repeat
    std::uint32_t firstProxyIndex = 0, proxyIndexCount = 0;  // see makeOcclusionProxies
    bool skin = false;
    bool mirrored = false;   // its transform turns triangles over, so they are stored the other way round
    Bounds bounds;           // world
    std::uint64_t pose = 0;  // a hash of its positions and normals, in a scene that can move
};

// What one view of a light sample is fitted to: a character, or all that belongs to none.
struct ReceiverGroup {
    Bounds bounds;      // world
    Bounds restBounds;  // the same of the scene at rest
};

struct Geometry {
    glm::dvec3 origin{0};  // world place of the streams' zero: the centre of the scene's bounds at rest
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> restPositions;  // of the scene at rest; empty where nothing can move
    std::vector<shared::VertexAttributes> attributes;
    std::vector<glm::vec2> layoutUv;  // a skin vertex: its place in the layout, for the atlas alone
    std::vector<std::uint32_t> layoutParts;  // a skin vertex: those of different parts are of different islands
    std::vector<std::uint32_t> indices;        // global vertex numbers; skin triangles first
    std::vector<std::uint32_t> triangleDraws;  // per triangle
    std::vector<GeometryDraw> draws;           // skin first
    std::vector<shared::DrawInfo> drawInfos;   // chart is filled by layOutAtlas
    std::vector<ReceiverGroup> receiverGroups;
    Bounds bounds;   // world, of everything
    Bounds casters;  // holds that, and grows in steps where something can move, so that light views seldom change
    std::uint32_t skinVertexCount = 0, skinTriangleCount = 0;
    std::uint32_t probeCount = 0;  // vertices that are not skin
    std::vector<double> skinMm2;   // a character: area of its skin at rest
};

// Skin is laid out for the atlas, with a warning where its texture coordinates do not serve (frame/skin_layout.h). Throws
// Error when the scene holds more than 2³² / 3 triangles or vertices.
Geometry flattenScene(const Scene& scene);

// Puts the geometry of a scene into the pose that the scene is in now: positions, normals, tangents, bounds, hashes. All
// else, and the origin, stays.
void followPose(const Scene& scene, Geometry& geometry);

// While it lives, Geometry::positions are those of the scene at rest: for what must not change with the pose.
class AtRest {
  public:
    explicit AtRest(Geometry& geometry) : geometry_(geometry) { exchange(); }
    ~AtRest() { exchange(); }
    AtRest(const AtRest&) = delete;
    AtRest& operator=(const AtRest&) = delete;

  private:
    void exchange() { if (!geometry_.restPositions.empty()) geometry_.positions.swap(geometry_.restPositions); }
    Geometry& geometry_;
};

// Vertex numbers of a coarser form of every draw, for shadows of the sky alone: they are found at a coarse resolution and
// in a hundred directions. Surfaces, as they stand, move by at most `error` metres. Fills the proxy ranges of the
// draws.
std::vector<std::uint32_t> makeOcclusionProxies(Geometry& geometry, double error);

}  // namespace cutis
