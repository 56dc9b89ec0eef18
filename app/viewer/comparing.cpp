#include "app/viewer/comparing.h"

#include <chrono>
#include <exception>
#include <utility>

#include "app/viewer/overlay.h"
#include "renderer/core/error.h"
#include "renderer/measure/comparison.h"

namespace cutis::app {
namespace {

void requestPicture(Session& session, std::size_t slot) {
    try {
        const int number = slot == 0 ? kPictureA : kPictureB;
        session.asideJobs.push_back({number, stateFor(session, session.compared[slot].document)});
    } catch (const Error& error) {
        session.complain(error.what());
    }
}

void showDifference(Session& session) {
    if (!session.figures || session.figures->map.values.empty()) return;
    const bool relative = session.differenceMap == DifferenceMap::relative;
    session.uploads.emplace_back(kDifferencePicture, relative
                                                         ? showMap(session.figures->map, kWholeDifference)
                                                         : showMap(session.figures->flipMap, kWholeFlip));
}

ComparedFigures compare(std::shared_ptr<const Picture> a, std::shared_ptr<const Picture> b, double exposureA,
                        double exposureB) {
    ComparedFigures figures;
    figures.a = a.get();
    figures.b = b.get();
    try {
        Difference difference = differenceOf({"B", *b, exposureB}, {"A", *a, exposureA});
        figures.relativeL2 = difference.figures.relativeL2;
        figures.p99 = difference.figures.p99;
        figures.flip = difference.flip;
        figures.lightRatio = difference.lightRatio;
        figures.map = std::move(difference.map);
        figures.flipMap = std::move(difference.flipMap);
    } catch (const std::exception&) {
        figures.problem = "The pictures differ in size: render the states anew";
    }
    return figures;
}

}  // namespace

void storeState(Session& session, std::size_t slot, const std::string& name, const Document& document) {
    StoredState& state = session.compared[slot];
    state = {true, name, document, nullptr};
    if (session.complete() && document == session.document()) {
        AsideResult there{slot == 0 ? kPictureA : kPictureB, session.picture->linear, {}, {}};
        there.display = toDisplay(*session.picture->composed, document.rig.exposure);
        takeStatePicture(session, std::move(there));
    } else {
        requestPicture(session, slot);
    }
}

void storeCurrent(Session& session, std::size_t slot) {
    if (!session.geometry) return;
    const std::string& name = session.document().rig.name;
    storeState(session, slot, name.empty() ? "Rig" : name, session.document());
    session.say(slot == 0 ? "Stored as A" : "Stored as B");
}

void compareChosenLight(Session& session) {
    if (!session.hasLight()) return;
    Document all = session.document();
    all.solo.assign(all.rig.lights.size(), false);
    Document alone = all;
    alone.solo[static_cast<std::size_t>(session.selectedLight)] = true;
    storeState(session, 0, "All lights", all);
    storeState(session, 1, session.light().name + " alone", alone);
    if (session.compareMode == CompareMode::off) session.compareMode = CompareMode::wipe;
}

void recallState(Session& session, std::size_t slot) {
    const StoredState& state = session.compared[slot];
    if (!state.stored) return;
    session.edits.endGesture();
    session.edits.apply(slot == 0 ? "Recall A" : "Recall B",
                        [&](Document& document) { document = state.document; });
    session.edits.endGesture();
}

void renewStates(Session& session) {
    for (std::size_t slot = 0; slot < session.compared.size(); ++slot) {
        if (!session.compared[slot].stored) continue;
        session.compared[slot].document.view = session.document().view;
        requestPicture(session, slot);
    }
}

void takeStatePicture(Session& session, AsideResult result) {
    if (!result.linear) return;
    session.compared[result.id == kPictureA ? 0 : 1].linear = result.linear;
    session.uploads.emplace_back(result.id, std::move(result.display));
}

std::shared_ptr<const Picture> comparedWith(const Session& session) {
    if (session.compared[1].stored) return session.compared[1].linear;
    return session.complete() ? session.picture->linear : nullptr;
}

void updateDifference(Session& session) {
    using namespace std::chrono_literals;
    static DifferenceMap shown = DifferenceMap::relative;
    if (session.comparing.valid()) {
        if (session.comparing.wait_for(0s) != std::future_status::ready) return;
        session.figures = session.comparing.get();
        showDifference(session);
    }
    if (shown != session.differenceMap) {
        shown = session.differenceMap;
        showDifference(session);
    }
    const std::shared_ptr<const Picture> a = session.compared[0].linear, b = comparedWith(session);
    if (session.compareMode != CompareMode::difference || !a || !b) return;
    if (session.figures && session.figures->a == a.get() && session.figures->b == b.get()) return;
    const Document& other = session.compared[1].stored ? session.compared[1].document : session.document();
    session.comparing = std::async(std::launch::async, compare, a, b,
                                   session.compared[0].document.rig.exposure, other.rig.exposure);
}

}  // namespace cutis::app
