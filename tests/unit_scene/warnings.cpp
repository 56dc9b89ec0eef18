#include "warnings.h"

#include <algorithm>
#include <mutex>

namespace cutis::test {
namespace {

std::mutex mutex;
std::vector<std::string> captured;

void keep(const std::string& text) {
    const std::lock_guard lock(mutex);
    captured.push_back(text);
}

}  // namespace

CapturedWarnings::CapturedWarnings() : previous_(setWarningSink(keep)) {
    captured.clear();
}

CapturedWarnings::~CapturedWarnings() {
    setWarningSink(previous_);
}

const std::vector<std::string>& CapturedWarnings::all() const {
    return captured;
}

int CapturedWarnings::count(const std::string& part) const {
    return int(std::ranges::count_if(captured, [&](const std::string& w) { return w.find(part) != w.npos; }));
}

}  // namespace cutis::test
