#include "app/help.h"

#include <algorithm>

#include "renderer/scene/fields.h"

namespace cutis::app {
namespace {

constexpr std::size_t kHelpWidth = 100, kHelpColumn = 26;

// Appends text from the current column on, wrapped and indented to `column`.
void appendWrapped(std::string& help, std::size_t column, std::string_view text) {
    std::size_t at = column;
    bool first = true;
    while (!text.empty()) {
        const std::size_t space = std::min(text.find(' '), text.size());
        const std::string_view word = text.substr(0, space);
        text.remove_prefix(std::min(space + 1, text.size()));
        if (!first && at + 1 + word.size() > kHelpWidth) {
            help += '\n' + std::string(column, ' ');
            at = column;
            first = true;
        }
        if (!first) help += ' ', ++at;
        help += word;
        at += word.size();
        first = false;
    }
    help += '\n';
}

void appendRow(std::string& help, const std::string& left, std::string_view right) {
    help += "  " + left;
    if (left.size() + 4 > kHelpColumn) {
        help += '\n' + std::string(kHelpColumn, ' ');
    } else {
        help += std::string(kHelpColumn - 2 - left.size(), ' ');
    }
    appendWrapped(help, kHelpColumn, right);
}

void appendFields(std::string& help, const std::vector<FieldGroup>& groups) {
    for (const FieldGroup& group : groups) {
        help += "\nKeys of a rig file: " + std::string(group.object) + "\n";
        for (const Field& field : group.fields)
            appendRow(help, field.key, std::string(field.help) + " (" + field.allowed() + ")");
    }
}

std::string withOperands(const Command& command) {
    std::string text = fullName(command);
    if (!command.operands.empty()) text += ' ' + std::string(command.operands);
    if (command.needsOutput) text += " -o FILE";
    return text;
}

}  // namespace

std::string programHelp() {
    std::string help =
        "cutis lights human skin: glTF scenes with several characters, rigs of several lights, HDR "
        "environments.\n\n"
        "Usage: cutis COMMAND [operands] [options]\n\nCommands:\n";
    for (const Command& command : commands()) appendRow(help, withOperands(command), command.summary);
    appendRow(help, "help [COMMAND]", "This text, or all about a command, as cutis COMMAND --help");
    help += "\nOptions:\n";
    appendRow(help, "--help, -h", "This text");
    appendRow(help, "--version", "The version of this program");
    help += "\nEnvironment:\n";
    appendRow(help, "CUTIS_DATA_DIR", "Where the default scene lies");
    appendRow(help, "CUTIS_CACHE_DIR", "Where results worth keeping lie (default: ~/.cache/cutis)");
    appendRow(help, "CUTIS_DEVICE", "What --device is when it is not given");
    appendRow(help, "CUTIS_VALIDATION",
              "1 runs with Vulkan's validation layers; what they say makes the run fail");
    help += "\nExit status: 0; 1 it failed, with one line on stderr; 2 the command line is wrong.\n";
    return help;
}

std::string commandHelp(const Command& command) {
    const std::vector<const Option*> known = optionsOf(command);
    std::string help;
    appendWrapped(help, 0, command.summary);
    help += "\nUsage: cutis " + withOperands(command) + (known.empty() ? "" : " [options]") + "\n";
    std::string_view rest = command.details;
    if (!rest.empty()) help += '\n';
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        appendWrapped(help, 0, rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    std::string_view group;
    for (const Option* option : known) {
        if (option->group != group) {
            group = option->group;
            help += '\n';
            help += group;
            help += ":\n";
        }
        std::string names(option->names);
        if (!option->isFlag()) names.append(" ").append(option->metavar);
        appendRow(help, names, option->help);
    }
    if (command.explainsRigs) appendFields(help, rigFields());
    help += known.empty() ? "\nOptions:\n" : "\nHelp:\n";
    appendRow(help, "--help, -h", "This text");
    return help;
}

}  // namespace cutis::app
