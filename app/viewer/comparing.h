// Two states beside each other: A, and B or the current state.
#pragma once

#include "app/viewer/session.h"

namespace cutis::app {

// kWholeDifference and kWholeFlip in words.
inline constexpr const char *kWholeDifferenceText = "the mean light", *kWholeFlipText = "0.5";

// Puts the document aside as A (slot 0) or B (slot 1); its full picture is rendered beside the view unless it
// is there.
void storeState(Session& session, std::size_t slot, const std::string& name, const Document& document);
void storeCurrent(Session& session, std::size_t slot);
// All lights as A, the chosen light alone as B.
void compareChosenLight(Session& session);
// Makes a stored state the current one, as an edit.
void recallState(Session& session, std::size_t slot);
// Renders the stored states anew from where the view is now.
void renewStates(Session& session);

// A picture of a stored state has come.
void takeStatePicture(Session& session, AsideResult result);
// The figures are of the two pictures that are compared now.
bool figuresAreOfNow(const Session& session);
// While the difference is shown: computes it, in the background, when what is compared has changed.
void updateDifference(Session& session);

// What `cutis compare` writes, of A and what it is compared with, into a folder that is new or holds such a
// report; once both pictures are there, in the background. The session says what came of it.
void saveComparison(Session& session, const std::filesystem::path& folder);
// Begins to write it once they are.
void continueComparison(Session& session);

// The picture that A is compared with: B's, else the current full one; null until it is there.
std::shared_ptr<const Picture> comparedWith(const Session& session);

}  // namespace cutis::app
