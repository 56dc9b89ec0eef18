// What is not saved, kept in the cache folder in case the program ends badly: the rig, and how the materials
// scatter.
#pragma once

#include "app/viewer/session.h"

namespace cutis::app {

// Writes what is not saved now, and removes what is saved meanwhile. Says nothing where the disk takes it no
// more: saving by hand does.
void autosave(const Session& session);
// All is saved, or was given up.
void discardAutosave();

// At the start: puts aside what earlier runs left, so that this one does not write over it; other programs that
// run at the same time keep theirs. True when there is something to recover.
bool keepAutosave();
// The same later: a program that was killed may take its time to end. True when there is something to recover.
bool findLeftBehind();
// Takes it into the document, as one edit each. Skin of another scene stays where it is until that is open;
// so does what cannot be read. The session says what came of it.
void recoverUnsaved(Session& session);

}  // namespace cutis::app
