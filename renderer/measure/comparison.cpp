#include "renderer/measure/comparison.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "renderer/core/files.h"
#include "renderer/measure/flip.h"
#include "renderer/measure/html.h"
#include "renderer/measure/maps.h"

namespace cutis {
namespace fs = std::filesystem;
namespace {

double lightOf(const Picture& picture) {
    double sum = 0;
    for (std::size_t i = 0; i < picture.values.size(); i += picture.channels) {
        for (int c = 0; c < 3; ++c) {
            if (std::isfinite(picture.values[i + c])) sum += picture.values[i + c];
        }
    }
    return sum;
}

// File names from the names of lights: letters and digits, and distinct.
std::vector<std::string> fileNames(const std::vector<ComparedPicture>& pictures) {
    std::vector<std::string> names;
    std::set<std::string> used;
    for (const ComparedPicture& picture : pictures) {
        std::string name;
        for (char c : picture.name) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '-';
        if (name.empty()) name = "picture";
        std::string distinct = name;
        for (int n = 2; !used.insert(distinct).second; ++n) distinct = name + '-' + std::to_string(n);
        names.push_back(distinct);
    }
    return names;
}

struct Row {
    std::string name, file;
    Difference difference;
};

std::string figuresJson(const std::string& title, const std::string& base, const std::vector<Row>& rows) {
    nlohmann::ordered_json json{{"cutis_compare", 1}, {"title", title}, {"base", base}};
    json["pictures"] = nlohmann::ordered_json::array();
    for (const Row& row : rows) {
        const ErrorFigures& figures = row.difference.figures;
        json["pictures"].push_back({{"name", row.name},
                                    {"file", row.file},
                                    {"rel_l2", figures.relativeL2},
                                    {"rmse", figures.rmse},
                                    {"max", figures.max},
                                    {"p99", figures.p99},
                                    {"bias", figures.bias},
                                    {"flip", row.difference.flip},
                                    {"light_ratio", row.difference.lightRatio},
                                    {"nonfinite", figures.nonfinite}});
    }
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

std::string figuresCsv(const std::vector<Row>& rows) {
    std::string csv = "file,rel_l2,rmse,max,p99,bias,flip,light_ratio,nonfinite\n";
    for (const Row& row : rows) {
        const ErrorFigures& f = row.difference.figures;
        char line[256];
        std::snprintf(line, sizeof line, ",%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%llu\n", f.relativeL2, f.rmse,
                      f.max, f.p99, f.bias, row.difference.flip, row.difference.lightRatio,
                      static_cast<unsigned long long>(f.nonfinite));
        csv += row.file + line;
    }
    return csv;
}

std::string choices(const std::vector<ComparedPicture>& pictures, const std::vector<std::string>& files,
                    std::size_t chosen) {
    std::string options;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        options += "<option value=\"" + files[i] + ".png\"" + (i == chosen ? " selected>" : ">") +
                   escapeHtml(pictures[i].name) + "</option>";
    }
    return options;
}

std::string page(const std::string& title, const std::vector<ComparedPicture>& pictures,
                 const std::vector<std::string>& files, const std::vector<Row>& rows) {
    std::string text = htmlHead(title);
    text +=
        "<style>.wipe{position:relative;display:inline-block;max-width:100%}.wipe "
        "img{display:block;max-width:100%}"
        ".wipe img+img{position:absolute;inset:0;clip-path:inset(0 0 0 50%)}.wipe "
        "input{width:100%}</style>\n";
    text += "<p>Left <select id=a>" + choices(pictures, files, 0) + "</select> right <select id=b>" +
            choices(pictures, files, std::min<std::size_t>(1, pictures.size() - 1)) + "</select></p>\n";
    text += "<div class=wipe><img id=left src=\"" + files.front() + ".png\" alt=left><img id=right src=\"" +
            files[std::min<std::size_t>(1, files.size() - 1)] +
            ".png\" alt=right><input id=at type=range min=0 max=100 value=50 aria-label=wipe></div>\n";
    text +=
        "<script>const $=i=>document.getElementById(i);$('at').oninput=e=>$('right').style.clipPath="
        "`inset(0 0 0 ${e.target.value}%)`;$('a').onchange=e=>$('left').src=e.target.value;"
        "$('b').onchange=e=>$('right').src=e.target.value;</script>\n";
    text += "<p>Against <b>" + escapeHtml(pictures.front().name) +
            "</b>; the figures are in <a href=\"compare.csv\">compare.csv</a> "
            "and <a href=\"compare.json\">compare.json</a>. Maps: black is no difference, white one of the "
            "mean light, or a "
            "perceived difference of 0.5.</p>\n<table>\n<tr><th></th><th>light %</th><th>relative L2 "
            "%</th><th>p99 %</th>"
            "<th>perceived (FLIP)</th><th>picture, difference, perceived difference</th></tr>\n";
    for (const Row& row : rows) {
        const ErrorFigures& f = row.difference.figures;
        text += "<tr><th>" + escapeHtml(row.name) + "</th>" +
                htmlNumber("%.1f", 100 * row.difference.lightRatio) + htmlNumber("%.2f", 100 * f.relativeL2) +
                htmlNumber("%.2f", 100 * f.p99) + htmlNumber("%.4f", row.difference.flip) + "<td>";
        for (const char* kind : {"", "-difference", "-flip"}) {
            text += "<img loading=lazy src=\"" + row.file + kind + ".png\" alt=\"\"> ";
        }
        text += "</td></tr>\n";
    }
    return text + "</table>\n</html>\n";
}

}  // namespace

Difference differenceOf(const ComparedPicture& picture, const ComparedPicture& base) {
    Difference difference;
    std::vector<bool> covered = coveredPixels(base.picture);
    const std::vector<bool> other = coveredPixels(picture.picture);
    for (std::size_t i = 0; i < std::min(covered.size(), other.size()); ++i)
        covered[i] = covered[i] || other[i];
    difference.figures = compareToReference(picture.picture, {.mean = &base.picture}, covered);
    difference.map = relativeErrorMap(picture.picture, base.picture, covered);
    difference.flipMap =
        flipMap(displayLight(picture.picture, picture.exposure), displayLight(base.picture, base.exposure));
    difference.flip = meanOf(difference.flipMap);
    const double whole = lightOf(base.picture);
    difference.lightRatio = whole > 0 ? lightOf(picture.picture) / whole : 0;
    return difference;
}

void writeComparison(const fs::path& folder, const std::string& title,
                     const std::vector<ComparedPicture>& pictures) {
    const std::vector<std::string> files = fileNames(pictures);
    std::vector<Row> rows;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        writeExr(folder / (files[i] + ".exr"), pictures[i].picture);
        writePng(folder / (files[i] + ".png"), pictures[i].picture, pictures[i].exposure);
        if (i == 0) continue;
        Difference difference = differenceOf(pictures[i], pictures.front());
        writeMap(folder / (files[i] + "-difference.png"), difference.map, kWholeDifference);
        writeMap(folder / (files[i] + "-flip.png"), difference.flipMap, kWholeFlip);
        difference.map = difference.flipMap = {};
        rows.push_back({pictures[i].name, files[i], std::move(difference)});
    }
    writeFileAtomically(folder / "compare.json", figuresJson(title, pictures.front().name, rows));
    writeFileAtomically(folder / "compare.csv", figuresCsv(rows));
    writeFileAtomically(folder / "index.html", page(title, pictures, files, rows));
}

}  // namespace cutis
