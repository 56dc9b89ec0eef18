// Warnings of cutis, kept for a test to look at.
#pragma once

#include <string>
#include <vector>

#include "renderer/core/error.h"

namespace cutis::test {

// Collects warnings from construction to destruction; one at a time.
class CapturedWarnings {
  public:
    CapturedWarnings();
    ~CapturedWarnings();
    CapturedWarnings(const CapturedWarnings&) = delete;
    CapturedWarnings& operator=(const CapturedWarnings&) = delete;

    const std::vector<std::string>& all() const;
    // How many of them hold `part`.
    int count(const std::string& part) const;

  private:
    WarningSink previous_;
};

}  // namespace cutis::test
