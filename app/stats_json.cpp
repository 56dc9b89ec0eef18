#include "app/stats_json.h"

#include <nlohmann/json.hpp>

namespace cutis::app {

std::string statsToJson(const RenderStats& stats) {
    using Json = nlohmann::ordered_json;
    Json passes = Json::array(), leftOut = Json::array();
    for (const PassStats& pass : stats.passes)
        passes.push_back(
            {{"name", pass.name}, {"runs", pass.runs}, {"gpu_ms", pass.gpuMs}, {"reason", pass.reason}});
    for (const LeftOut& left : stats.leftOut)
        leftOut.push_back({{"name", left.name}, {"reason", left.reason}});
    const Json json = {{"device", stats.device},
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
    // A device or material name that is not UTF-8 must not cost the report.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace cutis::app
