#include "renderer/measure/report.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/measure/plot.h"

namespace cutis {
namespace fs = std::filesystem;
namespace {

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

std::string percent(double ratio) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f %%", 100 * ratio);
    return text;
}

std::string milliseconds(double value) {
    char text[32];
    std::snprintf(text, sizeof text, value < 10 ? "%.2f ms" : "%.0f ms", value);
    return text;
}

std::string csvText(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

struct FigureColumn {
    const char* name;
    double (*value)(const Measurement&);
};

const std::vector<FigureColumn>& figureColumns() {
    static const std::vector<FigureColumn> columns{
        {"gpu_ms", [](const Measurement& m) { return m.gpu.median; }},
        {"gpu_ms_min", [](const Measurement& m) { return m.gpu.min; }},
        {"gpu_ms_max", [](const Measurement& m) { return m.gpu.max; }},
        {"bytes_gpu", [](const Measurement& m) { return static_cast<double>(m.bytesGpu); }},
        {"atlas_size", [](const Measurement& m) { return static_cast<double>(m.atlasSize); }},
        {"light_samples", [](const Measurement& m) { return static_cast<double>(m.lightSamples); }},
        {"rel_l2", [](const Measurement& m) { return m.picture.relativeL2; }},
        {"rel_l2_stderr", [](const Measurement& m) { return m.picture.relativeL2Error; }},
        {"rmse", [](const Measurement& m) { return m.picture.rmse; }},
        {"max", [](const Measurement& m) { return m.picture.max; }},
        {"p99", [](const Measurement& m) { return m.picture.p99; }},
        {"bias", [](const Measurement& m) { return m.picture.bias; }},
        {"diffuse_rel_l2", [](const Measurement& m) { return m.diffuse.relativeL2; }},
        {"diffuse_rel_l2_stderr", [](const Measurement& m) { return m.diffuse.relativeL2Error; }},
        {"diffuse_rmse", [](const Measurement& m) { return m.diffuse.rmse; }},
        {"diffuse_max", [](const Measurement& m) { return m.diffuse.max; }},
        {"diffuse_p99", [](const Measurement& m) { return m.diffuse.p99; }},
        {"diffuse_bias", [](const Measurement& m) { return m.diffuse.bias; }},
        {"flip", [](const Measurement& m) { return m.flip; }},
        {"nonfinite",
         [](const Measurement& m) {
             return static_cast<double>(m.nonfinite + m.picture.nonfinite + m.diffuse.nonfinite);
         }},
        {"ref_stderr", [](const Measurement& m) { return m.referenceError; }},
    };
    return columns;
}

std::vector<std::string> passNames(const std::vector<Measurement>& rows) {
    std::set<std::string> names;
    for (const Measurement& row : rows)
        for (const auto& [name, timing] : row.passes) names.insert(name);
    return {names.begin(), names.end()};
}

fs::path rowFile(const char* folder, std::size_t row, const Measurement& measurement) {
    std::string name;
    for (char c : measurement.setting.name) {
        const auto byte = static_cast<unsigned char>(c);
        name += std::isalnum(byte) ? static_cast<char>(std::tolower(byte)) : '-';
    }
    return fs::path(folder) / (std::to_string(row) + '-' + name + ".png");
}

const Measurement* leastRow(const std::vector<Measurement>& rows,
                            bool (*better)(const Measurement&, const Measurement&)) {
    const Measurement* found = nullptr;
    for (const Measurement& row : rows)
        if (row.failure.empty() && (!found || better(row, *found))) found = &row;
    return found;
}

// What the rows of extreme cases say together.
std::vector<std::string> stabilityText(const std::vector<Measurement>& rows, const ReportInfo& info) {
    std::string failed;
    for (const Measurement& row : rows)
        if (!row.failure.empty()) failed += (failed.empty() ? "" : ", ") + ("'" + row.setting.name + "'");
    std::vector<std::string> text{std::to_string(rows.size()) + " cases, " +
                                  (failed.empty() ? "none failed." : "failed: " + failed + ".")};
    const Measurement* drifted = leastRow(rows, [](const Measurement& a, const Measurement& b) {
        return std::abs(a.picture.bias) > std::abs(b.picture.bias);
    });
    const Measurement* farthest = leastRow(rows, [](const Measurement& a, const Measurement& b) {
        return a.picture.relativeL2 > b.picture.relativeL2;
    });
    if (!drifted) return text;
    text.push_back("Energy drift is the picture's light over that of its reference, less one; error is relative L2 of the "
                   "picture. Times are on " + info.device + ".");
    text.push_back("The largest drift is " + percent(drifted->picture.bias) + ", of '" + drifted->setting.name +
                   "', the largest error " + percent(farthest->picture.relativeL2) + ", of '" +
                   farthest->setting.name + "'.");
    return text;
}

}  // namespace

std::string stabilityHeading() {
    char line[160];
    std::snprintf(line, sizeof line, "%-30s %-6s %12s %22s %12s", "case", "finite", "energy drift", "error", "time");
    return line;
}

std::string stabilityLine(const Measurement& row) {
    char line[160];
    if (!row.failure.empty()) {
        std::snprintf(line, sizeof line, "%-30s %-6s", row.setting.name.c_str(), row.nonfinite > 0 ? "no" : "-");
        return std::string(line) + " failed: " + row.failure;
    }
    std::snprintf(line, sizeof line, "%-30s %-6s %+10.2f %% %22s %12s", row.setting.name.c_str(), "yes",
                  100 * row.picture.bias,
                  (percent(row.picture.relativeL2) + " ± " + percent(row.picture.relativeL2Error)).c_str(),
                  milliseconds(row.gpu.median).c_str());
    return line;
}

fs::path pictureFile(std::size_t row, const Measurement& measurement) {
    return rowFile("pictures", row, measurement);
}
fs::path errorFile(std::size_t row, const Measurement& measurement) {
    return rowFile("errors", row, measurement);
}

std::string reportCsv(const std::vector<Measurement>& rows) {
    const std::vector<std::string> passes = passNames(rows);
    std::string csv = "name";
    for (const SettingField& field : settingFields()) csv += std::string(",") + field.name;
    for (const FigureColumn& column : figureColumns()) csv += std::string(",") + column.name;
    for (const std::string& pass : passes) csv += ",ms_" + pass;
    csv += ",pareto,failure\n";
    for (const Measurement& row : rows) {
        csv += csvText(row.setting.name);
        for (const SettingField& field : settingFields()) csv += ',' + csvText(field.text(row.setting));
        // A failed row has no figures: empty cells, not zeros.
        for (const FigureColumn& column : figureColumns())
            csv += row.failure.empty() ? ',' + number(column.value(row)) : ",";
        for (const std::string& pass : passes) {
            const auto timing = row.passes.find(pass);
            csv += timing != row.passes.end() ? ',' + number(timing->second.median) : ",";
        }
        csv += std::string(row.paretoFront ? ",1," : ",0,") + csvText(row.failure) + '\n';
    }
    return csv;
}

std::string reportJson(const std::vector<Measurement>& rows, const ReportInfo& info) {
    using Json = nlohmann::ordered_json;
    Json settings = Json::array();
    for (const Measurement& row : rows) {
        Json entry{{"name", row.setting.name}};
        for (const SettingField& field : settingFields()) entry[field.name] = field.text(row.setting);
        if (!row.failure.empty()) {
            entry["failure"] = row.failure;
        } else {
            for (const FigureColumn& column : figureColumns()) entry[column.name] = column.value(row);
            for (const auto& [name, timing] : row.passes)
                entry["passes"][name] = {{"gpu_ms", timing.median}, {"min", timing.min}, {"max", timing.max}};
            entry["pareto"] = row.paretoFront;
        }
        settings.push_back(entry);
    }
    Json json{{"cutis_measure", 1},      {"title", info.title}, {"device", info.device},
              {"command", info.command}, {"width", info.width}, {"height", info.height},
              {"repeats", info.repeats}, {"settings", settings}};
    if (info.tolerance) {
        const Measurement* cheapest = cheapestWithin(rows, *info.tolerance);
        json["tolerance"] = *info.tolerance;
        json["cheapest_within_tolerance"] = cheapest ? Json(cheapest->setting.name) : Json();
    }
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::vector<std::string> reportText(const std::vector<Measurement>& rows, const ReportInfo& info) {
    if (info.kind == ReportKind::stability) return stabilityText(rows, info);
    std::vector<std::string> text;
    const Measurement* closest = leastRow(rows, [](const Measurement& a, const Measurement& b) {
        return a.diffuse.relativeL2 < b.diffuse.relativeL2;
    });
    const Measurement* fastest = leastRow(
        rows, [](const Measurement& a, const Measurement& b) { return a.gpu.median < b.gpu.median; });
    if (!closest) return {"No setting gave a picture."};
    const auto said = [](const Measurement& row) {
        return "'" + row.setting.name + "' (" + percent(row.diffuse.relativeL2) + " in " +
               milliseconds(row.gpu.median) + ")";
    };
    text.push_back(
        "Errors are relative L2 of skin's diffuse light over covered pixels, against a reference whose own "
        "standard error is " +
        percent(closest->referenceError) + ". Times are medians over the passes of " +
        std::to_string(info.repeats) + " runs after one that warms up, on " + info.device + ".");
    text.push_back("The closest setting is " + said(*closest) + ", the fastest " + said(*fastest) + ".");
    const Measurement& base = rows.front();
    if (base.failure.empty()) {
        std::string changes;
        for (const Measurement& row : rows) {
            if (&row == &base || !row.failure.empty() || !row.setting.sameSubject(base.setting)) continue;
            const double noise = 2 * (row.diffuse.relativeL2Error + base.diffuse.relativeL2Error);
            if (row.diffuse.relativeL2 < base.diffuse.relativeL2 - noise &&
                row.gpu.median < 2 * base.gpu.median)
                changes += (changes.empty() ? "" : ", ") + said(row);
        }
        text.push_back("'" + base.setting.name + "' stands at " + percent(base.diffuse.relativeL2) + " ± " +
                       percent(2 * base.diffuse.relativeL2Error) + " in " + milliseconds(base.gpu.median) +
                       "; " +
                       (changes.empty() ? "nothing tried is clearly closer within twice its time."
                                        : "clearly closer within twice its time: " + changes + "."));
    }
    std::string front;
    for (const Measurement& row : rows)
        if (row.paretoFront) front += (front.empty() ? "" : ", ") + ("'" + row.setting.name + "'");
    text.push_back("On the Pareto front, where nothing else is both faster and closer: " + front + ".");
    if (info.tolerance) {
        const Measurement* cheapest = cheapestWithin(rows, *info.tolerance);
        text.push_back(cheapest ? "The cheapest setting within " + percent(*info.tolerance) + " is " +
                                      said(*cheapest) + "."
                                : "No setting is within " + percent(*info.tolerance) + ".");
    }
    return text;
}

void writeReport(const fs::path& folder, const std::vector<Measurement>& rows, const ReportInfo& info) {
    writeFileAtomically(folder / "measure.csv", reportCsv(rows));
    writeFileAtomically(folder / "measure.json", reportJson(rows, info));
    writeFileAtomically(folder / "index.html", reportHtml(rows, info));
    if (info.kind == ReportKind::sweep) writePlots(folder, rows, info);
}

}  // namespace cutis
