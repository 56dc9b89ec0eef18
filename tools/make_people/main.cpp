// make_people RECIPE MAKEHUMAN_PACKAGE HUMAN_RIG_BLEND OUT_FOLDER: makes the default scene.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>

#include "person.h"
#include "renderer/core/error.h"

namespace {

namespace fs = std::filesystem;
using namespace cutis::people;

// A camera node at `position` that looks at `target`.
int addCamera(GltfFile& file, const std::string& name, double yfov, const glm::dvec3& position,
              const glm::dvec3& target) {
    const glm::dvec3 back = glm::normalize(position - target);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back));
    const glm::dquat q = glm::quat_cast(glm::dmat3(right, glm::cross(back, right), back));
    return file.addNode({{"name", name},
                         {"camera", file.addCamera(name, yfov)},
                         {"translation", {position.x, position.y, position.z}},
                         {"rotation", {q.x, q.y, q.z, q.w}}});
}

void makeScene(const fs::path& recipePath, const fs::path& makeHuman, const fs::path& morseRig,
               const fs::path& folder) {
    const Recipe recipe = readRecipe(recipePath);
    const Sources sources = readSources(makeHuman, morseRig);
    fs::create_directories(folder);

    // The group camera: 16:9, level with the faces, far enough to keep perspective kind to them.
    constexpr double kGroupFov = 0.27, kFaceFov = 0.35, kFaceDistance = 1.0;
    glm::dvec3 middle(0);
    for (const PersonRecipe& person : recipe.people) middle += person.eyes / double(recipe.people.size());
    const glm::dvec3 groupTarget = middle - glm::dvec3(0, 0.022, 0);
    const glm::dvec3 groupCamera = groupTarget + glm::dvec3(0, 0.04, 1.62);

    GltfFile file;
    file.setCopyright("Made from MakeHuman data (CC0); see scenes/LICENSES.md of cutis");
    std::vector<int> roots;
    for (const PersonRecipe& person : recipe.people) {
        roots.push_back(addPerson(file, folder, sources, person, recipe, groupCamera));
        std::printf("make_people: %s\n", person.name.c_str());
        std::fflush(stdout);
    }
    roots.push_back(addCamera(file, "group", kGroupFov, groupCamera, groupTarget));
    for (const PersonRecipe& person : recipe.people) {
        const double angle = (person.turn + person.headTurn) * 3.14159265358979323846 / 180;
        const glm::dvec3 facing(std::sin(angle), 0, std::cos(angle));
        const glm::dvec3 face = person.eyes + glm::dvec3(0, -0.02, 0);
        roots.push_back(
            addCamera(file, "face-" + person.name, kFaceFov, face + kFaceDistance * facing, face));
    }
    file.setRoots(roots, "People");
    file.write(folder / "default.gltf");
    if (!recipe.rig.empty())
        fs::copy_file(recipePath.parent_path() / recipe.rig, folder / "default.rig.json",
                      fs::copy_options::overwrite_existing);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 5) {
        std::fprintf(stderr, "usage: make_people RECIPE MAKEHUMAN_PACKAGE HUMAN_RIG_BLEND OUT_FOLDER\n");
        return 2;
    }
    try {
        makeScene(argv[1], argv[2], argv[3], argv[4]);
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "make_people: error: %s\n", e.what());
        return 1;
    }
}
