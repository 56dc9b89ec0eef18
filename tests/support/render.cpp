#include "tests/support/render.h"

#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "renderer/scene/gltf_writer.h"
#include "tests/support/process.h"

namespace cutis::test {

namespace {

using Json = nlohmann::json;

Json toJson(const glm::dvec3& v) {
    return Json::array({v.x, v.y, v.z});
}

// As a rig file has it (DESIGN §2.3). Typed here rather than saved by the program's own code, so that a slip
// in that code cannot hide itself.
Json toJson(const Light& light) {
    Json json = {{"name", light.name}, {"intensity", light.intensity}};
    if (light.type != LightType::directional) json["position"] = toJson(light.position);
    if (light.type != LightType::point) json["direction"] = toJson(light.direction);
    switch (light.type) {
        case LightType::directional:
            json["type"] = "directional";
            break;
        case LightType::point:
            json["type"] = "point";
            break;
        case LightType::spot:
            json["type"] = "spot";
            json["inner_cone_angle"] = light.innerConeAngle;
            json["outer_cone_angle"] = light.outerConeAngle;
            break;
        case LightType::rect:
            json["type"] = "rect";
            json["size"] = Json::array({light.size.x, light.size.y});
            json["samples"] = light.samples;
    }
    return json;
}

Stats readStats(const std::filesystem::path& path) {
    const Json json = Json::parse(std::ifstream(path));
    Stats stats;
    for (const Json& pass : json.at("passes")) {
        stats.runs[pass.at("name")] += pass.at("runs").get<int>();
        pass.at("gpu_ms").get<double>();
        pass.at("reason").get<std::string>();
    }
    for (const Json& row : json.at("left_out")) stats.leftOut[row.at("name")] = row.at("reason");
    const Json& atlas = json.at("atlas");
    atlas.at("width").get_to(stats.atlasWidth);
    atlas.at("height").get_to(stats.atlasHeight);
    atlas.at("texels_covered").get_to(stats.texelsCovered);
    atlas.at("texels_lit").get_to(stats.texelsLit);
    atlas.at("mm_per_texel").get_to(stats.mmPerTexel);
    json.at("device").get_to(stats.device);
    json.at("lights").get_to(stats.lights);
    json.at("light_samples").get_to(stats.lightSamples);
    json.at("characters").get_to(stats.characters);
    json.at("gaussians").get_to(stats.gaussians);
    json.at("bytes_gpu").get_to(stats.bytesGpu);
    json.at("nonfinite").get_to(stats.nonfinite);
    json.at("load_ms").get_to(stats.loadMs);
    json.at("frame_ms").get_to(stats.frameMs);
    return stats;
}

Light makeLight(LightType type, const std::string& name, double intensity) {
    Light light;
    light.type = type, light.name = name, light.intensity = intensity;
    return light;
}

Picture readSized(const std::filesystem::path& path, int width, int height) {
    if (!std::filesystem::exists(path))
        throw std::runtime_error("cutis render wrote no " + path.filename().string());
    Picture picture = readPicture(path);
    if (picture.width != width || picture.height != height)
        throw std::runtime_error(path.filename().string() + " has the wrong size");
    return picture;
}

std::string joined(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ",") + name;
    return list;
}

// Runs the program on files in `folder` and reads what it wrote there.
Rendered runRender(const TemporaryFolder& folder, std::vector<std::string> arguments, int width, int height,
                   const std::vector<std::string>& aovs) {
    const std::filesystem::path out = folder / "out.exr", stats = folder / "stats.json";
    arguments.insert(arguments.end(), {"-o", out, "--stats", stats, "--size",
                                       std::to_string(width) + "x" + std::to_string(height)});
    if (!aovs.empty()) arguments.insert(arguments.end(), {"--aov", joined(aovs)});
    const ProcessResult run =
        runProcess(arguments, {{"CUTIS_VALIDATION", "1"}, {"CUTIS_CACHE_DIR", CUTIS_TEST_CACHE_DIR}}, 380);
    const std::string said = "status " + std::to_string(run.status) + (run.timedOut ? ", timed out" : "") +
                             ", stderr: " + run.err.substr(0, 4000);
    if (run.status != 0) throw std::runtime_error("cutis render failed: " + said);
    if (run.err.find("cutis: validation:") != std::string::npos)
        throw std::runtime_error("validation layers spoke: " + said);

    Rendered result;
    result.picture = readSized(out, width, height);
    if (result.picture.channels != 4) throw std::runtime_error("the picture has no alpha");
    for (const std::string& name : aovs)
        result.aovs[name] = readSized(folder / ("out." + name + ".exr"), width, height);
    result.stats = readStats(stats);
    if (result.stats.nonfinite != 0) throw std::runtime_error("the program counted nonfinite values");
    return result;
}

}  // namespace

SceneBuilder::SceneBuilder() {
    scene_.name = "test";
}

SkinMaterial SceneBuilder::plainSkin() {
    SkinMaterial skin;
    skin.specular = 0;
    return skin;
}

int SceneBuilder::addSkin(const SkinMaterial& skin, const glm::dvec3& albedo) {
    Material material;
    material.name = "skin " + std::to_string(scene_.materials.size());
    material.baseColor = glm::vec4(glm::vec3(albedo), 1);
    material.metallic = 0;
    material.skin = skin;
    return addMaterial(material);
}

int SceneBuilder::addMatte() {
    Material material;
    material.name = "matte";
    material.baseColor = {0.5f, 0.5f, 0.5f, 1};
    material.metallic = 0;
    return addMaterial(material);
}

int SceneBuilder::addMaterial(const Material& material) {
    scene_.materials.push_back(material);
    return static_cast<int>(scene_.materials.size()) - 1;
}

void SceneBuilder::addObject(const std::string& name, Primitive mesh, int material, const glm::dmat4& world) {
    mesh.material = material;
    Node node;
    node.name = name;
    node.local = node.world = world;
    node.mesh = static_cast<int>(scene_.meshes.size());
    scene_.meshes.push_back({name, {std::move(mesh)}});
    scene_.nodes.push_back(node);
}

void SceneBuilder::setOrthographicCamera(const glm::dvec3& eye, const glm::dvec3& target, double width,
                                         const glm::dvec3& up) {
    const double far = length(target - eye) * 4;
    Camera camera;
    camera.name = "camera";
    camera.orthographic = true;
    camera.xmag = camera.ymag = width / 2;  // glTF wants both; the picture's own shape decides (see render)
    camera.znear = far / 400, camera.zfar = far;
    camera.world = inverse(glm::lookAt(eye, target, up));
    scene_.cameras = {camera};
    Node node;
    node.name = camera.name;
    node.local = node.world = camera.world;
    node.camera = 0;
    scene_.nodes.push_back(node);
}

Light directionalLight(const std::string& name, const glm::dvec3& direction, double lux) {
    Light light = makeLight(LightType::directional, name, lux);
    light.direction = direction;
    return light;
}

Light pointLight(const std::string& name, const glm::dvec3& position, double candela) {
    Light light = makeLight(LightType::point, name, candela);
    light.position = position;
    return light;
}

Light spotLight(const std::string& name, const glm::dvec3& position, const glm::dvec3& direction,
                double candela, double innerAngle, double outerAngle) {
    Light light = makeLight(LightType::spot, name, candela);
    light.position = position, light.direction = direction;
    light.innerConeAngle = innerAngle, light.outerConeAngle = outerAngle;
    return light;
}

Light rectLight(const std::string& name, const glm::dvec3& position, const glm::dvec3& direction,
                double radiance, double width, double height, int samples) {
    Light light = makeLight(LightType::rect, name, radiance);
    light.position = position, light.direction = direction;
    light.size = {width, height}, light.samples = samples;
    return light;
}

Rendered render(const RenderJob& job) {
    const TemporaryFolder folder("cutis-figure");
    Scene scene = job.scene;
    for (Camera& camera : scene.cameras) camera.ymag = camera.xmag * job.height / job.width;
    writeGlb(scene, folder / "scene.glb");

    Json rig = {{"cutis_rig", 1}, {"name", "test"}, {"lights", Json::array()}};
    for (const Light& light : job.lights) rig["lights"].push_back(toJson(light));
    if (job.environment) {
        writeExr(folder / "environment.exr", *job.environment);
        rig["environment"] = {{"file", "environment.exr"}, {"rotation", job.environmentRotation}};
    }
    std::ofstream(folder / "test.rig.json") << rig.dump(2);

    std::vector<std::string> arguments = {CUTIS_PROGRAM, "render", folder / "scene.glb", "--rig",
                                          folder / "test.rig.json"};
    if (!job.environment) arguments.insert(arguments.end(), {"--env", "none"});
    if (!job.prune) arguments.push_back("--no-prune");
    if (!job.merge.empty()) arguments.insert(arguments.end(), {"--merge", job.merge});
    if (!job.chain.empty()) arguments.insert(arguments.end(), {"--chain", job.chain});
    if (job.taps > 0) arguments.insert(arguments.end(), {"--taps", std::to_string(job.taps)});
    if (job.irradianceSize > 0)
        arguments.insert(arguments.end(), {"--irradiance-size", std::to_string(job.irradianceSize)});
    return runRender(folder, std::move(arguments), job.width, job.height, job.aovs);
}

Rendered renderFile(const std::filesystem::path& scene, const std::vector<std::string>& options, int width,
                    int height, const std::vector<std::string>& aovs) {
    const TemporaryFolder folder("cutis-figure");
    std::vector<std::string> arguments = {CUTIS_PROGRAM, "render", scene};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return runRender(folder, std::move(arguments), width, height, aovs);
}

}  // namespace cutis::test
