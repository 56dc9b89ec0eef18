// The viewer as a whole.
#pragma once

#include "app/options.h"

namespace cutis::app {

// Opens the window on operand 0 of the request, loads and renders in the background, and returns when the
// user quits. Throws Error when no window can be opened.
void runViewer(const Request& request);

}  // namespace cutis::app
