// Data of a picture shown as colours.
#pragma once

#include <span>
#include <string>

#include "app/viewer/display_picture.h"
#include "renderer/frame/renderer.h"

namespace cutis::app {

struct Overlay {
    const char* aov;    // of kAovNames, or kInspectedName; empty: the picture itself
    const char* label;  // in the menu
    const char* scale;  // what its colours mean
    Inspect::What inspect = Inspect::What::none;
};

// All that can be shown, the picture first.
std::span<const Overlay> overlays();

// What is shown in place of the picture.
struct Shown {
    std::string aov;  // as Overlay has it
    Inspect inspect;
    bool operator==(const Shown&) const = default;
};

// The AOV as the overlay shows it. Light is exposed and tone mapped as the picture is.
DisplayPicture showAov(const Shown& shown, const Picture& values, double exposure);
// A one-channel picture from black (0) through purple, red and yellow to white (`whole` and beyond).
DisplayPicture showMap(const Picture& map, double whole);

}  // namespace cutis::app
