#include "renderer/frame/kept.h"

#include <algorithm>

#include "renderer/core/hash.h"

namespace cutis {
namespace {

bool holds(const std::vector<Resource>& list, Resource resource) {
    return std::find(list.begin(), list.end(), resource) != list.end();
}

Changes changesBetween(const auto& before, const auto& now) {
    Changes changes;
    changes.first = false;
    for (const auto& [input, hash] : now.inputs) {
        if (before.inputs.at(input) != hash) changes.inputs.insert(input);
    }
    for (const auto& [resource, hash] : now.resources) {
        if (before.resources.at(resource) != hash) changes.resources.insert(resource);
    }
    changes.needs = before.needs != now.needs;
    return changes;
}

// Rows that change one resource in place begin where the first of them left it: when one runs, all do.
void runTogether(const Plan& plan, std::vector<RowDecision>& decisions) {
    std::set<Resource> inPlace;
    for (const PassRow* row : plan.rows) inPlace.insert(row->updates.begin(), row->updates.end());
    for (bool changed = true; changed;) {
        changed = false;
        for (const Resource resource : inPlace) {
            std::vector<RowDecision*> group;
            for (std::size_t i = 0; i < plan.rows.size(); ++i) {
                if (holds(plan.rows[i]->updates, resource) || holds(plan.rows[i]->writes, resource)) {
                    group.push_back(&decisions[i]);
                }
            }
            if (std::none_of(group.begin(), group.end(), [](const RowDecision* d) { return d->run; })) continue;
            for (RowDecision* decision : group) {
                changed |= !decision->run;
                decision->run = true;
            }
        }
    }
}

}  // namespace

std::uint64_t Kept::Signature::hash() const {
    ContentHash hash;
    for (const auto& [input, value] : inputs) hash.add(input, value);
    for (const auto& [resource, value] : resources) hash.add(resource, value);
    for (const bool met : needs) hash.add(met);
    return hash.value();
}

std::vector<Kept::Signature> Kept::signaturesOf(const Plan& plan, const Needs& needs, const InputHashes& inputs) {
    std::vector<Signature> signatures;
    std::map<Resource, std::uint64_t> written;
    for (const PassRow* row : plan.rows) {
        Signature signature;
        for (const Input input : row->inputs) signature.inputs[input] = inputs[static_cast<std::size_t>(input)];
        for (const std::vector<Resource>* list : {&row->reads, &row->readsIf}) {
            for (const Resource resource : *list) {
                const auto found = written.find(resource);
                signature.resources[resource] = found == written.end() ? 0 : found->second;
            }
        }
        for (const Need need : row->variants) signature.needs.push_back(needs[need]);
        for (const Resource resource : row->writes) {
            written[resource] = ContentHash().add(resource, signature.hash()).value();
        }
        signatures.push_back(std::move(signature));
    }
    return signatures;
}

std::vector<RowDecision> Kept::decide(const Plan& plan, const Needs& needs, const InputHashes& inputs) const {
    const std::vector<Signature> signatures = signaturesOf(plan, needs, inputs);
    std::vector<RowDecision> decisions;
    for (std::size_t i = 0; i < plan.rows.size(); ++i) {
        const auto before = written_.find(plan.rows[i]);
        if (before == written_.end()) {
            decisions.push_back({true, {}});
        } else {
            decisions.push_back({before->second != signatures[i], changesBetween(before->second, signatures[i])});
        }
    }
    runTogether(plan, decisions);
    return decisions;
}

void Kept::note(const Plan& plan, const Needs& needs, const InputHashes& inputs) {
    std::vector<Signature> signatures = signaturesOf(plan, needs, inputs);
    written_.clear();
    for (std::size_t i = 0; i < plan.rows.size(); ++i) written_[plan.rows[i]] = std::move(signatures[i]);
}

std::vector<const PassRow*> Kept::leftOver(const Plan& plan) const {
    std::vector<const PassRow*> rows;
    for (const auto& [row, signature] : written_) {
        if (std::find(plan.rows.begin(), plan.rows.end(), row) == plan.rows.end()) rows.push_back(row);
    }
    return rows;
}

}  // namespace cutis
