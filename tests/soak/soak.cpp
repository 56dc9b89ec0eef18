// A long session in one process: scenes are loaded, rigs are edited, every state is drawn, with validation
// layers on.
//
//     build/tests/soak/soak LOADS EDITS
//
// Loads LOADS scene files and makes EDITS edits in between. Fails (status 1) when memory grows after the
// first half, or when the validation layers have anything to say. The full run is 2000 loads and 10000 edits;
// the tests run a short one.
#include <malloc.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <random>

#include "app/viewer/edits.h"
#include "renderer/gpu/device.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/environment.h"
#include "renderer/scene/gltf.h"
#include "renderer/scene/gltf_writer.h"
#include "renderer/scene/rig.h"
#include "tests/frame/small_scene.h"
#include "tests/support/pictures.h"
#include "tests/support/process.h"
#include "tests/support/surfaces.h"

namespace cutis::test {
namespace {

using app::Document;
using app::EditList;

constexpr int kPictureSize = 16, kAtlasSize = 64, kLightMapSize = 32;  // along each side
// What the sky's visibility takes is twenty edits' time: so few of the scenes stand in one, from the first
// on.
constexpr std::size_t kLoadsASky = 20;
// Growth that is none: heaps and driver pools come to rest within this.
constexpr double kGrowthShare = 0.03, kGrowthMegabytes = 6;

// What was freed but not given back is no growth: the allocator returns it first.
double residentMegabytes() {
    ::malloc_trim(0);
    std::ifstream statm("/proc/self/statm");
    std::uint64_t total = 0, resident = 0;
    statm >> total >> resident;
    return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

// Allocated and not freed, by all threads.
double heapMegabytes() {
    const struct mallinfo2 info = ::mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd) / 1e6;
}

// Three files that differ in what they need.
std::vector<std::filesystem::path> writeScenes(const TemporaryFolder& folder) {
    const SmallScene whole;
    writeGlb(whole.scene, folder / "whole.glb");
    SceneBuilder sphere;
    sphere.addObject("body", makeSphere(0.1, SphereMapping::cube, glm::dmat3(1), 0.25),
                     sphere.addSkin(SkinMaterial()));
    writeGlb(sphere.scene(), folder / "sphere.glb");
    SceneBuilder pair;
    const int skin = pair.addSkin(SceneBuilder::plainSkin(), {0.7, 0.5, 0.4});
    pair.addObject("left", makePlate(0.2), skin);
    pair.addObject("right", makeBox({0.15, -0.1, -0.1}, {0.3, 0.1, 0}), pair.addMatte());
    writeGlb(pair.scene(), folder / "pair.glb");
    return {folder / "whole.glb", folder / "sphere.glb", folder / "pair.glb"};
}

// One edit of those that the viewer's panels make, undo, redo and saving among them.
void editOnce(EditList& edits, std::mt19937& random, const std::filesystem::path& rigFile) {
    const auto share = [&] { return std::uniform_real_distribution<double>(0, 1)(random); };
    const auto anyLight = [&](const Document& document) {
        return static_cast<int>(random() % document.rig.lights.size());
    };
    const int lights = static_cast<int>(edits.document().rig.lights.size());
    const int kind = static_cast<int>(random() % 10);
    if (lights == 0 || (kind == 0 && lights < 6)) {
        const auto type = static_cast<LightType>(random() % 4);
        edits.apply("Add", [&](Document& d) { app::addLight(d, type); });
    } else if (kind == 0 || kind == 1) {
        edits.apply("Delete", [&](Document& d) { app::deleteLight(d, anyLight(d)); });
    } else if (kind == 2) {
        edits.undo();
    } else if (kind == 3) {
        edits.redo();
    } else if (kind == 4) {
        saveRig(app::rigForFile(edits.document().rig, rigFile), rigFile);
        const Rig read = loadRig(rigFile);
        edits.apply("Load", [&](Document& d) { app::replaceRig(d, read, rigFile); });
    } else {
        edits.apply("Change", [&](Document& d) {
            Light& light = d.rig.lights[anyLight(d)];
            if (kind == 5) light.intensity *= 0.5 + share();
            if (kind == 6) light.color = {share(), share(), share()};
            if (kind == 7) app::turnLight(light, 30 * share(), 10 * share() - 5, glm::dvec3(0));
            if (kind == 8) light.enabled = !light.enabled;
            if (kind == 9) d.rig.environment.rotation = 360 * share();
        });
    }
    edits.endGesture();
}

class Session {
  public:
    Session() : scenes_(writeScenes(folder_)), sky_(skyOf(0.3, 4)) {
        Document document;
        Rig rig;
        rig.lights = {pointLight("key", {0.4, 0.3, 0.5}, 0.6)};
        app::replaceRig(document, rig, {});
        edits_.reset(document);
    }

    void load() {
        scene_ = loadGltf(scenes_[loads_++ % scenes_.size()]);
        ++revision_;
        draw();
    }
    void edit() {
        editOnce(edits_, random_, folder_ / "session.rig.json");
        draw();
    }
    std::uint64_t deviceBytes() const { return device_.bytesAllocated(); }

  private:
    void draw() {
        Rig rig = app::effectiveRig(edits_.document());
        resolvePlacements(rig, scene_);
        const RenderInput input{.scene = &scene_,
                                .sceneRevision = revision_,
                                .rig = rig,
                                .environment = loads_ % kLoadsASky == 1 ? &sky_ : nullptr,
                                .camera = cameraFor(scene_, "auto", 1)};
        RenderSettings settings;
        settings.width = settings.height = kPictureSize;
        settings.irradianceSize = kAtlasSize, settings.lightMapSize = kLightMapSize;
        const RenderResult result = renderer_.render(input, settings);
        if (result.stats.nonfinite > 0) throw std::runtime_error("values that are not finite");
    }

    TemporaryFolder folder_{"cutis-soak"};
    std::vector<std::filesystem::path> scenes_;
    Environment sky_;
    Scene scene_;
    EditList edits_;
    std::mt19937 random_{1};
    std::size_t loads_ = 0;
    std::uint64_t revision_ = 0;
    gpu::Device device_{{.select = "cpu", .validation = true}};
    Renderer renderer_{device_};
};

int soak(int loads, int edits) {
    Session session;
    double half = 0;  // the most until half of the run
    double resident = 0;
    int edited = 0;
    for (int load = 1; load <= loads; ++load) {
        session.load();
        for (; edited < static_cast<long long>(edits) * load / loads; ++edited) session.edit();
        resident = residentMegabytes();
        if (load <= (loads + 1) / 2) half = std::max(half, resident);
        if (load % std::max(loads / 20, 1) == 0) {
            std::printf(
                "soak: %d loads, %d edits, %.1f MB resident, %.1f MB of heap, %.1f MB on the device\n", load,
                edited, resident, heapMegabytes(), static_cast<double>(session.deviceBytes()) / 1e6);
            std::fflush(stdout);
        }
    }
    const std::uint64_t messages = gpu::validationMessages();
    const double grown = resident - half;
    std::printf("soak: %d loads, %d edits: %+.1f MB after the first half, %llu validation messages\n", loads,
                edited, grown, static_cast<unsigned long long>(messages));
    return messages > 0 || grown > kGrowthShare * half + kGrowthMegabytes;
}

}  // namespace
}  // namespace cutis::test

int main(int argc, char** argv) {
    const int loads = argc > 1 ? std::atoi(argv[1]) : 0, edits = argc > 2 ? std::atoi(argv[2]) : 0;
    if (loads < 1 || edits < 0) {
        std::fputs("usage: soak LOADS EDITS\n", stderr);
        return 2;
    }
    try {
        return cutis::test::soak(loads, edits);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "soak: %s\n", error.what());
        return 1;
    }
}
