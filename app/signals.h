// Ctrl-C and its kin.
#pragma once

#include <atomic>

namespace cutis::app {

// From now on SIGINT, SIGTERM and SIGHUP end the program with status 128 + signal, at any moment, leaving no
// half-written file behind. Call it first in main: threads that exist already would not take part.
void endCleanlyOnSignals();

// From now on the first such signal only sets *stop, for work that wants to save what it has and then return
// endingStatus(); a second one ends the program as before. nullptr: every one does.
void stopGentlyOnSignals(std::atomic<bool>* stop);
// 128 + the signal that set *stop; 0 when none did.
int endingStatus();

}  // namespace cutis::app
