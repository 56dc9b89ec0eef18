// Data of a picture shown as colours.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>

#include "app/viewer/display_picture.h"
#include "renderer/frame/renderer.h"
#include "renderer/measure/maps.h"

namespace cutis::app {

struct Overlay {
    const char* aov;    // of kAovNames, or kInspectedName; empty: the picture itself
    const char* label;  // in the menu
    const char* scale;  // what its colours mean
    Inspect::What inspect = Inspect::What::none;
    // Where colours run from black to white (heatColor): what they stand for. Empty: they do not.
    const char* black = "";
    const char* white = "";
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
// A one-channel picture in the colours of the maps of `cutis compare`, white at `whole`.
DisplayPicture showMap(const Picture& map, double whole);

}  // namespace cutis::app
