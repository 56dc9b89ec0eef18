// Rows of a panel: a label on the left, its control on the right, each change an undoable edit.
#pragma once

#include <string>

#include "app/viewer/session.h"

namespace cutis::app {

// Puts the label down; the next control fills the rest of the row.
void label(const char* text);
// Rows. Each returns true when the user changed the value; the label is also the control's identity.
bool dragRow(const char* text, double& value, float speed, double min, double max, const char* format,
             bool logarithmic = false);
bool sliderRow(const char* text, double& value, double min, double max, const char* format,
               bool logarithmic = false);
bool intRow(const char* text, int& value, int min, int max, const char* format = "%d");
bool checkRow(const char* text, bool& value);
bool textRow(const char* text, std::string& value);
// A heading with a thin line.
void heading(const char* text);
// Text that ends in an ellipsis where the row ends, and is whole in a tooltip.
void shortText(const std::string& text, bool dim = true);
void hint(const char* text);  // shown when the mouse rests on the last control
// The help of that option of the command line, which the control stands for.
void optionHint(const char* option);
// A small button that stays down while `on`.
bool toggleButton(const char* text, bool on, unsigned color);

// A picture of the window as a button of that size in pixels, framed when it is chosen; a dark place while
// there is no such picture. True when it was clicked. `id` is its identity within the panel.
bool thumbnail(Session& session, const char* id, int picture, float width, float height, bool chosen);
// Shows `picture` over the rectangle from `corner` in the current panel, under what is drawn there.
void placePicture(Session& session, int picture, float x, float y, float width, float height);

}  // namespace cutis::app
