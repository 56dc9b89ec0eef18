// Data of a picture shown as colours.
#pragma once

#include <span>
#include <string>

#include "app/viewer/display_picture.h"

namespace cutis::app {

struct Overlay {
    const char* aov;    // of kAovNames; empty: the picture itself
    const char* label;  // in the menu
    const char* scale;  // what its colours mean
};

// All that can be shown, the picture first.
std::span<const Overlay> overlays();

// The AOV as the overlay shows it. Light is exposed and tone mapped as the picture is.
DisplayPicture showAov(const std::string& aov, const Picture& values, double exposure);
// A one-channel picture from black (0) through purple, red and yellow to white (`whole` and beyond).
DisplayPicture showMap(const Picture& map, double whole);

}  // namespace cutis::app
