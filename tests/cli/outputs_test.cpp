// Results survive what happens to a machine: a full disk, a read-only folder, a kill at any moment, an
// interrupt, other processes at the same caches, damaged cache entries.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <future>
#include <map>

#include "renderer/scene/gltf_writer.h"
#include "renderer/scene/picture.h"
#include "renderer/scene/rig.h"
#include "tests/cli/program.h"
#include "tests/support/pictures.h"

namespace cutis::test {
namespace {

namespace fs = std::filesystem;

class Outputs : public testing::Test {
  protected:
    Outputs() {
        writeGlb(twoHeads(), scene_);
        writeExr(sky_, makeEnvironment(16, 8, [](const glm::dvec3& w) { return glm::dvec3(1 + w.y); }));
    }

    std::vector<std::string> renderTo(const std::string& out) const {
        return {"render", scene_, "--size", "32x18", "--device", "cpu", "-o", out};
    }
    // Through a shell that first does `before` and then becomes the program.
    static ProcessResult runAfter(const std::string& before, const std::vector<std::string>& arguments) {
        std::vector<std::string> all = {"/bin/sh", "-c", before + "; exec \"$0\" \"$@\"", CUTIS_PROGRAM};
        all.insert(all.end(), arguments.begin(), arguments.end());
        return runProcess(all, {{"CUTIS_CACHE_DIR", CUTIS_TEST_CACHE_DIR}});
    }

    // Files themselves differ by their date.
    static bool same(const std::string& a, const std::string& b) {
        return readPicture(a).values == readPicture(b).values;
    }

    TemporaryFolder folder_;
    std::string scene_ = folder_ / "heads.glb", sky_ = folder_ / "sky.exr";
};

// Writes that fail half-way. A limit on a file's size fails them as a full disk does (EFBIG, not ENOSPC), for
// whoever runs the tests; the signal that comes with it is ignored. The limit is 512 or 1024 bytes, as the
// shell has it: messages pass.
TEST_F(Outputs, AFullDiskLeavesTheOldFileWhole) {
    Rig many;
    for (int i = 0; i < 64; ++i) many.lights.emplace_back().name = "light " + std::to_string(i);
    const std::string source = folder_ / "many.rig.json";
    saveRig(many, source);
    const std::string rig = folder_ / "a.rig.json";
    writeText(rig, "old");
    const std::vector<std::string> before = filesIn(folder_.path());
    expectFailure(runAfter("trap '' XFSZ; ulimit -f 1", {"rig", "export", source, "-o", rig}), 1,
                  {"cannot write file", "a.rig.json"});
    EXPECT_EQ(readText(rig), "old");
    EXPECT_EQ(filesIn(folder_.path()), before);
}

TEST_F(Outputs, AReadOnlyFolderIsRefusedBeforeTheWork) {
    const fs::path locked = folder_ / "locked";
    fs::create_directory(locked);
    writeText(locked / "a.exr", "old");
    // Nobody may write below /proc, root included.
    expectFailure(runCutis(renderTo("/proc/a.exr")), 1, {"cannot write file", "/proc"});
    fs::permissions(locked, fs::perms::owner_read | fs::perms::owner_exec);
    if (geteuid() != 0) {  // whom no permission stops
        expectFailure(runCutis(renderTo(locked / "a.exr")), 1, {"the folder is not writable", "locked"});
    }
    EXPECT_EQ(readText(locked / "a.exr"), "old");
    fs::permissions(locked, fs::perms::owner_all);
}

TEST_F(Outputs, NoDeviceIsReplacedAndNoLink) {
    const std::string pipe = folder_ / "pipe.exr";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    expectFailure(runCutis(renderTo(pipe)), 1, {"cannot write file", "not a regular file", "pipe.exr"});
    EXPECT_TRUE(fs::is_fifo(pipe));
    const fs::path link = folder_ / "link.rig.json", target = folder_ / "target.rig.json";
    writeText(target, "old");
    fs::create_symlink("target.rig.json", link);
    expectSuccess(runCutis({"rig", "export", "rembrandt", "-o", link}));
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_NE(readText(target), "old");
}

TEST_F(Outputs, AKillAtAnyMomentLeavesAWholeFile) {
    const std::string out = folder_ / "a.exr", other = folder_ / "b.exr";
    const ProcessResult whole = runCutis(renderTo(other));
    expectSuccess(whole);
    int old = 0;
    constexpr int kMoments = 5;
    for (int moment = 1; moment <= kMoments; ++moment) {
        writeText(out, "old");
        std::vector<std::string> arguments = {CUTIS_PROGRAM};
        const std::vector<std::string> render = renderTo(out);
        arguments.insert(arguments.end(), render.begin(), render.end());
        // The last moments are those of writing.
        runProcess(arguments, {{"CUTIS_CACHE_DIR", CUTIS_TEST_CACHE_DIR}}, whole.seconds * moment / kMoments);
        const bool isOld = readText(out) == "old";
        EXPECT_TRUE(isOld || same(out, other))
            << "a part of a file, killed after " << moment << "/" << kMoments;
        old += isOld;
    }
    EXPECT_GT(old, 0) << "no kill came early enough";
    // What a killed process has left behind disturbs nobody.
    expectSuccess(runCutis(renderTo(out)));
    EXPECT_TRUE(same(out, other));
}

TEST_F(Outputs, AnInterruptedReferenceEndsWith130AndNoDebris) {
    const ProcessResult run =
        runProcess({"/usr/bin/timeout", "--preserve-status", "-s", "INT", "1", CUTIS_PROGRAM, "reference",
                    scene_, "--size", "640x360", "--error", "0.01%", "-o", folder_ / "a.exr"},
                   {{"CUTIS_CACHE_DIR", CUTIS_TEST_CACHE_DIR}}, 60);
    EXPECT_EQ(run.status, 130) << run.err;
    EXPECT_EQ(filesIn(folder_.path()), (std::vector<std::string>{"heads.glb", "sky.exr"}));
}

// Everything that fills the cache: a rig in an environment, with its reference.
class Caches : public Outputs {
  protected:
    ProcessResult render(const std::string& out) const {
        std::vector<std::string> arguments = renderTo(out);
        arguments.insert(arguments.end(), {"--env", sky_, "--aov", "specular"});
        return runCutis(arguments, {{"CUTIS_CACHE_DIR", cache_}});
    }
    ProcessResult measure(const std::string& out) const {
        return runCutis({"measure", scene_, "--size", "16x9", "--device", "cpu", "--env", sky_, "--sweep",
                         sweep_, "--budget", "1s", "--repeats", "1", "-o", out},
                        {{"CUTIS_CACHE_DIR", cache_}});
    }
    std::vector<fs::path> entries() const {
        std::vector<fs::path> found;
        for (const auto& entry : fs::directory_iterator(cache_))
            if (entry.path().extension() == ".bin") found.push_back(entry.path());
        return found;
    }

    std::string cache_ = folder_ / "cache", sweep_ = folder_ / "sweep.json";
};

TEST_F(Caches, AreSharedByProcessesThatStartTogether) {
    std::vector<std::future<ProcessResult>> runs;
    for (int i = 0; i < 4; ++i)
        runs.push_back(std::async(std::launch::async,
                                  [this, i] { return render(folder_ / (std::to_string(i) + ".exr")); }));
    for (auto& run : runs) expectSuccess(run.get());
    for (int i = 1; i < 4; ++i)
        EXPECT_TRUE(same(folder_ / (std::to_string(i) + ".exr"), folder_ / "0.exr")) << i;
    expectSuccess(render(folder_ / "later.exr"));
    EXPECT_TRUE(same(folder_ / "later.exr", folder_ / "0.exr"));
}

TEST_F(Caches, DamagedEntriesOfEachKindAreRebuilt) {
    writeText(sweep_, R"({"cutis_sweep":1,"settings":[{"name":"two","gaussians":2,"irradiance_size":64}]})");
    expectSuccess(render(folder_ / "a.exr"));
    ASSERT_EQ(measure(folder_ / "m").status, 0);
    std::map<std::string, std::string> kinds;  // and what their entries hold
    for (const fs::path& entry : entries()) {
        const std::string name = entry.filename();
        kinds[name.substr(0, name.rfind('-'))] += name + " ";
    }
    for (const char* kind :
         {"environment", "environment-sources", "specular-lobes", "reference", "measurement"})
        EXPECT_TRUE(kinds.count(kind)) << "no entry of " << kind;
    const auto damage = [](const std::string& whole, int how) -> std::string {
        if (how == 0) return "";
        if (how == 1) return whole.substr(0, whole.size() / 2);
        std::string flipped = whole;
        flipped[whole.size() * 3 / 4] ^= 1;
        return flipped;
    };
    for (int how = 0; how < 3; ++how) {
        std::map<fs::path, std::string> damaged;
        for (const fs::path& entry : entries())
            writeText(entry, damaged[entry] = damage(readText(entry), how));
        expectSuccess(render(folder_ / "b.exr"));
        EXPECT_TRUE(same(folder_ / "b.exr", folder_ / "a.exr")) << "damage " << how;
        const ProcessResult measured = measure(folder_ / "m");
        EXPECT_EQ(measured.status, 0) << measured.err;
        for (const auto& [entry, bytes] : damaged)
            EXPECT_TRUE(readText(entry) != bytes) << entry << " is as damaged, " << how;
    }
}

}  // namespace
}  // namespace cutis::test
