// Rows of a panel: a label on the left, its control on the right, each change an undoable edit.
#pragma once

#include <span>
#include <string>

#include "app/viewer/session.h"
#include "renderer/scene/fields.h"

namespace cutis::app {

// Puts the label down; the next control fills the rest of the row.
void label(const char* text);
// A row of the table of fields (renderer/scene/fields.h): its name, its control over its range, its unit, its
// help as a tooltip. Returns true when the user changed the value. `unit` in place of the field's own.
bool fieldRow(const Field& field, double& value, const char* unit = nullptr);
bool fieldRow(const Field& field, int& value, const char* zero = "automatic");  // `zero`: what 0 is called
bool fieldRow(const Field& field, bool& value);
bool fieldRow(const Field& field, std::string& value);
// The same, with a label of its own: one number of several.
bool fieldPartRow(const Field& field, const char* text, double& value);
bool choiceOf(const char* text, const char* option, int& index, std::span<const char* const> names);
// The control alone, as wide as the next item is set to be.
bool fieldCell(const Field& field, double& value);
// One of an enumeration, by the names that the command line has for it.
template <class Enum, std::size_t kCount>
bool enumRow(const char* text, const char* option, Enum& value, const char* const (&names)[kCount]) {
    int index = static_cast<int>(value);
    if (!choiceOf(text, option, index, names)) return false;
    value = static_cast<Enum>(index);
    return true;
}

// Rows. Each returns true when the user changed the value; the label is also the control's identity.
bool dragRow(const char* text, double& value, float speed, double min, double max, const char* format,
             bool logarithmic = false);
bool sliderRow(const char* text, double& value, double min, double max, const char* format,
               bool logarithmic = false);
bool intRow(const char* text, int& value, int min, int max, const char* format = "%d");
bool checkRow(const char* text, bool& value);
bool textRow(const char* text, std::string& value);
// A heading with a thin line, and what it means as a tooltip.
void heading(const std::string& text, const char* help = nullptr);
// Text that ends in an ellipsis where the row ends, or after `width` pixels, and is whole in a tooltip.
void shortText(const std::string& text, bool dim = true, float width = 0);
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
