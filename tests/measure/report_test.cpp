#include "renderer/measure/report.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "renderer/core/files.h"
#include "renderer/measure/plot.h"

namespace cutis {
namespace {

Measurement row(const std::string& name, double ms, double error) {
    Measurement m;
    m.setting.name = name;
    m.gpu = {ms, ms * 0.9, ms * 1.1};
    m.passes["diffusion"] = m.gpu;
    m.diffuse.relativeL2 = error;
    m.diffuse.relativeL2Error = error * 0.01;
    return m;
}

std::vector<Measurement> rows() {
    std::vector<Measurement> all{row("default", 10, 0.02), row("fast, \"cheap\"", 2, 0.06),
                                 row("worse", 12, 0.03), row("fine", 40, 0.01)};
    Measurement failed;
    failed.setting.name = "too large";
    failed.failure = "out of memory";
    all.push_back(failed);
    markParetoFront(all);
    return all;
}

TEST(Timing, IsTheMedianAndTheSpread) {
    const Timing odd = timingOf({5, 1, 3}), even = timingOf({4, 1, 2, 9});
    EXPECT_EQ(odd.median, 3);
    EXPECT_EQ(odd.min, 1);
    EXPECT_EQ(odd.max, 5);
    EXPECT_EQ(even.median, 3);
    EXPECT_EQ(timingOf({}).median, 0);
}

TEST(Report, MarksTheParetoFrontAndFindsTheCheapest) {
    const std::vector<Measurement> all = rows();
    std::vector<bool> front;
    for (const Measurement& m : all) front.push_back(m.paretoFront);
    EXPECT_EQ(front, (std::vector<bool>{true, true, false, true, false}));
    EXPECT_EQ(cheapestWithin(all, 0.1)->setting.name, "fast, \"cheap\"");
    EXPECT_EQ(cheapestWithin(all, 0.05)->setting.name, "default");
    // 2 % ± 2 · 0.02 % is not surely within 2 %.
    EXPECT_EQ(cheapestWithin(all, 0.02)->setting.name, "fine");
    EXPECT_EQ(cheapestWithin(all, 0.001), nullptr);
}

TEST(Report, CsvHasARowForEverySettingAndAsManyCellsInEach) {
    const std::string csv = reportCsv(rows());
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 6);
    EXPECT_NE(csv.find("\"fast, \"\"cheap\"\"\""), std::string::npos);
    for (const char* column :
         {"name,irradiance_size,", ",gpu_ms,", ",bytes_gpu,", ",rel_l2,", ",rmse,", ",max,", ",p99,",
          ",bias,", ",flip,", ",nonfinite,", ",ref_stderr,", ",ms_diffusion,", ",pareto,failure"})
        EXPECT_NE(csv.find(column), std::string::npos) << column;
    const std::string header = csv.substr(0, csv.find('\n')),
                      last = csv.substr(csv.rfind('\n', csv.size() - 2) + 1);
    EXPECT_EQ(std::count(last.begin(), last.end(), ','), std::count(header.begin(), header.end(), ','));
    EXPECT_NE(last.find("too large"), std::string::npos);
    EXPECT_NE(last.find("out of memory"), std::string::npos);
}

TEST(Report, JsonNamesTheCheapestWithinTheTolerance) {
    const ReportInfo info{.title = "t",
                          .device = "d",
                          .command = "c",
                          .width = 4,
                          .height = 3,
                          .repeats = 3,
                          .tolerance = 0.05};
    const auto json = nlohmann::json::parse(reportJson(rows(), info));
    EXPECT_EQ(json["cheapest_within_tolerance"], "default");
    EXPECT_EQ(json["settings"].size(), 5u);
    EXPECT_EQ(json["settings"][4]["failure"], "out of memory");
    EXPECT_EQ(json["settings"][0]["passes"]["diffusion"]["gpu_ms"], 10);
}

TEST(Report, IsWrittenWithItsPlots) {
    const auto folder = std::filesystem::temp_directory_path() / ("cutis-report-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    const ReportInfo info{.title = "heads <b>",
                          .device = "a \"device\"",
                          .command = "cutis measure",
                          .width = 4,
                          .height = 3,
                          .repeats = 3};
    writeReport(folder, rows(), info);
    for (const char* name : {"measure.csv", "measure.json", "measure.gnuplot", "measure.svg", "measure.png", "index.html"})
        EXPECT_GT(std::filesystem::file_size(folder / name), 500u) << name;
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 6)
        << "nothing else is left behind";
    const auto svg = readFile(folder / "measure.svg");
    const std::string text(reinterpret_cast<const char*>(svg.data()), svg.size());
    for (const char* name : {"default", "fine"})
        EXPECT_NE(text.find(name), std::string::npos) << name;
    const std::string page = reportHtml(rows(), info);
    EXPECT_NE(page.find("heads &lt;b&gt;"), std::string::npos);
    EXPECT_NE(page.find("failed: out of memory"), std::string::npos);
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace cutis
