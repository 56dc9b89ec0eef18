#include "app/viewer/session.h"

#include <algorithm>
#include <cstdio>

#include "renderer/core/error.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/characters.h"
#include "renderer/scene/light_samples.h"
#include "renderer/scene/rig.h"

namespace cutis::app {
namespace {

using namespace std::chrono_literals;
constexpr auto kSaid = 10s, kComplained = 60s;  // how long messages stay

// Luminance of what the light gives a surface at its subject's head that faces it.
double irradianceAtHead(const Light& light, const Scene& scene, const glm::dvec3& everyone) {
    Rig alone;
    alone.lights = {light};
    alone.lights[0].enabled = true;
    glm::dvec3 head = everyone;
    if (light.place) {
        resolvePlacements(alone, scene);
        head = alone.lights[0].position + light.place->distance * alone.lights[0].direction;
    }
    const Light& placed = alone.lights[0];
    const glm::dvec3 towards =
        placed.type == LightType::directional ? -placed.direction : glm::normalize(placed.position - head);
    glm::dvec3 sum(0);
    for (const LightSample& sample : sampleLights(alone)) sum += irradianceFrom(sample, head, towards);
    return glm::dot(sum, glm::dvec3(0.2126, 0.7152, 0.0722));
}

Camera cameraOf(const Session& session, const Document& document) {
    const View& view = document.view;
    return view.camera.empty() ? toCamera(view.orbit, session.aspect())
                               : cameraFor(*session.geometry, view.camera, session.aspect());
}

}  // namespace

void Session::say(const std::string& text) {
    announce(text);
    messageEnds = std::chrono::steady_clock::now() + kSaid;
}

void Session::announce(const std::string& text) {
    message = text;
    messageIsError = false;
    messageEnds.reset();
}

// Whoever is about to leave should see it.
void Session::complain(const std::string& text) {
    message = text;
    messageIsError = true;
    messageEnds = std::chrono::steady_clock::now() + kComplained;
    quitsWhenSaved.reset();
    std::fprintf(stderr, "cutis: %s\n", text.c_str());
}

void Session::takeBack(const std::string& text) {
    if (message == text) announce("");
}

void Session::endMessage(std::chrono::steady_clock::time_point now) {
    if (messageEnds && now >= *messageEnds) announce("");
}

bool MixerStrip::complete() const {
    return !contributions.empty() && std::all_of(contributions.begin(), contributions.end(),
                                                 [](const auto& own) { return own.picture != nullptr; });
}

Camera currentCamera(const Session& session) {
    return cameraOf(session, session.document());
}

RenderState stateFor(const Session& session, const Document& document) {
    RenderState state;
    state.scene = session.scene;
    state.skin = document.skin;
    state.pose = session.posed;
    state.rig = effectiveRig(document);
    state.settings = session.request.settings;
    state.settings.width = session.view.width;
    state.settings.height = session.view.height;
    state.camera = cameraOf(session, document);
    state.background = document.background;
    applyQuality(document.quality, session.known.front, state.rig, state.settings);
    resolvePlacements(state.rig, *session.geometry);
    return state;
}

void editLight(Session& session, const std::string& label, const std::function<void(Light&)>& change) {
    if (!session.hasLight()) return;
    const std::size_t index = static_cast<std::size_t>(session.selectedLight);
    session.edits.apply(label + " of " + session.light().name,
                        [&](Document& document) { change(document.rig.lights[index]); });
}

void editView(Session& session, const std::string& label, const std::function<void(OrbitCamera&)>& change) {
    if (!session.geometry) return;
    const Camera camera = currentCamera(session);
    session.edits.apply(label, [&](Document& document) {
        View& view = document.view;
        if (!view.camera.empty()) {
            view.orbit = fromCamera(camera, session.headCentre);
            view.camera.clear();
        }
        change(view.orbit);
    });
}

void updateDerived(Session& session) {
    if (!session.geometry || session.derivedVersion == session.shownVersion()) return;
    session.derivedVersion = session.shownVersion();
    const Document& document = session.document();
    // A head is found among all vertices: only when what is skin may have changed.
    if (session.derivedGeometry != session.geometry || session.derivedSkin != document.skin) {
        if (document.scene == session.openedScene) applySkin(*session.geometry, document.skin);
        const Bounds head = headBounds(*session.geometry, "*");
        session.headCentre = head.empty() ? glm::dvec3(0) : head.centre();
        session.derivedGeometry = session.geometry;
        session.derivedSkin = document.skin;
    } else if (session.derivedRig == document.rig) {
        return;
    }
    session.derivedRig = document.rig;
    session.headIrradiance.clear();
    for (const Light& light : document.rig.lights) {
        double irradiance = 0;
        try {
            irradiance = irradianceAtHead(light, *session.geometry, session.headCentre);
        } catch (const Error&) {  // its subject is not in this scene: rendering says so
        }
        session.headIrradiance.push_back(irradiance);
    }
    const int lights = static_cast<int>(document.rig.lights.size());
    session.selectedLight = std::clamp(session.selectedLight, lights ? 0 : -1, lights - 1);
    session.selectedCharacter =
        std::min(session.selectedCharacter, static_cast<int>(session.geometry->characters.size()) - 1);
}

}  // namespace cutis::app
