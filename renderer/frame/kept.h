// What is still good of earlier pictures: decides which rows of a plan run again.
//
// Each row has a signature: a hash of the inputs that it reads, of the needs that change what it does, and of the
// signatures of the rows that wrote what it reads. It runs when that differs from the signature of what it wrote last.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "renderer/frame/plan.h"

namespace cutis {

// A hash of the values of each input.
using InputHashes = std::array<std::uint64_t, kInputCount>;

// What a row reads that is not as it was when the row last ran. First: it never did.
struct Changes {
    bool first = true;
    std::set<Input> inputs;
    std::set<Resource> resources;
    bool needs = false;
    // Of a row that works group by group: a flag for each group of receivers, empty for all of them (frame/changed_groups.h).
    std::vector<bool> groups;
    // Nothing but some of these.
    bool onlyInputs(const std::set<Input>& these) const {
        return !first && !needs && std::includes(these.begin(), these.end(), inputs.begin(), inputs.end());
    }
    bool only(const std::set<Input>& these, const std::set<Resource>& andThese = {}) const {
        return onlyInputs(these) && std::includes(andThese.begin(), andThese.end(), resources.begin(), resources.end());
    }
};

struct RowDecision {
    bool run = false;
    Changes changes;
};

class Kept {
  public:
    // One decision for each row of the plan. Nothing is noted yet.
    std::vector<RowDecision> decide(const Plan& plan, const Needs& needs, const InputHashes& inputs) const;
    // The rows of `plan` have run as decided for these inputs; what other rows wrote is gone.
    void note(const Plan& plan, const Needs& needs, const InputHashes& inputs);
    // Rows that wrote something which is still there and that the plan does not hold.
    std::vector<const PassRow*> leftOver(const Plan& plan) const;
    void forgetRow(const PassRow* row) { written_.erase(row); }

  private:
    struct Signature {
        std::map<Input, std::uint64_t> inputs;
        std::map<Resource, std::uint64_t> resources;  // 0: nobody wrote it
        std::vector<bool> needs;
        std::uint64_t hash() const;
        bool operator==(const Signature&) const = default;
    };
    static std::vector<Signature> signaturesOf(const Plan& plan, const Needs& needs, const InputHashes& inputs);

    std::map<const PassRow*, Signature> written_;
};

}  // namespace cutis
