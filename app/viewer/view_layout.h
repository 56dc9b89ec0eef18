// Where everything lies in the window.
#pragma once

#include "app/viewer/session.h"

namespace cutis::app {

struct Layout {
    float side = 0;        // width of the panels on the left and on the right; 0: hidden
    bool both = false;     // there is room for both; else all tabs are on the left
    float top = 0;         // below the menu bar
    float bottom = 0;      // above the status bar
    PixelRect bar, timeLine, mixer;  // above the picture, and below it; empty: not shown
};

// Puts session.room and session.view where they belong in a window of that size; panels may be hidden.
Layout layOut(Session& session, float width, float height, float menuBar, float statusBar);

// While two pictures blink: the first is shown now.
bool blinkShowsFirst();

// The pictures behind the interface: the view, as it is compared, and the panels' thumbnails.
std::vector<PicturePart> pictureParts(const Session& session);

}  // namespace cutis::app
