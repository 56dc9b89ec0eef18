#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "renderer/scene/characters.h"

namespace cutis::test {

ProcessResult runCutis(std::vector<std::string> arguments, EnvironmentVariables extra) {
    arguments.insert(arguments.begin(), CUTIS_PROGRAM);
    extra.emplace_back("CUTIS_CACHE_DIR", CUTIS_TEST_CACHE_DIR);
    return runProcess(arguments, extra, 240);
}

void expectFailure(const ProcessResult& run, int status, const std::vector<std::string>& parts) {
    EXPECT_EQ(run.status, status) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.err.find("cutis: error: "), 0u) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_TRUE(run.err.ends_with('\n')) << run.err;
    // Nothing that commands a terminal.
    EXPECT_EQ(
        std::count_if(run.err.begin(), run.err.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }),
        1)
        << run.err;
    for (const std::string& part : parts)
        EXPECT_NE(run.err.find(part), std::string::npos) << part << " not in " << run.err;
}

void expectSuccess(const ProcessResult& run) {
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.err, "");
}

std::string readText(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    EXPECT_TRUE(file) << path;
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void writeText(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

std::vector<std::string> filesIn(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
}

Scene twoHeads() {
    Scene scene;
    scene.name = "two heads";
    Material& skin = scene.materials.emplace_back();
    skin.name = "skin";
    skin.metallic = 0;
    skin.skin = SkinMaterial{};

    Primitive box;
    box.material = 0;
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        glm::vec3 normal(0), u(0), v(0);
        normal[axis] = side % 2 ? 1.f : -1.f;
        u[(axis + 1) % 3] = 1;
        v = glm::cross(normal, u);
        const auto first = static_cast<std::uint32_t>(box.positions.size());
        for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
            box.positions.push_back(0.1f * (normal + (2 * corner.x - 1) * u + (2 * corner.y - 1) * v));
            box.normals.push_back(normal);
            // Each side a chart of its own in a grid of 3 × 2.
            const glm::vec2 cell(static_cast<float>(side % 3), static_cast<float>(side / 3));
            box.uv0.push_back((cell + 0.05f + 0.9f * corner) / glm::vec2(3, 2));
        }
        for (const std::uint32_t index : {0u, 1u, 2u, 0u, 2u, 3u}) box.indices.push_back(first + index);
    }
    for (const auto& [name, x] : {std::pair("Anna", -0.2), std::pair("Ben", 0.2)}) {
        Node node;
        node.name = name;
        node.mesh = static_cast<int>(scene.meshes.size());
        node.local[3].x = x;
        scene.nodes.push_back(node);
        scene.meshes.push_back({name, {box}});
    }
    prepareScene(scene);
    return scene;
}

}  // namespace cutis::test
