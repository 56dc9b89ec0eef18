#include "renderer/frame/renderer.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <set>
#include <utility>

#include "renderer/core/error.h"
#include "renderer/core/timeline.h"
#include "renderer/frame/ahead.h"
#include "renderer/frame/camera.h"
#include "renderer/frame/changed_groups.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/inputs.h"
#include "renderer/frame/light_patches.h"
#include "renderer/frame/results.h"
#include "renderer/gpu/device.h"
#include "renderer/passes/light_views.h"

namespace cutis {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

NeedsInput factsOf(const FrameContext& frame) {
    const Scene& scene = *frame.input->scene;
    NeedsInput facts;
    facts.animations = static_cast<int>(scene.animations.size());
    facts.merge = frame.settings->merge;
    facts.chain = frame.settings->chain;
    facts.prune = frame.settings->prune;
    facts.anyView = frame.anyView;
    facts.environment = frame.lighting.environment != nullptr;
    facts.lightSamples = static_cast<int>(frame.lighting.samples.size());
    for (const LightSample& sample : frame.lighting.samples) {
        facts.shadowedSamples += sample.shadow;
        facts.areaSamples += sample.radius > 0;
    }
    for (const GeometryDraw& draw : frame.geometry.draws) {
        facts.skinDraws += draw.skin;
        facts.blendedDraws += scene.materials[draw.material].seenThrough();
    }
    std::set<int> drawn;
    for (const GeometryDraw& draw : frame.geometry.draws) drawn.insert(draw.material);
    for (const int index : drawn) {
        const Material& material = scene.materials[index];
        if (!material.layered()) continue;
        facts.coatedMaterials += material.clearcoat.factor > 0;
        facts.sheenMaterials += material.sheen.color != glm::vec3(0);
        facts.glassMaterials += material.transmission > 0;
    }
    facts.seams = frame.skinMesh.seams;
    facts.wideGaussians = frame.wideGaussians;
    for (const int material : skinMaterials(scene, frame.geometry)) {
        facts.translucentSkinMaterials += scene.materials[material].skin->translucency;
        const SkinMaterial& skin = *scene.materials[material].skin;
        facts.shinySkinMaterials += skin.specular > 0;
        facts.twoLobedMaterials += skin.specular > 0 && skin.lobeWeight > 0;
        facts.poredMaterials += skin.specular > 0 && skin.detail > 0;
    }
    facts.poresResolved = resolvesPores(frame);
    return facts;
}

}  // namespace

struct Renderer::State {
    FrameContext frame;
    Kept kept;
    ChangedGroups changedGroups;
    std::uint64_t geometry = 0;      // hashGeometry of frame.geometry
    std::uint64_t poseRevision = 0;  // that it is in
    std::map<const PassRow*, std::uint64_t> bytes;
    SkinFigures skin;
    bool skinUnread = false;  // skin was lit for a frame that was interrupted: `skin` is not of it

    RenderResult render(const RenderInput& input, const RenderSettings& settings);
    RenderStats plan(const RenderInput& input, const RenderSettings& settings);
    void anticipate(const RenderInput& input, const RenderSettings& settings);

  private:
    void readGeometry();
    void read();
    void findGroupsSeen();
    void drop(const Plan& plan);
    bool record(const PassRow& row, const Changes& changes);
    void prepare(const Plan& plan, const std::vector<RowDecision>& decisions);
    std::vector<gpu::PassTiming> drawFrame(const Plan& plan, const std::vector<RowDecision>& decisions,
                                           Readbacks& readbacks);
    void forgetFrom(const Plan& plan, const std::vector<RowDecision>& decisions, std::size_t row);
    PassStats statsOf(const PassRow& row, const std::string& why, bool ran) const;
};

namespace {

// Said before such a scene is laid out, which takes half a minute.
void expectWithinReach(const gpu::Device& device, const Geometry& geometry) {
    const std::uint64_t reach = device.limits().maxStorageBufferRange;
    const std::uint64_t bytes = std::max(geometry.attributes.size() * sizeof(geometry.attributes[0]),
                                         geometry.indices.size() * sizeof(geometry.indices[0]));
    if (bytes <= reach) return;
    throw Error("cannot draw the scene",
                "its " + std::to_string(geometry.attributes.size()) + " vertices take a buffer of " + std::to_string(bytes / 1'000'000) +
                    " MB, shaders of this device reach " + std::to_string(reach / 1'000'000),
                device.info().name);
}

}  // namespace

void Renderer::State::readGeometry() {
    const RenderInput& input = *frame.input;
    const std::uint64_t key = hashGeometry(input);
    if (geometry != key) {
        geometry = 0;
        frame.geometry = flattenScene(*input.scene);
        expectWithinReach(*frame.device, frame.geometry);
        const AtRest atRest(frame.geometry);
        frame.skinMesh = makeSkinMesh(frame.geometry);
        frame.atlas = {};  // its charts name materials that need not be skin any more
        frame.detail = {};
        geometry = key;
    } else if (poseRevision != input.poseRevision) {
        followPose(*input.scene, frame.geometry);
    }
    poseRevision = input.poseRevision;
    frame.groups.clear();
    for (const ReceiverGroup& group : frame.geometry.receiverGroups) frame.groups.push_back(group.bounds);
    frame.camera = viewCamera(input.camera, frame.geometry.origin, frame.geometry.bounds,
                              {frame.settings->width, frame.settings->height});
}

// All that decisions follow from.
void Renderer::State::read() {
    readGeometry();
    frame.wideGaussians = countWideGaussians(*frame.input->scene, frame.geometry, *frame.settings);
    findGroupsSeen();
    chooseDetail(frame);
    readLighting(frame);
    const NeedsInput facts = factsOf(frame);
    frame.needs = computeNeeds(facts);
    const std::vector<bool>& maps = frame.lighting.mapsNeeded;
    chooseLightMapSize(frame, static_cast<std::size_t>(std::count(maps.begin(), maps.end(), true)));
}

void Renderer::State::findGroupsSeen() {
    const RenderSettings& settings = *frame.settings;
    const bool oneView = !frame.anyView && settings.prune && settings.chain == Chain::exact && frame.wideGaussians == 0;
    frame.groupsSeen.clear();
    for (const Bounds& group : frame.groups) {
        const glm::vec3 low(group.min - frame.geometry.origin), high(group.max - frame.geometry.origin);
        frame.groupsSeen.push_back(!oneView || reaches(frame.camera.worldToClip, low, high));
    }
    const bool any = std::find(frame.groupsSeen.begin(), frame.groupsSeen.end(), true) != frame.groupsSeen.end();
    if (!any) frame.groupsSeen.assign(frame.groups.size(), true);  // an empty picture: nothing to gain
}

// Frees what the plan does not write any more.
void Renderer::State::drop(const Plan& plan) {
    for (const PassRow* row : kept.leftOver(plan)) {
        if (row->forget) row->forget(frame);
        bytes.erase(row);
        kept.forgetRow(row);
    }
}

bool Renderer::State::record(const PassRow& row, const Changes& changes) {
    const bool whole = changes.first || !(row.amends || !changes.groups.empty());
    if (row.forget && whole && !row.ahead) row.forget(frame);
    const std::uint64_t before = frame.device->bytesAllocated();
    frame.changes = &changes;
    frame.tiles.changed = changes.groups;
    {
        const TimeSpan span(row.name);
        if (row.record) row.record(frame);
    }
    frame.changes = nullptr;
    if (whole) bytes[&row] = frame.device->bytesAllocated() - before;
    return true;
}

void Renderer::State::prepare(const Plan& plan, const std::vector<RowDecision>& decisions) {
    {
        Ahead ahead(frame, plan, decisions);
        for (std::size_t i = 0; i < plan.rows.size(); ++i) {
            if (plan.rows[i]->phase == Phase::alone && decisions[i].run) record(*plan.rows[i], decisions[i].changes);
        }
        ahead.wait();
    }
    std::optional<gpu::Commands> commands;
    for (std::size_t i = 0; i < plan.rows.size(); ++i) {
        if (plan.rows[i]->phase != Phase::upload || !decisions[i].run) continue;
        if (!commands) frame.commands = &commands.emplace(*frame.device);
        record(*plan.rows[i], decisions[i].changes);
    }
    if (commands) {
        const TimeSpan span("uploads");
        commands->submitAndWait();
    }
    frame.commands = nullptr;
}

std::vector<gpu::PassTiming> Renderer::State::drawFrame(const Plan& plan, const std::vector<RowDecision>& decisions,
                                                        Readbacks& readbacks) {
    readbacks = {};
    gpu::Commands commands = frame.device->begin();
    commands.stopWhen(frame.settings->stopAsked);
    frame.commands = &commands;
    bool lit = std::exchange(skinUnread, false);
    for (std::size_t i = 0; i < plan.rows.size(); ++i) {
        const PassRow& row = *plan.rows[i];
        if (row.phase != Phase::frame || !decisions[i].run) continue;
        commands.beginPass(row.name);
        try {
            record(row, decisions[i].changes);
        } catch (const Interrupted&) {
            forgetFrom(plan, decisions, i);
            skinUnread = lit;
            throw;
        }
        commands.endPass();
        lit |= row.need == Need::litSkin;
    }
    commands.stopWhen({});
    readbacks = recordReadbacks(frame, lit);
    {
        const TimeSpan span("frame");
        commands.submitAndWait();
    }
    frame.commands = nullptr;
    return commands.timings();
}

// The frame was interrupted within that row: rows above hold what this picture needs; of that one and those below, what was
// to be drawn anew is gone.
void Renderer::State::forgetFrom(const Plan& plan, const std::vector<RowDecision>& decisions, std::size_t row) {
    kept.note(plan, frame.needs, hashInputs(frame));
    for (std::size_t i = row; i < plan.rows.size(); ++i) {
        const PassRow& left = *plan.rows[i];
        if (left.phase != Phase::frame || !decisions[i].run) continue;
        if (left.forget) left.forget(frame);
        bytes.erase(&left);
        kept.forgetRow(&left);
    }
    changedGroups.forget();  // rows above may have drawn some groups alone
    frame.changes = nullptr;
    frame.commands = nullptr;
    frame.input = nullptr;
    frame.settings = nullptr;
}

PassStats Renderer::State::statsOf(const PassRow& row, const std::string& why, bool ran) const {
    PassStats stats{.name = row.name, .runs = ran ? 1 : 0};
    stats.reason = ran ? why : "unchanged: " + describeReads(row);
    const auto found = bytes.find(&row);
    if (found != bytes.end()) stats.bytes = found->second;
    return stats;
}

RenderResult Renderer::State::render(const RenderInput& input, const RenderSettings& settings) {
    const Clock::time_point start = Clock::now();
    gpu::Device& device = *frame.device;
    device.resetPeak();
    frame.input = &input;
    frame.settings = &settings;
    {
        const TimeSpan span("geometry");
        read();
    }
    const Plan plan = makePlan(frame.needs);
    const InputHashes inputs = hashInputs(frame);
    std::vector<RowDecision> decisions = kept.decide(plan, frame.needs, inputs);
    const std::vector<bool> groups = changedGroups.find(frame, inputs);
    for (std::size_t i = 0; i < plan.rows.size(); ++i) {
        const Changes& changes = decisions[i].changes;
        if (plan.rows[i]->byGroup && changes.onlyInputs({})) decisions[i].changes.groups = groups;
    }
    drop(plan);
    prepare(plan, decisions);
    const int repeats = std::max(settings.repeats, 1);
    if (repeats > 1) {
        for (std::size_t i = 0; i < plan.rows.size(); ++i) {
            if (plan.rows[i]->phase == Phase::frame) decisions[i] = {true, {}};
        }
    }
    RenderResult result;
    result.stats.loadMs = millisecondsSince(start);

    Clock::time_point frameStart;
    Readbacks readbacks;
    std::vector<std::vector<gpu::PassTiming>> timings;
    for (int repeat = 0; repeat < repeats; ++repeat) {
        frameStart = Clock::now();
        timings.push_back(drawFrame(plan, decisions, readbacks));
    }
    result.stats.frameMs = millisecondsSince(frameStart);
    kept.note(plan, frame.needs, hashInputs(frame));  // some follow from the layout that is there now
    changedGroups.note();

    for (std::size_t i = 0; i < plan.rows.size(); ++i) {
        const PassRow& row = *plan.rows[i];
        PassStats stats = statsOf(row, plan.reasons[i], decisions[i].run);
        const std::vector<bool>& changed = decisions[i].changes.groups;
        if (!changed.empty() && decisions[i].run) {
            stats.reason += "; of " + std::to_string(changed.size()) + " groups, " +
                            std::to_string(std::count(changed.begin(), changed.end(), true)) + " changed";
        }
        for (const std::vector<gpu::PassTiming>& repeat : timings) {
            for (const gpu::PassTiming& timing : repeat) {
                if (timing.name != stats.name) continue;
                stats.runs = timing.runs;
                stats.gpuMs = timing.milliseconds;
                stats.repeatedMs.push_back(timing.milliseconds);
                if (row.need == Need::shadows) result.stats.lightMapsDrawn = frame.lights.drawn;
            }
        }
        (row.phase == Phase::frame ? result.stats.passes : result.stats.prepared).push_back(std::move(stats));
    }
    fillStats(frame, plan, result.stats);
    takePictures(frame, readbacks, skin, result);
    frame.input = nullptr;
    frame.settings = nullptr;
    return result;
}

RenderStats Renderer::State::plan(const RenderInput& input, const RenderSettings& settings) {
    frame.device->resetPeak();
    frame.input = &input;
    frame.settings = &settings;
    read();
    const Plan plan = makePlan(frame.needs);
    const std::vector<RowDecision> decisions(plan.rows.size(), RowDecision{true, {}});
    prepare(plan, decisions);
    RenderStats stats;
    gpu::Commands commands = frame.device->begin();  // never submitted
    frame.commands = &commands;
    for (std::size_t i = 0; i < plan.rows.size(); ++i) {
        const PassRow& row = *plan.rows[i];
        if (row.phase == Phase::frame) record(row, decisions[i].changes);
        (row.phase == Phase::frame ? stats.passes : stats.prepared).push_back(statsOf(row, plan.reasons[i], true));
    }
    fillStats(frame, plan, stats);
    return stats;
}

void Renderer::State::anticipate(const RenderInput& input, const RenderSettings& settings) {
    frame.input = &input;
    frame.settings = &settings;
    readGeometry();
    anticipateDetail(frame);
}

Renderer::Renderer(gpu::Device& device, Views views) : device_(device), views_(views) {}

Renderer::~Renderer() = default;

void Renderer::forget() { state_ = nullptr; }

std::unique_ptr<Renderer::State> Renderer::makeState() const {
    auto state = std::make_unique<State>();
    state->frame.device = &device_;
    state->frame.anyView = views_ == Views::any;
    return state;
}

RenderStats Renderer::plan(const RenderInput& input, const RenderSettings& settings) {
    forget();
    return makeState()->plan(input, settings);
}

RenderResult Renderer::render(const RenderInput& input, const RenderSettings& settings) {
    if (!state_) state_ = makeState();
    try {
        return state_->render(input, settings);
    } catch (const Interrupted&) {
        throw;
    } catch (...) {
        forget();
        throw;
    }
}

void Renderer::anticipate(const RenderInput& input, const RenderSettings& settings) {
    if (!state_) state_ = makeState();
    state_->anticipate(input, settings);
}

RenderResult renderPicture(gpu::Device& device, const RenderInput& input, const RenderSettings& settings) {
    return Renderer(device, Renderer::Views::one).render(input, settings);
}

}  // namespace cutis
