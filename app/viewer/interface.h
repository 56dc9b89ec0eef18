// One frame of the interface, all of it.
#pragma once

#include <string>
#include <vector>

#include "app/viewer/session.h"
#include "app/viewer/thumbnails.h"

namespace cutis::app {

// "cutis - SCENE"
std::string titleOf(const std::string& scene);

// Draws menu, panels, bars and dialogs, and does what the mouse does in them and in the picture. Returns the
// pictures that lie behind. `environments` are begun when they are looked at.
std::vector<PicturePart> drawInterface(Session& session, EnvironmentThumbnails& environments);

}  // namespace cutis::app
