#include "app/viewer/comparing.h"

#include <chrono>
#include <exception>
#include <utility>

#include "app/output_folder.h"
#include "app/viewer/overlay.h"
#include "app/viewer/window.h"
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
    session.mapShown = session.differenceMap;
    if (!session.figures || session.figures->map.values.empty()) return;
    const bool relative = session.differenceMap == DifferenceMap::relative;
    session.uploads.emplace_back(kDifferencePicture, relative
                                                         ? showMap(session.figures->map, kWholeDifference)
                                                         : showMap(session.figures->flipMap, kWholeFlip));
}

// What A is compared with: B, else the current state.
const Document& otherDocument(const Session& session) {
    const StoredState& b = session.compared[1];
    return b.stored ? b.document : session.document();
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

// Its lights that are solo come first: two states of one rig differ by them.
std::string nameOf(const Document& document) {
    std::string name;
    for (std::size_t i = 0; i < document.solo.size(); ++i)
        if (document.solo[i]) name += (name.empty() ? "" : " + ") + document.rig.lights[i].name;
    const std::string rig = document.rig.name.empty() ? "Rig" : document.rig.name;
    return name.empty() ? rig : name + " of " + rig;
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
    storeState(session, slot, nameOf(session.document()), session.document());
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

bool figuresAreOfNow(const Session& session) {
    const std::shared_ptr<const Picture> a = session.compared[0].linear, b = comparedWith(session);
    return a && b && session.figures && session.figures->a == a.get() && session.figures->b == b.get();
}

void updateDifference(Session& session) {
    using namespace std::chrono_literals;
    if (session.comparing.valid()) {
        if (session.comparing.wait_for(0s) != std::future_status::ready) return;
        session.figures = session.comparing.get();
        showDifference(session);
    }
    if (session.mapShown != session.differenceMap) showDifference(session);
    const std::shared_ptr<const Picture> a = session.compared[0].linear, b = comparedWith(session);
    if (session.compareMode != CompareMode::difference || !a || !b || figuresAreOfNow(session)) return;
    session.comparing =
        std::async(std::launch::async, compare, a, b, session.compared[0].document.rig.exposure,
                   otherDocument(session).rig.exposure);
}

void saveComparison(Session& session, const std::filesystem::path& folder) {
    if (!session.compared[0].stored)
        return session.complain("Store a state as A first: it is what is compared");
    session.savingComparison = std::filesystem::absolute(folder).lexically_normal();
    session.announce("Saves the comparison when both of its pictures are there");
    continueComparison(session);
}

void continueComparison(Session& session) {
    const std::shared_ptr<const Picture> a = session.compared[0].linear, b = comparedWith(session);
    if (session.savingComparison.empty() || session.writing.valid() || !a || !b) return;
    const StoredState& first = session.compared[0];
    const std::string other = session.compared[1].stored ? session.compared[1].name : "now";
    std::vector<ComparedPicture> pictures = {{"A " + first.name, *a, first.document.rig.exposure},
                                             {"B " + other, *b, otherDocument(session).rig.exposure}};
    session.writing = std::async(
        std::launch::async, [folder = std::exchange(session.savingComparison, {}),
                             title = first.name + " and " + other, pictures = std::move(pictures)] {
            SaidOfSaving said{"The comparison is saved: " + (folder / "index.html").string(), false};
            try {
                prepareOutputFolder(folder, "compare.json");
                writeComparison(folder, title, pictures);
            } catch (const std::exception& problem) {
                said = {problem.what(), true};
            }
            Window::wake();
            return said;
        });
}

}  // namespace cutis::app
