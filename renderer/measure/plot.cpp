#include "renderer/measure/plot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/measure/html.h"

extern char** environ;

namespace cutis {
namespace fs = std::filesystem;
namespace {

std::string gnuplotText(const std::string& text) {
    std::string quoted = "\"";
    for (char c : text) {
        if (c == '"' || c == '\\') quoted += '\\';
        if (static_cast<unsigned char>(c) >= ' ') quoted += c;
    }
    return quoted + '"';
}

bool plotted(const Measurement& row) {
    return row.failure.empty() && row.gpu.median > 0 && row.diffuse.relativeL2 > 0;
}

// What a block holds: every point; those of the front; those that have room for a name (the front and the
// first).
enum class Points { all, front, named };

std::string dataBlock(const std::vector<Measurement>& rows, Points which) {
    std::vector<const Measurement*> points;
    for (const Measurement& row : rows) {
        const bool wanted =
            which == Points::all || row.paretoFront || (which == Points::named && &row == &rows.front());
        if (plotted(row) && wanted) points.push_back(&row);
    }
    std::sort(points.begin(), points.end(),
              [](const Measurement* a, const Measurement* b) { return a->gpu.median < b->gpu.median; });
    std::string block;
    for (const Measurement* point : points) {
        char line[160];
        const double error = 100 * point->diffuse.relativeL2, spread = 200 * point->diffuse.relativeL2Error;
        std::snprintf(line, sizeof line, "%.9g %.9g %.9g %.9g %.9g %.9g ", point->gpu.median, error,
                      point->gpu.min, point->gpu.max, std::max(error - spread, 0.1 * error), error + spread);
        block += line + gnuplotText(point->setting.name) + '\n';
    }
    return block;
}

// Draws both files, in the folder that it is run in.
std::string script(const std::vector<Measurement>& rows, const ReportInfo& info) {
    std::string text = "$rows << EOD\n" + dataBlock(rows, Points::all) + "EOD\n$front << EOD\n" +
                       dataBlock(rows, Points::front) + "EOD\n$named << EOD\n" +
                       dataBlock(rows, Points::named) + "EOD\n";
    // Axes fit the points: an uncertain one must not squeeze the others.
    double lowest = 1e30, highest = 0;
    for (const Measurement& row : rows) {
        if (!plotted(row)) continue;
        lowest = std::min(lowest, 100 * row.diffuse.relativeL2);
        highest = std::max(highest, 100 * row.diffuse.relativeL2);
    }
    text += "set yrange [" + std::to_string(0.7 * lowest) + ":" + std::to_string(1.5 * highest) + "]\n";
    text += "set logscale xy\nset grid\nset key top right\nset title " + gnuplotText(info.title) +
            " noenhanced\n";
    text += "set xlabel " + gnuplotText("time of a frame on " + info.device + " [ms]") + " noenhanced\n";
    text += "set ylabel 'error of diffuse light: relative L2 [%]'\n";
    text += "set offsets graph 0.05, graph 0.25, 0, 0\n";
    if (info.tolerance) {
        const std::string place = "first " + std::to_string(100 * *info.tolerance);
        text += "set arrow from graph 0, " + place + " to graph 1, " + place + " nohead dashtype 2\n";
    }
    const std::string plot =
        "plot $front using 1:2 with fsteps linewidth 2 linecolor rgb '#c03040' title 'Pareto front', "
        "$rows using 1:2:3:4:5:6 with xyerrorbars pointtype 7 pointsize 0.5 linecolor rgb '#304060' "
        "title 'settings, with the spread of their times and 95 % of their error', "
        "$named using 1:2:7 with labels left offset 0.7,0.4 font ',9' noenhanced notitle\n";
    text +=
        "set terminal svg size 1000,640 dynamic background rgb 'white'\nset output 'measure.svg'\n" + plot;
    return text + "set terminal pngcairo size 1000,640\nset output 'measure.png'\n" + plot;
}

void runGnuplot(const fs::path& folder, const char* file) {
    std::string program = "gnuplot", name = file, place = folder.string();
    char* arguments[] = {program.data(), name.data(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, place.c_str());
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    const int failed = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    int status = 0;
    if (!failed) waitpid(child, &status, 0);
    if (failed) throw Error("cannot plot", std::strerror(failed), "gnuplot");
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw Error("cannot plot", "gnuplot failed", place);
}

std::string htmlRow(std::size_t i, const Measurement& row) {
    std::string text = row.paretoFront ? "<tr class=front>" : "<tr>";
    text += "<th>" + escapeHtml(row.setting.name) + "</th>";
    if (!row.failure.empty())
        return text + "<td colspan=10 class=failed>failed: " + escapeHtml(row.failure) + "</td></tr>\n";
    text += htmlNumber("%.4g", row.gpu.median) + htmlNumber("%.4g", row.gpu.min) +
            htmlNumber("%.4g", row.gpu.max);
    text += htmlNumber("%.1f", static_cast<double>(row.bytesGpu) / 1e6);
    text += htmlNumber("%.2f", 100 * row.diffuse.relativeL2) + htmlNumber("%.2f", 100 * row.diffuse.p99) +
            htmlNumber("%+.2f", 100 * row.diffuse.bias) + htmlNumber("%.2f", 100 * row.picture.relativeL2) +
            htmlNumber("%.4f", row.flip);
    text += "<td><img loading=lazy src=\"" + escapeHtml(pictureFile(i, row).string()) +
            "\" alt=\"picture\"> <img loading=lazy src=\"" + escapeHtml(errorFile(i, row).string()) +
            "\" alt=\"error\"></td></tr>\n";
    return text;
}

}  // namespace

void writePlots(const fs::path& folder, const std::vector<Measurement>& rows, const ReportInfo& info) {
    if (std::none_of(rows.begin(), rows.end(), plotted)) return;
    writeFileAtomically(folder / "measure.gnuplot", script(rows, info));
    runGnuplot(folder, "measure.gnuplot");
}

std::string reportHtml(const std::vector<Measurement>& rows, const ReportInfo& info) {
    std::string page =
        htmlHead(info.title) + "<p>" + std::to_string(info.width) + "×" + std::to_string(info.height) +
        " pixels. Made by <code>" + escapeHtml(info.command) +
        "</code>; the figures are in <a href=\"measure.csv\">measure.csv</a> and "
        "<a href=\"measure.json\">measure.json</a>.</p>\n";
    if (info.kind == ReportKind::sweep)
        page += "<img class=plot src=\"measure.svg\" alt=\"error against run time\">\n";
    for (const std::string& paragraph : reportText(rows, info))
        page += "<p>" + escapeHtml(paragraph) + "</p>\n";
    page +=
        "<table>\n<tr><th>setting</th><th>ms</th><th>min</th><th>max</th><th>MB</th><th>diffuse L2 "
        "%</th><th>p99 %</th>"
        "<th>bias %</th><th>picture L2 %</th><th>FLIP</th><th>picture, and error of diffuse light (white: 20 "
        "% of the mean)</th></tr>\n";
    for (std::size_t i = 0; i < rows.size(); ++i) page += htmlRow(i, rows[i]);
    page += "</table>\n";
    if (info.kind == ReportKind::sweep) page += "<p>Red names: the Pareto front.</p>\n";
    return page + "</html>\n";
}

}  // namespace cutis
