#include "app/stats_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "renderer/core/timeline.h"

namespace cutis::app {

using Json = nlohmann::ordered_json;

namespace {

Json timelineJson() {
    const auto rounded = [](double ms) { return std::round(ms * 10) / 10; };
    Json spans = Json::array();
    for (const TimelineEntry& entry : timeline())
        spans.push_back({{"name", entry.name}, {"from_ms", rounded(entry.fromMs)}, {"to_ms", rounded(entry.toMs)}});
    return spans;
}

Json toJson(const RenderStats& stats) {
    Json passes = Json::array(), leftOut = Json::array();
    for (const PassStats& pass : stats.passes)
        passes.push_back(
            {{"name", pass.name}, {"runs", pass.runs}, {"gpu_ms", pass.gpuMs}, {"reason", pass.reason}});
    for (const LeftOut& left : stats.leftOut)
        leftOut.push_back({{"name", left.name}, {"reason", left.reason}});
    return {{"device", stats.device},
                       {"passes", passes},
                       {"left_out", leftOut},
                       {"atlas",
                        {{"width", stats.atlasWidth},
                         {"height", stats.atlasHeight},
                         {"texels_covered", stats.atlasTexelsCovered},
                         {"texels_lit", stats.atlasTexelsLit},
                         {"mm_per_texel", stats.atlasMmPerTexel}}},
                       {"lights", stats.lights},
                       {"light_samples", stats.lightSamples},
                       {"characters", stats.characters},
                       {"gaussians", stats.gaussians},
                       {"bytes_gpu", stats.bytesGpu},
                       {"nonfinite", stats.nonfinite},
                       {"load_ms", stats.loadMs},
                       {"frame_ms", stats.frameMs}};
}

std::string toText(const Json& json) {
    // A device or material name that is not UTF-8 must not cost the report.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

void addRows(Json& rows, const char* when, const std::vector<PassStats>& on, const std::vector<LeftOut>& off,
             bool measured) {
    for (const PassStats& row : on) {
        const bool timed = measured && !row.repeatedMs.empty();
        rows.push_back({{"name", row.name}, {"when", when}, {"on", true}, {"reason", row.reason},
                        {"bytes", row.bytes}, {"ms", timed ? Json(medianMs(row)) : Json()}});
    }
    for (const LeftOut& row : off) {
        rows.push_back({{"name", row.name}, {"when", when}, {"on", false}, {"reason", row.reason},
                        {"bytes", 0}, {"ms", nullptr}});
    }
}

}  // namespace

double medianMs(const PassStats& row) {
    std::vector<double> times = row.repeatedMs;
    if (times.size() > 1) times.erase(times.begin());
    if (times.empty()) return 0;
    std::sort(times.begin(), times.end());
    return 0.5 * (times[(times.size() - 1) / 2] + times[times.size() / 2]);
}

std::string statsToJson(const RenderStats& stats) {
    Json json = toJson(stats);
    json["timeline"] = timelineJson();
    return toText(json);
}

std::string planToJson(const RenderStats& stats, bool measured) {
    Json json = toJson(stats);
    Json rows = Json::array();
    addRows(rows, "before the frame", stats.prepared, stats.notPrepared, measured);
    addRows(rows, "frame", stats.passes, stats.leftOut, measured);
    json["rows"] = rows;
    return toText(json);
}

}  // namespace cutis::app
