#include "app/viewer/view_layout.h"

#include <imgui.h>

#include <chrono>
#include <cmath>

#include "app/viewer/mixing.h"

namespace cutis::app {
namespace {

constexpr float kPanelWidth = 290, kMixerHeight = 180;  // at a scale of 1
constexpr double kBlinkPeriod = 0.7;                    // seconds that each of two pictures is shown

// The largest rectangle of that shape in the middle of `room`.
PixelRect fit(const PixelRect& room, double aspect) {
    if (aspect <= 0 || room.width <= 0 || room.height <= 0) return room;
    PixelRect view = room;
    if (room.width > aspect * room.height) {
        view.width = static_cast<int>(std::lround(room.height * aspect));
        view.x += (room.width - view.width) / 2;
    } else {
        view.height = static_cast<int>(std::lround(room.width / aspect));
        view.y += (room.height - view.height) / 2;
    }
    return view;
}

// The current state: the mix while that is newer than the full picture.
int currentPicture(const Session& session) {
    const bool mixed = mixShows(session) && session.mixer.mixedVersion == session.shownVersion();
    return !session.complete() && mixed ? kMixPicture : kLivePicture;
}

}  // namespace

Layout layOut(Session& session, float width, float height, float menuBar, float statusBar) {
    const float scale = static_cast<float>(session.uiScale);
    Layout layout;
    layout.top = menuBar;
    layout.bottom = statusBar;
    // In a window that is too narrow for panels, the picture is worth more.
    const float panels = width / (kPanelWidth * scale);
    layout.side = session.showPanels && panels > 1.6f ? std::round(kPanelWidth * scale) : 0;
    layout.both = layout.side > 0 && panels > 2.5f;
    const float sides = layout.side * (layout.both ? 2 : 1);
    const int bar = static_cast<int>(ImGui::GetFrameHeight() + 6 * scale);
    const bool timed = session.showTimeLine && !session.playback.empty();
    const int timeLine = timed ? static_cast<int>(ImGui::GetFrameHeight() + 8 * scale) : 0;
    const int mixer = session.mixer.shown ? static_cast<int>(kMixerHeight * scale) : 0;
    PixelRect& room = session.room;
    room.x = static_cast<int>(layout.side);
    room.width = static_cast<int>(width - sides);
    layout.bar = {room.x, static_cast<int>(menuBar), room.width, bar};
    room.y = layout.bar.y + bar;
    room.height = static_cast<int>(height - statusBar) - room.y - mixer - timeLine;
    layout.timeLine = {room.x, room.y + room.height, room.width, timeLine};
    layout.mixer = {room.x, room.y + room.height + timeLine, room.width, mixer};
    session.view = fit(room, session.pictureAspect);
    return layout;
}

bool blinkShowsFirst() {
    const double time =
        std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    return std::fmod(time, 2 * kBlinkPeriod) < kBlinkPeriod;
}

std::vector<PicturePart> pictureParts(const Session& session) {
    std::vector<PicturePart> parts = {{kRoomPicture, session.room, session.room}};
    parts.insert(parts.end(), session.thumbnails.begin(), session.thumbnails.end());
    const PixelRect& view = session.view;
    const int current = currentPicture(session);
    if (session.compareMode == CompareMode::off || !session.compared[0].stored) {
        parts.push_back({current, view, view});
        return parts;
    }
    // A state whose picture is still to come shows as the current one.
    const int first = session.compared[0].linear ? kPictureA : current;
    const int other = session.compared[1].linear ? kPictureB : current;
    PixelRect left = view, right = view;
    switch (session.compareMode) {
        case CompareMode::blink:
            parts.push_back({blinkShowsFirst() ? first : other, view, view});
            break;
        case CompareMode::sideBySide:  // both whole, at half the size
            left.width = right.width = view.width / 2;
            left.height = right.height = view.height / 2;
            left.y = right.y = view.y + view.height / 4;
            right.x += left.width;
            parts.push_back({first, left, left});
            parts.push_back({other, right, right});
            break;
        case CompareMode::difference:
            parts.push_back({session.figures ? kDifferencePicture : current, view, view});
            break;
        default:
            left.width = static_cast<int>(session.wipe * view.width);
            right.x += left.width;
            right.width -= left.width;
            parts.push_back({first, view, left});
            parts.push_back({other, view, right});
    }
    return parts;
}

}  // namespace cutis::app
