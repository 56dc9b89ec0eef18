// The mouse in the picture: camera, light handles, the wipe.
#pragma once

#include "app/viewer/session.h"

namespace cutis::app {

// Moves what the mouse drags in session.view, and draws handles and the wipe line over the picture. Between
// beginFrame and endFrame, after the panels.
//   left drag      turns the view, or moves the handle or the wipe line under the mouse; with Ctrl, or while
//   placing
//                  is chosen, places the chosen light by its highlight (with Shift: by its shadow's edge)
//   on a handle    with Shift: distance, with Alt: cone or size
//   middle, right  moves the view;  wheel nears it;  double click frames the person under the mouse; F looks
//   there
void handleView(Session& session);

}  // namespace cutis::app
