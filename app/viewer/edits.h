// The edit list: every change of the document goes through it, and can be undone. No window, no Vulkan.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>

#include "app/viewer/document.h"

namespace cutis::app {

class EditList {
  public:
    const Document& document() const { return document_; }
    // Grows with every change, undo and redo included: whoever shows the document compares it.
    std::uint64_t version() const { return version_; }

    // Changes a copy of the document and keeps it unless it is equal. `label` names the edit in the menu
    // ("Intensity of key"). Edits that follow each other under the same label are one, until endGesture: the
    // hundred steps of a slider's drag are undone at once. Redo is cut off. What `change` throws leaves the
    // document as it was.
    void apply(const std::string& label, const std::function<void(Document&)>& change);
    // The mouse was released, a key pressed: the next edit stands for itself.
    void endGesture() { gesture_ = false; }

    bool canUndo() const { return position_ > 0; }
    bool canRedo() const { return position_ < edits_.size(); }
    // Label of the edit that undo takes back, or that redo does again; empty when there is none.
    std::string undoLabel() const { return canUndo() ? edits_[position_ - 1].label : ""; }
    std::string redoLabel() const { return canRedo() ? edits_[position_].label : ""; }
    void undo();
    void redo();

    // The rig is in its file as it is now.
    void markSaved() { saved_ = document_.rig; }
    // The rig is not what was loaded or saved last. Views, solo and skin are not in a rig file.
    bool unsaved() const { return document_.rig != saved_; }

    // Starts anew with this document: nothing to undo, nothing unsaved.
    void reset(Document document);

  private:
    struct Edit {
        std::string label;
        Document before, after;  // a few kilobytes each: copies are simpler than inverse operations
    };
    static constexpr std::size_t kMaxEdits = 1000;

    Document document_;
    Rig saved_;
    std::deque<Edit> edits_;
    std::size_t position_ = 0;  // edits before it are done, the others undone
    bool gesture_ = false;      // the last edit may still grow
    std::uint64_t version_ = 0;
};

}  // namespace cutis::app
