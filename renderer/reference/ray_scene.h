// What rays meet: the whole scene for the camera and for shadows, and the skin of each character by itself
// for integrals over its surface. Coordinates are metres from the scene's centre (PlacedScene::origin).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "renderer/reference/mesh.h"

namespace cutis::reference {

struct Hit {
    const PlacedMesh* mesh = nullptr;
    std::uint32_t triangle = 0;
    double u = 0, v = 0;  // barycentric, of the second and third vertex
    double t = 0;         // along the ray, in lengths of its direction
    double alpha = 1;
};

class RayScene {
  public:
    // `placed` must outlive it. Only with `through` is findAll there.
    explicit RayScene(const PlacedScene& placed, bool through = false);
    ~RayScene();

    // What the ray shows between tNear and tFar, nearest first, into `hits`: the nearest opaque surface,
    // last, and those that are seen through before it. Backs of one-sided materials are not there.
    void findVisible(const glm::dvec3& from, const glm::dvec3& direction, double tNear, double tFar,
                     std::vector<Hit>& hits) const;

    // The share of light that gets from one end to the other of from + t·direction, 0 < t < tFar: 0 behind
    // anything opaque, and the product of lightThrough() of what is seen through. Light and eye see hair alike.
    // `direction` is of unit length.
    glm::dvec3 transmittance(const glm::dvec3& from, const glm::dvec3& direction, double tFar) const;

    // Every point where the segment from + t·direction, 0 ≤ t ≤ tFar, meets the skin of a character, into
    // `hits`, in no stated order.
    void findSkin(int character, const glm::dvec3& from, const glm::dvec3& direction, double tFar,
                  std::vector<Hit>& hits) const;

    // Everything on the segment, likewise, of the whole scene.
    void findAll(const glm::dvec3& from, const glm::dvec3& direction, double tFar,
                 std::vector<Hit>& hits) const;

    // How far above a surface at p rays start so that they never meet it: a bound on what float32 loses
    // there.
    double clearance(const glm::dvec3& p) const;

  private:
    struct Scenes;
    std::unique_ptr<Scenes> scenes_;
    double radius_;
};

}  // namespace cutis::reference
