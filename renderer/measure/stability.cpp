#include "renderer/measure/stability.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <glm/gtc/matrix_transform.hpp>
#include <iterator>

#include "renderer/measure/variants.h"
#include "renderer/scene/characters.h"
#include "renderer/scene/pose.h"

namespace cutis {
namespace {

using Change = std::function<void(MeasuredSubject&)>;

Change everySkin(const std::function<void(SkinMaterial&)>& change) {
    return [change](MeasuredSubject& subject) {
        for (Material& material : subject.scene.materials)
            if (material.skin) change(*material.skin);
    };
}

// One colour all over, vertices and textures included.
Change everyAlbedo(const glm::vec3& albedo, double mix) {
    return [=](MeasuredSubject& subject) {
        for (Material& material : subject.scene.materials) {
            if (!material.skin) continue;
            material.baseColor = glm::vec4(albedo, material.baseColor.a);
            material.baseColorTexture = {};
            material.skin->mix = mix;
        }
        for (Mesh& mesh : subject.scene.meshes) {
            for (Primitive& primitive : mesh.primitives) {
                if (!subject.scene.materials[primitive.material].skin) continue;
                for (glm::vec4& color : primitive.colors) color = glm::vec4(glm::vec3(1), color.a);
            }
        }
    };
}

// Gaussians of equal weight; variances in mm².
Change everyProfile(const std::vector<double>& variances) {
    return everySkin([=](SkinMaterial& skin) {
        skin.profile.gaussians.clear();
        for (const double variance : variances)
            skin.profile.gaussians.push_back(
                {variance, glm::dvec3(1.0 / static_cast<double>(variances.size()))});
    });
}

void scaleLight(MeasuredSubject& subject, double factor) {
    for (Light& light : subject.rig.lights) light.intensity *= factor;
    subject.rig.environment.intensity *= factor;
}

// The world `scale` times as large and then moved: skin, lights and camera with it, so that the picture
// stays.
void placeWorld(MeasuredSubject& subject, double scale, const glm::dvec3& offset) {
    const glm::dmat4 place = glm::scale(glm::translate(glm::dmat4(1), offset), glm::dvec3(scale));
    for (Node& node : subject.scene.nodes) {
        if (node.parent >= 0) continue;
        node.local = place * node.local;
        if (node.rest) node.rest = toTransform(place * toMatrix(*node.rest));
    }
    for (Material& material : subject.scene.materials)
        if (material.skin) material.skin->mmPerUnit /= scale;
    for (Light& light : subject.rig.lights) {
        light.position = light.position * scale + offset;
        light.radius *= scale, light.range *= scale, light.size *= scale;
        light.place.reset();
        // Candela over squared distance; lux and radiance know no distance.
        if (light.type == LightType::point || light.type == LightType::spot) light.intensity *= scale * scale;
    }
    Camera& camera = subject.camera;
    camera.world[3] = glm::dvec4(glm::dvec3(camera.world[3]) * scale + offset, 1);
    camera.znear *= scale, camera.zfar *= scale, camera.xmag *= scale, camera.ymag *= scale;
    prepareScene(subject.scene);
}

// A bulb that stands so far in front of the skin that faces the camera most directly, in place of all other
// light.
void lightBefore(MeasuredSubject& subject, double millimetres) {
    const glm::dvec3 eye(subject.camera.world[3]), towards(subject.camera.world[2]);
    double nearest = std::numeric_limits<double>::infinity();
    glm::dvec3 place(0);
    for (const Character& character : subject.scene.characters) {
        for (const int index : character.nodes) {
            const Node& node = subject.scene.nodes[index];
            for (const Primitive& primitive : subject.scene.meshes[node.mesh].primitives) {
                const Material& material = subject.scene.materials[primitive.material];
                if (!material.skin) continue;
                for (const glm::vec3& position : primitive.positions) {
                    const glm::dvec3 p(node.world * glm::dvec4(position, 1));
                    const double depth = glm::dot(eye - p, towards);
                    if (depth < nearest) {
                        nearest = depth;
                        place = p + towards * (millimetres / material.skin->mmPerUnit);
                    }
                }
            }
        }
    }
    Light bulb;
    bulb.name = "bulb";
    bulb.position = place;
    subject.rig.lights = {bulb};
    subject.environment.reset();
}

void setEnvironment(MeasuredSubject& subject, int width, int height,
                    const std::function<glm::vec3(int x, int y)>& radiance) {
    Environment environment{.name = "made", .width = width, .height = height, .radiance = {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) environment.radiance.push_back(radiance(x, y));
    subject.environment = std::move(environment);
    subject.rig.environment = {.file = "made"};
    subject.rig.lights.clear();
}

void appendSkinCases(std::vector<StabilityCase>& cases) {
    for (const double roughness : {1e-3, 1e-2, 1.0})
        for (const double specular : {1.0, 4.0}) {
            char name[64];
            std::snprintf(name, sizeof name, "roughness %g, specular %g", roughness, specular);
            cases.push_back({name, everySkin([=](SkinMaterial& skin) {
                                 skin.roughness = roughness, skin.specular = specular;
                             })});
        }
    for (const double mix : {0.0, 1.0}) {
        const std::string suffix = mix > 0 ? " albedo, mix 1" : " albedo, mix 0";
        cases.push_back({"black" + suffix, everyAlbedo(glm::vec3(0), mix)});
        cases.push_back({"white" + suffix, everyAlbedo(glm::vec3(1), mix)});
        cases.push_back({"red" + suffix, everyAlbedo({1, 0, 0}, mix)});
    }
    for (const double scale : {1e-3, 1e3})
        cases.push_back({scale < 1 ? "profile 1/1000 as wide" : "profile 1000 times as wide",
                         everySkin([=](SkinMaterial& skin) { skin.scale *= scale; })});
    cases.push_back({"variances eight decades apart", everyProfile({1e-4, 1e4})});
    cases.push_back({"one gaussian", everyProfile({1})});
    cases.push_back({"16 gaussians", everyProfile({1e-4, 1e-3, 3e-3, 0.01, 0.03, 0.06, 0.1, 0.2, 0.4, 0.8,
                                                   1.6, 3.2, 5, 7, 9, 12})});
}

void appendLightCases(std::vector<StabilityCase>& cases) {
    cases.push_back({"no light", [](MeasuredSubject& subject) {
                         subject.rig.lights.clear();
                         subject.environment.reset();
                     }});
    // Copies share the rig's light, so that the sum of very many stays what it is.
    for (const int count : {64, 512})
        cases.push_back({std::to_string(count) + " lights", [count](MeasuredSubject& subject) {
                             repeatLights(subject.rig, subject.scene, count);
                             for (Light& light : subject.rig.lights) light.samples = 1;
                         }});
    for (const double factor : {1e-12, 1e12})
        cases.push_back({factor < 1 ? "light 1e-12 times as strong" : "light 1e12 times as strong",
                         [factor](MeasuredSubject& subject) { scaleLight(subject, factor); }, factor});
    cases.push_back(
        {"a bulb 1 mm before the skin", [](MeasuredSubject& subject) { lightBefore(subject, 1); }});
    cases.push_back({"a bulb in the skin", [](MeasuredSubject& subject) { lightBefore(subject, 0); }});
    cases.push_back({"a sun of 1e9 beside 1e-6", [](MeasuredSubject& subject) {
                         setEnvironment(subject, 64, 32, [](int x, int y) {
                             return glm::vec3(x == 40 && y == 6 ? 1e9f : 1e-6f);
                         });
                     }});
    cases.push_back({"an even sky of 1", [](MeasuredSubject& subject) {
                         setEnvironment(subject, 64, 32, [](int, int) { return glm::vec3(1); });
                     }});
}

void appendWorldCases(std::vector<StabilityCase>& cases) {
    for (const double scale : {1e-4, 1e4})
        cases.push_back({scale < 1 ? "world 1e-4 as large" : "world 1e4 times as large",
                         [scale](MeasuredSubject& subject) { placeWorld(subject, scale, glm::dvec3(0)); },
                         1});
    cases.push_back({"1,000 km from the origin",
                     [](MeasuredSubject& subject) {
                         placeWorld(subject, 1, {1e6, 0, 1e6});
                     },
                     1});
    for (const int size : {64, 1024})
        cases.push_back({"atlas of " + std::to_string(size),
                         [size](MeasuredSubject& subject) { subject.quality.irradianceSize = size; }, 1});
}

// The reference of the unchanged scene, for a picture that must be `factor` times as bright.
SubjectReference brighter(SubjectReference reference, double factor) {
    const auto scale = [&](Picture& picture) {
        for (std::size_t i = 0; i < picture.values.size(); ++i) {
            if (picture.channels < 4 || i % 4 != 3) picture.values[i] *= static_cast<float>(factor);
        }
    };
    scale(reference.picture), scale(reference.diffuse);
    for (int half = 0; half < 2; ++half)
        scale(reference.pictureHalves[half]), scale(reference.diffuseHalves[half]);
    return reference;
}

// Values that no light can have.
std::size_t countNegative(const RenderResult& result) {
    const auto count = [](const Picture& picture) {
        return static_cast<std::size_t>(std::count_if(picture.values.begin(), picture.values.end(),
                                                      [](float value) { return value < 0; }));
    };
    std::size_t negative = count(result.picture);
    for (const char* name : {"diffuse", "specular", "irradiance"}) negative += count(result.aovs.at(name));
    return negative;
}

}  // namespace

std::vector<StabilityCase> stabilityCases() {
    std::vector<StabilityCase> cases{{"unchanged", [](MeasuredSubject&) {}}};
    appendSkinCases(cases);
    appendLightCases(cases);
    appendWorldCases(cases);
    return cases;
}

std::vector<Measurement> measureStability(gpu::Device& device, const MeasureInput& input,
                                          const std::vector<StabilityCase>& cases,
                                          const MeasureHooks& hooks) {
    std::vector<Measurement> rows;
    SubjectReference unchanged;
    for (const StabilityCase& extreme : cases) {
        Measurement row{.setting = {.name = extreme.name}};
        RenderResult result;
        SubjectReference reference;
        try {
            MeasuredSubject subject = subjectOf(input);
            subject.quality.aovs.assign(std::begin(kAovNames), std::end(kAovNames));
            extreme.change(subject);
            reference = extreme.factor > 0 ? brighter(unchanged, extreme.factor) : hooks.reference(subject);
            if (rows.empty()) unchanged = reference;
            result = measureRow(device, input, subject, reference, row);
            if (row.nonfinite > 0) row.failure = std::to_string(row.nonfinite) + " values are not finite";
            const std::size_t negative = countNegative(result);
            if (negative > 0) row.failure = std::to_string(negative) + " values are below zero";
        } catch (const std::exception& error) {
            row = {.setting = {.name = extreme.name}, .failure = error.what()};
            result = {};
        }
        hooks.row(row, result.picture, result.aovs["diffuse"], reference);
        rows.push_back(row);
    }
    return rows;
}

}  // namespace cutis
