// Keeps the light mixer's pictures up to the document.
#pragma once

#include "app/viewer/session.h"

namespace cutis::app {

// Asks for pictures of lights that changed in more than colour and intensity, once the view's own picture is
// there, and mixes those that are there when a slider has moved.
void updateMixer(Session& session);
// A picture of one light has come.
void takeLightPicture(Session& session, AsideResult result);
// The mix shows the document as it is, so that nothing needs to be rendered at once.
bool mixShows(const Session& session);

}  // namespace cutis::app
