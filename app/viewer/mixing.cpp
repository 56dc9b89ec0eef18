#include "app/viewer/mixing.h"

#include <algorithm>
#include <utility>

#include "renderer/core/error.h"
#include "renderer/scene/rig.h"

namespace cutis::app {
namespace {

// Of the view's width and height: four times as fast, and what is mixed is shown for as long as a slider
// moves.
constexpr int kReduction = 2;

bool sameView(const Session& session) {
    const MixerStrip& mixer = session.mixer;
    const Document& document = session.document();
    return mixer.scene == session.scene && mixer.view == document.view && mixer.skin == document.skin &&
           mixer.pose == session.posed && mixer.width == session.view.width &&
           mixer.height == session.view.height;
}

// Light that no light gives is in every light's own picture: the sum would hold it several times.
bool glows(const Scene& scene) {
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [](const Material& m) { return m.unlit || m.emissive != glm::vec3(0); });
}

void request(Session& session, std::size_t index) {
    const Contribution& own = session.mixer.contributions[index];
    Document alone = session.document();
    alone.rig = aloneRig(session.document(), own);
    alone.solo.assign(alone.rig.lights.size(), false);
    try {
        AsideJob job{kLightPictures + static_cast<int>(index), stateFor(session, alone)};
        job.state.background = Background::none;  // it would be in every light's picture
        job.state.settings.width = std::max(job.state.settings.width / kReduction, 1);
        job.state.settings.height = std::max(job.state.settings.height / kReduction, 1);
        session.asideJobs.push_back(std::move(job));
    } catch (const Error& error) {
        session.complain(error.what());
    }
}

// Everything anew, but for the pictures of lights that are as they were.
void renew(Session& session) {
    MixerStrip& mixer = session.mixer;
    const Document& document = session.document();
    const bool keeps = sameView(session);
    const std::vector<Contribution> before = std::exchange(mixer.contributions, contributionsOf(document));
    mixer.view = document.view;
    mixer.skin = document.skin;
    mixer.pose = session.posed;
    mixer.scene = session.scene;
    mixer.width = session.view.width;
    mixer.height = session.view.height;
    for (std::size_t i = 0; i < mixer.contributions.size(); ++i) {
        if (keeps && i < before.size() && sameShape(before[i], mixer.contributions[i])) {
            mixer.contributions[i] = before[i];
        } else {
            request(session, i);
        }
    }
}

}  // namespace

bool mixShows(const Session& session) {
    return session.mixer.shown && session.mixer.complete() && session.overlay.aov.empty() &&
           sameView(session) && canMix(session.mixer.contributions, session.document());
}

void updateMixer(Session& session) {
    MixerStrip& mixer = session.mixer;
    if (!mixer.shown || !session.geometry) return;
    if (glows(*session.geometry)) {
        mixer.shown = false;
        session.say("The mixer cannot add up a scene that glows by itself");
        return;
    }
    if (session.complete() && !(sameView(session) && canMix(mixer.contributions, session.document())))
        renew(session);
    if (!mixShows(session) || mixer.mixedVersion == session.shownVersion()) return;
    mixer.mixedVersion = session.shownVersion();
    session.uploads.emplace_back(kMixPicture, toDisplay(mix(mixer.contributions, session.document()),
                                                        session.document().rig.exposure));
}

void takeLightPicture(Session& session, AsideResult result) {
    const auto index = static_cast<std::size_t>(result.id - kLightPictures);
    if (index >= session.mixer.contributions.size() || !result.linear) return;
    session.mixer.contributions[index].picture = result.linear;
    session.mixer.mixedVersion = 0;
    session.uploads.emplace_back(result.id, std::move(result.display));
}

}  // namespace cutis::app
