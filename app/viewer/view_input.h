// The mouse in the picture: camera, light handles, the wipe.
#pragma once

#include "app/viewer/session.h"

namespace cutis::app {

// Moves what the mouse drags in session.view, and draws handles and the wipe line over the picture. Between
// beginFrame and endFrame, after the panels.
//   left drag      turns the view, or moves the handle or the wipe line under the mouse
//   middle, right  moves the view;  wheel nears it;  double click frames the person nearest to the mouse
void handleView(Session& session);

}  // namespace cutis::app
