// The pages and plots of a report.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/measure/report.h"

namespace cutis {

// measure.svg and measure.png: error against run time on logarithmic axes, the Pareto front marked. Nothing
// is plotted where no setting gave a picture. Throws Error when gnuplot is missing or fails.
void writePlots(const std::filesystem::path& folder, const std::vector<Measurement>& rows,
                const ReportInfo& info);

// The page that shows the plot, the text, and a row for each setting with its picture and error map.
std::string reportHtml(const std::vector<Measurement>& rows, const ReportInfo& info);

}  // namespace cutis
