// What `cutis measure` leaves in its folder: measure.csv, measure.json, plots (through gnuplot) and
// index.html, which opens from disk.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/measure/measurement.h"

namespace cutis {

// sweep: settings of one quality or another, plotted as error against time. stability: stiff and extreme
// cases, each against a reference of its own.
enum class ReportKind { sweep, stability };

struct ReportInfo {
    ReportKind kind = ReportKind::sweep;
    std::string title{};    // of the scene and the sweep
    std::string device{};   // that drew the pictures
    std::string command{};  // that makes this report again
    int width = 0, height = 0, repeats = 0;
    std::optional<double> tolerance = {};  // of `diffuse`
};

std::string reportCsv(const std::vector<Measurement>& rows);
std::string reportJson(const std::vector<Measurement>& rows, const ReportInfo& info);
// What the plot shows, in sentences: paragraphs of plain text.
std::vector<std::string> reportText(const std::vector<Measurement>& rows, const ReportInfo& info);

// A row of `cutis measure --sweep stability` as it is printed: case, finite, energy drift (the picture's
// light over that of its reference, less one), error (relative L2 of the picture) and time, in columns; and
// what stands above them.
std::string stabilityLine(const Measurement& row);
std::string stabilityHeading();

// Names of a row's files below the folder: pictures/N-NAME.png and errors/N-NAME.png.
std::filesystem::path pictureFile(std::size_t row, const Measurement& measurement);
std::filesystem::path errorFile(std::size_t row, const Measurement& measurement);

// Writes everything but the pictures. Throws Error, also when gnuplot is missing or fails.
void writeReport(const std::filesystem::path& folder, const std::vector<Measurement>& rows,
                 const ReportInfo& info);

}  // namespace cutis
