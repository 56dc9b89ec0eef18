#include "app/viewer/edits.h"

#include <utility>

namespace cutis::app {

void EditList::apply(const std::string& label, const std::function<void(Document&)>& change) {
    Document after = document_;
    change(after);
    if (after == document_) return;
    const bool grows =
        gesture_ && position_ > 0 && position_ == edits_.size() && edits_.back().label == label;
    if (grows) {
        edits_.back().after = after;
    } else {
        edits_.resize(position_);
        edits_.push_back({label, document_, after});
        if (edits_.size() > kMaxEdits) edits_.pop_front();
        position_ = edits_.size();
    }
    document_ = std::move(after);
    gesture_ = true;
    ++version_;
}

void EditList::undo() {
    if (!canUndo()) return;
    document_ = edits_[--position_].before;
    gesture_ = false;
    ++version_;
}

void EditList::redo() {
    if (!canRedo()) return;
    document_ = edits_[position_++].after;
    gesture_ = false;
    ++version_;
}

void EditList::reset(Document document) {
    document_ = std::move(document);
    saved_ = document_.rig;
    edits_.clear();
    position_ = 0;
    gesture_ = false;
    ++version_;
}

}  // namespace cutis::app
