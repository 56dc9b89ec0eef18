#include "renderer/frame/ahead.h"

#include <map>

#include "renderer/core/timeline.h"

namespace cutis {

Ahead::Ahead(FrameContext& frame, const Plan& plan, const std::vector<RowDecision>& decisions)
    : atRest_(frame.geometry) {
    std::vector<const PassRow*> rows;
    for (std::size_t i = 0; i < plan.rows.size(); ++i) {
        if (plan.rows[i]->ahead && decisions[i].run) rows.push_back(plan.rows[i]);
    }
    for (const PassRow* row : rows) {
        if (row->forget) row->forget(frame);
    }
    std::map<Resource, std::shared_future<void>> written;
    for (const PassRow* row : rows) {
        std::vector<std::shared_future<void>> before;
        for (const Resource resource : row->reads) {
            if (const auto found = written.find(resource); found != written.end())
                before.push_back(found->second);
        }
        work_.push_back(std::async(std::launch::async, [row, before, &frame] {
                            for (const std::shared_future<void>& earlier : before) earlier.get();
                            const TimeSpan span(std::string(row->name) + " (CPU)");
                            row->ahead(frame);
                        }).share());
        for (const Resource resource : row->writes) written[resource] = work_.back();
    }
}

void Ahead::wait() {
    for (const std::shared_future<void>& each : work_) each.wait();
    for (const std::shared_future<void>& each : work_) each.get();
}

}  // namespace cutis
