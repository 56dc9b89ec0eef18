// Ctrl-C and its kin.
#pragma once

namespace cutis::app {

// From now on SIGINT, SIGTERM and SIGHUP end the program with status 128 + signal, at any moment, leaving no
// half-written file behind. Call it first in main: threads that exist already would not take part.
void endCleanlyOnSignals();

}  // namespace cutis::app
