// What the viewer edits, as plain data: no window, no Vulkan.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/viewer/orbit_camera.h"
#include "renderer/frame/background.h"
#include "renderer/frame/renderer.h"
#include "renderer/measure/front.h"
#include "renderer/scene/scene.h"

namespace cutis {

// Found by the comparison of documents.
inline bool operator==(const SkinMaterial& a, const SkinMaterial& b) {
    return a.profile == b.profile && a.scale == b.scale && a.mix == b.mix && a.roughness == b.roughness &&
           a.specular == b.specular && a.lobeWeight == b.lobeWeight && a.lobeRatio == b.lobeRatio &&
           a.detail == b.detail && a.detailScale == b.detailScale && a.translucency == b.translucency &&
           a.mmPerUnit == b.mmPerUnit;
}

}  // namespace cutis

namespace cutis::app {

// The view: a camera of the scene as it stands in the file, or one that was moved by hand.
struct View {
    std::string camera;  // as cameraFor takes it; empty: `orbit`
    OrbitCamera orbit;
    bool operator==(const View&) const = default;
};

// How exactly pictures are computed.
struct Quality {
    double tolerance = 0;    // of the diffuse light; above 0 it chooses the rest, as --tolerance does
    int irradianceSize = 0;  // as RenderSettings has them
    int gaussians = 0;
    Merge merge = Merge::min;
    Chain chain = Chain::exact;
    int taps = RenderSettings{}.taps;
    bool operator==(const Quality&) const = default;
};

struct Document {
    std::string scene;              // file, or "default"; empty before the first is loaded
    std::filesystem::path rigFile;  // where the rig is saved; empty: nowhere yet
    Rig rig;                        // its environment's file is absolute; placements are not resolved
    std::vector<bool> solo;         // per light: while any is set, only those shine. Not part of a rig file
    std::vector<std::optional<SkinMaterial>> skin;  // per material of the scene; unset: not skin
    View view;
    Background background = Background::none;
    Quality quality;
    bool operator==(const Document&) const = default;
};

// The rig that lights the picture: muted lights off, and while some are solo, all others off, solo ones on.
Rig effectiveRig(const Document& document);

// Puts the quality into the settings of a picture and, where a tolerance chooses them, into the samples of
// its rig. Where nothing in `front` is close enough it takes what is closest.
void applyQuality(const Quality& quality, const MeasuredFront& front, Rig& rig, RenderSettings& settings);
// What was measured of that quality; nullptr when nothing was.
const MeasuredSetting* measuredOf(const Quality& quality, const MeasuredFront& front);

// Takes the sun out of the environment: it shines without, and a light named like it, which is returned,
// gives what it gave.
int takeSunOut(Document& document, const Light& sun);

// Of a material's profile. A Gaussian more, wider than the others, without weight; none less than one.
void addGaussian(skin::Profile& profile);
void removeGaussian(skin::Profile& profile, std::size_t index);
// A material's profile, its weights held to what a profile may be: no channel gives back more than it gets.
void setProfile(Document& document, std::size_t material, const skin::Profile& profile);
// Sorts by variance and scales the weights of each channel so that they sum to 1: the skin takes no light
// away.
skin::Profile normalized(const skin::Profile& profile);

// Adds a light and returns its index. A placed spot of a useful brightness, in front of everyone.
int addLight(Document& document, LightType type);
// Right behind the original, under a name of its own. Returns its index.
int duplicateLight(Document& document, int light);
void deleteLight(Document& document, int light);
// Moves the light to index `to`, others close up.
void moveLight(Document& document, int light, int to);
// Replaces all lights, exposure and environment; nothing is solo.
void replaceRig(Document& document, Rig rig, const std::filesystem::path& file);

// `name`, or `name 2`, `name 3`, … when a light has it already.
std::string uniqueLightName(const Rig& rig, const std::string& name);

// Changes the type and gives the light what that type needs, with about the same brightness `distance` metres
// away.
void changeType(Light& light, LightType type, double distance);

// By so many stops, but not beyond what the field of intensity covers.
void brighten(Light& light, double stops);

// Turns the light round `pivot` (world): by the angles of its place, or its position and direction together
// when it stands free. Degrees.
void turnLight(Light& light, double azimuth, double elevation, const glm::dvec3& pivot);
// A free light as one placed round its subject, where it is; it then aims at the subject's centre.
void placeLight(Light& light, const glm::dvec3& pivot);

// The light stands free at `position` and shines at `point` (world), which must not be there too.
void aimAt(Light& light, const glm::dvec3& position, const glm::dvec3& point);

// The rig as it goes into `file`: an environment that lies below or beside the file's folder gets a relative
// name.
Rig rigForFile(Rig rig, const std::filesystem::path& file);

// Gives the scene's materials these skins. Characters are found anew when what is skin changed.
void applySkin(Scene& scene, const std::vector<std::optional<SkinMaterial>>& skin);
std::vector<std::optional<SkinMaterial>> skinOf(const Scene& scene);

}  // namespace cutis::app
