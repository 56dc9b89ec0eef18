// From a scene made in code to the pictures that `cutis render` writes of it.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/picture.h"
#include "renderer/scene/scene.h"

namespace cutis::test {

// A scene put together object by object.
class SceneBuilder {
  public:
    SceneBuilder();

    // Skin of the three-layer profile with albedo 1 and no specular, mix 0.5: what closed forms are stated
    // for.
    static SkinMaterial plainSkin();
    int addSkin(const SkinMaterial& skin, const glm::dvec3& albedo = glm::dvec3(1));
    int addMaterial(const Material& material);
    // Opaque, dielectric, grey.
    int addMatte();
    // One node of its own at the top of the tree: its skin is a character of its own.
    void addObject(const std::string& name, Primitive mesh, int material,
                   const glm::dmat4& world = glm::dmat4(1));
    // Looks from `eye` at `target`; the picture shows `width` metres across. Depths from 1/100 to 4 times the
    // distance.
    void setOrthographicCamera(const glm::dvec3& eye, const glm::dvec3& target, double width,
                               const glm::dvec3& up = glm::dvec3(0, 1, 0));
    const Scene& scene() const { return scene_; }

  private:
    Scene scene_;
};

Light directionalLight(const std::string& name, const glm::dvec3& direction, double lux);
Light pointLight(const std::string& name, const glm::dvec3& position, double candela);
Light spotLight(const std::string& name, const glm::dvec3& position, const glm::dvec3& direction,
                double candela, double innerAngle, double outerAngle);
Light rectLight(const std::string& name, const glm::dvec3& position, const glm::dvec3& direction,
                double radiance, double width, double height, int samples);

struct RenderJob {
    Scene scene = {};
    std::vector<Light> lights = {};
    std::optional<Picture> environment = {};  // lat-long, three channels
    double environmentRotation = 0;           // degrees
    int width = 128, height = 128;
    int irradianceSize = 0;  // 0: the program's choice
    std::vector<std::string> aovs = {};
    bool prune = true;
    std::string merge = {};  // as --merge takes it; empty: the default
    std::string chain = {};  // as --chain takes it; empty: the default
    int taps = 0;            // as --taps takes them; 0: the default
};

// What `--stats` says (DESIGN §2.1); reading it fails when one of its keys is missing.
struct Stats {
    std::string device;
    std::map<std::string, int> runs;             // by name of the pass
    std::map<std::string, std::string> leftOut;  // reason, by name
    int lights = 0, lightSamples = 0, characters = 0, gaussians = 0;
    int atlasWidth = 0, atlasHeight = 0;
    double texelsCovered = 0, texelsLit = 0, mmPerTexel = 0, bytesGpu = 0, nonfinite = 0, loadMs = 0, frameMs = 0;
    int runsOf(const std::string& pass) const { return runs.count(pass) ? runs.at(pass) : 0; }
};

struct Rendered {
    Picture picture;
    std::map<std::string, Picture> aovs;
    Stats stats;
    // An AOV that the job asked for.
    const Picture& aov(const std::string& name) const { return aovs.at(name); }
};

// Writes scene, rig and environment into a folder of their own and runs `cutis render` with validation layers
// on. Throws std::runtime_error, with what the program said, when its status is not 0, when a validation
// layer spoke, when a picture is missing or has the wrong size, or when it counted values that are not
// finite.
Rendered render(const RenderJob& job);

// The same for a scene file that is there already; `options` are further arguments.
Rendered renderFile(const std::filesystem::path& scene, const std::vector<std::string>& options, int width,
                    int height, const std::vector<std::string>& aovs);

}  // namespace cutis::test
