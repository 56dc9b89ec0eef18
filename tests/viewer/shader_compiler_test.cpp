// Shaders compiled at run time.
#include "app/viewer/shader_compiler.h"

#include <gtest/gtest.h>

#include <thread>

#include "app/viewer/shader_reload.h"
#include "tests/cli/program.h"

namespace cutis::test {
namespace {

constexpr const char* kShader =
    "#version 460\n#extension GL_GOOGLE_include_directive : require\n#include \"lib/value.glsl\"\n"
    "layout(local_size_x = 8) in;\nlayout(binding = 0) buffer B { float b[]; };\n"
    "void main() { b[gl_GlobalInvocationID.x] = value(); }\n";

TEST(ShaderCompiler, CompilesWithFeaturesAndIncludes) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "lib");
    writeText(folder / "lib/value.glsl",
              "#ifdef ONE\nfloat value() { return 1.0; }\n#else\nfloat value() { return 2.0; }\n#endif\n");
    writeText(folder / "fill.comp", kShader);
    const std::string names[] = {"fill.comp", "fill.comp+ONE"};
    const app::CompiledShaders compiled = app::compileShaders(folder.path(), names);
    EXPECT_EQ(compiled.error, "");
    ASSERT_EQ(compiled.modules.size(), 2u);
    EXPECT_EQ(compiled.modules.at("fill.comp").at(0), 0x07230203u) << "SPIR-V's magic number";
    EXPECT_NE(compiled.modules.at("fill.comp"), compiled.modules.at("fill.comp+ONE"));
}

TEST(ShaderCompiler, SaysWhatIsWrongWhere) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "lib");
    writeText(folder / "lib/value.glsl", "float value() {\n    return nothing;\n}\n");
    writeText(folder / "fill.comp", kShader);
    const std::string names[] = {"fill.comp"};
    const app::CompiledShaders compiled = app::compileShaders(folder.path(), names);
    EXPECT_EQ(compiled.error.rfind("value.glsl:2:", 0), 0u) << compiled.error;
    EXPECT_NE(compiled.error.find("nothing"), std::string::npos) << compiled.error;
    EXPECT_TRUE(compiled.modules.empty());
}

// The build's own sources give modules for every name that it has embedded.
TEST(ShaderCompiler, KnowsTheShadersOfTheProgram) {
    const std::vector<std::string> all = gpu::embeddedShaderNames();
    std::vector<std::string> plain;
    for (const std::string& name : all)
        if (name.find('+') == name.npos) plain.push_back(name);
    ASSERT_GT(plain.size(), 20u);
    const app::CompiledShaders compiled = app::compileShaders(CUTIS_SHADER_FOLDER, plain);
    EXPECT_EQ(compiled.error, "");
    EXPECT_EQ(compiled.modules.size(), plain.size());
}

// A program that is older than its shaders lays out what both read in another way: that is said, not shown.
TEST(ShaderCompiler, KnowsAProgramThatIsOlderThanItsShaders) {
    EXPECT_EQ(app::changedSharedHeader(CUTIS_SHADER_FOLDER), "");
    const TemporaryFolder folder;
    std::filesystem::copy(CUTIS_SHADER_FOLDER, folder / "shaders", std::filesystem::copy_options::recursive);
    EXPECT_EQ(app::changedSharedHeader(folder / "shaders"), "");
    const std::string header = folder / "shaders/shared/scene.h";
    writeText(header, readText(header) + "struct More {};\n");
    EXPECT_EQ(app::changedSharedHeader(folder / "shaders"), "shared/scene.h");

    app::ShaderReload reload(folder / "shaders", [] {});
    reload.update(true);
    std::optional<app::ShaderReload::News> news;
    for (int i = 0; i < 10000 && !news; ++i) {
        news = reload.take();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ASSERT_TRUE(news);
    EXPECT_FALSE(news->replaced);
    EXPECT_NE(news->text.find("shared/scene.h"), std::string::npos) << news->text;
    EXPECT_NE(news->text.find("build cutis again"), std::string::npos) << news->text;
}

TEST(ShaderCompiler, ReplacedModulesAreFoundUntilTheyGo) {
    const std::vector<std::uint32_t> own{1, 2, 3};
    const std::size_t built = gpu::findShader("clear.comp").size();
    ASSERT_GT(built, 3u);
    gpu::replaceShaders({{"clear.comp", own}});
    EXPECT_EQ(gpu::findShader("clear.comp").size(), 3u);
    gpu::replaceShaders({});
    EXPECT_EQ(gpu::findShader("clear.comp").size(), built);
}

TEST(ShaderCompiler, FilesTellWhenTheyWereWritten) {
    const TemporaryFolder folder;
    writeText(folder / "a.comp", "1");
    const app::FileTimes before = app::shaderFiles(folder.path());
    EXPECT_EQ(before.size(), 1u);
    writeText(folder / "b.glsl", "2");
    EXPECT_NE(app::shaderFiles(folder.path()), before);
    EXPECT_TRUE(app::shaderFiles(folder / "absent").empty());
}

}  // namespace
}  // namespace cutis::test
