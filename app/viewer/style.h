// How the interface looks.
#pragma once

namespace cutis::app {

// Font, sizes and colours of the current ImGui context: dark, quiet greys that leave the eye to the picture.
// Before the first frame.
void applyStyle(double scale);

// Colours that mean something, as ImGui's packed 32 bits.
unsigned accentColor(float alpha = 1);  // chosen, active
unsigned warningColor();                // needs attention

}  // namespace cutis::app
