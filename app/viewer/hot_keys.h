// One table of hot keys: what runs them and what the help overlay prints.
#pragma once

#include <span>

#include "app/viewer/session.h"

namespace cutis::app {

struct HotKey {
    int key, modifiers;   // GLFW's
    const char* keys;     // "Ctrl+S"
    const char* meaning;  // "Save the rig"
    void (*run)(Session& session);
    bool repeats = false;  // also while it is held: a step. What turns something on or off does not
};

std::span<const HotKey> hotKeys();

// Runs the key's row, if there is one. While text is typed only keys with Ctrl and function keys count.
void runHotKey(Session& session, const KeyPress& press, bool typing);

}  // namespace cutis::app
