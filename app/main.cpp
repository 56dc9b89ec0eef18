// The program `cutis`: finds the command, runs it, and turns whatever goes wrong into one line and an exit
// status.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

#include "app/command.h"
#include "app/command_line.h"
#include "app/help.h"
#include "app/signals.h"
#include "app/usage_error.h"
#include "renderer/core/error.h"
#include "renderer/core/suggest.h"
#include "renderer/core/timeline.h"

namespace cutis::app {

std::span<const Command> commands() {
    static constexpr Command kCommands[] = {
        {"", "view", "[SCENE]", 0, 1, kViewer, false,
         "The viewer: a window in which rigs are made and compared",
         "SCENE is a .gltf or .glb file; without one it is 'default', the scene of real people that set-up "
         "installs. "
         "The word view may be left out. F1 in the window lists its hot keys.",
         runView},
        {"", "render", "SCENE", 1, 1, kRender, true, "One picture of a glTF scene",
         "SCENE is a .gltf or .glb file, or 'default' for the scene of real people that set-up installs.",
         runRender},
        {"", "plan", "SCENE", 1, 1, kPlan, false, "What a picture would run, what it leaves out and why",
         "Lists each row of the pass table for the picture that cutis render would make: on or off, why, and "
         "the GPU "
         "memory that it writes or works in. Nothing is drawn unless --measure asks for times.",
         runPlan},
        {"", "reference", "SCENE", 1, 1, kReference, true, "The same picture evaluated exactly, on the CPU",
         "Takes what cutis render takes; what only concerns the GPU has no effect. It works until the "
         "standard error is "
         "below --error or --budget is spent, and prints the error that it reached. Interrupted (Ctrl-C) or "
         "asked again "
         "for less error, it goes on from where it was: its state lies in the cache.",
         runReference},
        {"", "compare", "SCENE", 1, 1, kCompare, true,
         "Two rigs side by side, or each light alone against all",
         "Writes pictures, difference maps, figures and index.html, which opens from disk. With --a and --b "
         "it compares "
         "those rigs; without, each light of the rig and the environment alone with all of them together.",
         runCompare},
        {"", "measure", "SCENE", 1, 1, kMeasure, true, "Error against run time over a sweep of settings",
         "Renders the scene with each setting of a sweep and compares every picture with the exact one "
         "(cutis "
         "reference, kept in the cache). Writes measure.csv, measure.json, plots and index.html, which opens "
         "from disk.",
         runMeasure},
        {"rig", "list", "", 0, 0, kNoCommand, false, "The built-in lighting presets", "", runRigList},
        {"rig", "show", "RIG", 1, 1, kNoCommand, false,
         "A rig file or preset as a rig file, on standard output",
         "Values that are at their defaults are left out.", runRigShow},
        {"rig", "check", "RIG", 1, 1, kRigCheck, false,
         "Says whether a rig file is right and its environment is there",
         "With --scene also whether the subjects of its lights are there.", runRigCheck, true},
        {"rig", "export", "RIG|SCENE", 1, 1, kRigExport, true, "Rigs to glTF lights, and back",
         "A rig file or preset becomes the lights of a .glb file, placed by the heads of --scene where the "
         "rig asks "
         "for that; the lights of a glTF scene become a rig file. glTF has no area lights: a rect light "
         "becomes a "
         "spot of equal candela on its axis, and a radius is lost.",
         runRigExport},
        {"skin", "export", "SCENE", 1, 1, kSkinExport, true, "A copy of a glTF scene that says which materials are skin",
         "Writes what --skin, a skin file of the viewer, names or hints say into material.extras.skin; all else of the "
         "file stays as it is.",
         runSkinExport},
        {"", "devices", "", 0, 0, kNoCommand, false, "The GPUs of this machine, and which one cutis takes",
         "", runDevices},
    };
    return kCommands;
}

std::string fullName(const Command& command) {
    return std::string(command.group) + (command.group.empty() ? "" : " ") + std::string(command.name);
}

std::vector<const Option*> optionsOf(const Command& command) {
    std::vector<const Option*> result;
    for (const Option& option : options())
        if (option.commands & command.options) result.push_back(&option);
    return result;
}

namespace {

bool isHelp(const std::string& argument) {
    return argument == "--help" || argument == "-h";
}

std::string_view firstWord(const Command& command) {
    return command.group.empty() ? command.name : command.group;
}

// The rows that these words name: one command, or all of a group such as `rig`. Throws UsageError when there
// is none.
std::vector<const Command*> commandsNamed(const std::vector<std::string>& words) {
    std::vector<const Command*> found;
    std::vector<std::string> names = {"help"};
    for (const Command& command : commands()) {
        names.emplace_back(firstWord(command));
        if (firstWord(command) == words[0]) found.push_back(&command);
    }
    if (found.empty()) throw UsageError("unknown command '" + words[0] + "'" + didYouMean(words[0], names));
    if (found[0]->group.empty() || words.size() < 2 || words[1].starts_with('-')) return found;
    names.clear();
    for (const Command* command : found) {
        if (command->name == words[1]) return {command};
        names.emplace_back(command->name);
    }
    throw UsageError("unknown command '" + words[0] + ' ' + words[1] + "'" + didYouMean(words[1], names));
}

int showHelp(const std::vector<std::string>& words) {
    std::string text;
    if (words.empty() || isHelp(words[0])) {
        text = programHelp();
    } else {
        for (const Command* command : commandsNamed(words))
            text += (text.empty() ? "" : "\n\n") + commandHelp(*command);
    }
    std::fputs(text.c_str(), stdout);
    return 0;
}

// `cutis`, `cutis SCENE` and `cutis --option` open the viewer. A word is a scene when it is a file's name or the
// default scene; any other is a mistyped command.
bool asksForViewer(const std::vector<std::string>& arguments) {
    if (arguments.empty()) return true;
    const std::string& first = arguments[0];
    if (isHelp(first) || first == "--version") return false;
    const std::filesystem::path path = first;
    return first.starts_with('-') || first == "default" || path.extension() == ".gltf" || path.extension() == ".glb";
}

int runProgram(std::vector<std::string> arguments) {
    if (asksForViewer(arguments)) arguments.insert(arguments.begin(), "view");
    if (isHelp(arguments[0]) || arguments[0] == "help") {
        arguments.erase(arguments.begin());
        return showHelp(arguments);
    }
    if (arguments[0] == "--version") {
        std::puts("cutis " CUTIS_VERSION);
        return 0;
    }
    const std::vector<const Command*> found = commandsNamed(arguments);
    for (const std::string& argument : arguments) {
        if (argument == "--") break;
        if (isHelp(argument)) return showHelp(arguments);
    }
    if (found.size() > 1) {
        std::string list;
        for (const Command* command : found) list += (list.empty() ? "" : ", ") + std::string(command->name);
        throw UsageError("cutis " + arguments[0] + " needs one of " + list, arguments[0]);
    }
    const Command& command = *found[0];
    arguments.erase(arguments.begin(), arguments.begin() + (command.group.empty() ? 1 : 2));
    return command.run(parseArguments(command, arguments));
}

// Prints errors as the one line that they are.
int reportErrors(const std::vector<std::string>& arguments) {
    try {
        const int status = runProgram(arguments);
        if (std::fflush(stdout) != 0 || std::ferror(stdout))
            throw Error("cannot write", std::strerror(errno), "standard output");
        return status;
    } catch (const UsageError& error) {
        const std::string command = error.command().empty() ? "" : error.command() + ' ';
        const Error line("usage", error.what(), "see cutis " + command + "--help");
        std::fprintf(stderr, "cutis: error: %s\n", line.what());
        return 2;
    } catch (const Error& error) {
        std::fprintf(stderr, "cutis: error: %s\n", error.what());
    } catch (const std::bad_alloc&) {
        std::fputs("cutis: error: out of memory: the scene or the picture is too large for this machine\n",
                   stderr);
    } catch (const std::exception& error) {
        const Error line("internal", error.what());
        std::fprintf(stderr, "cutis: error: %s\n", line.what());
    }
    return 1;
}

}  // namespace
}  // namespace cutis::app

int main(int argc, char** argv) {
    cutis::noteMain();
    cutis::app::endCleanlyOnSignals();
    return cutis::app::reportErrors({argv + 1, argv + argc});
}
