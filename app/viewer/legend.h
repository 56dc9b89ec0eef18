// The scale of a picture whose colours stand for numbers.
#pragma once

#include "app/viewer/session.h"

namespace cutis::app {

// Over the picture, in its lower left corner; nothing where colours are those of light.
void drawLegend(const Session& session);

}  // namespace cutis::app
