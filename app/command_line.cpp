#include "app/command_line.h"

#include <CLI/CLI.hpp>

#include "app/usage_error.h"
#include "renderer/core/suggest.h"

namespace cutis::app {
namespace {

// The words of a command line, not yet understood.
struct Words {
    std::vector<std::string> operands;
    std::vector<std::vector<std::string>> values;  // per option of the command; an empty text for each flag
};

[[noreturn]] void refuseUnknown(const std::vector<const Option*>& known, const std::string& argument) {
    const std::string name = argument.substr(0, argument.find('='));
    std::vector<std::string> names = {"--help"};
    for (const Option* option : known) names.emplace_back(option->longName());
    throw UsageError("unknown option " + name + didYouMean(name, names));
}

Words readWords(const std::vector<const Option*>& known, const std::vector<std::string>& arguments) {
    CLI::App parser;
    parser.set_help_flag();  // help is answered before
    parser.allow_extras();   // so that unknown options get our own message
    Words words;
    parser.add_option("operands", words.operands);
    words.values.resize(known.size());
    std::vector<CLI::Option*> parsed;
    for (std::size_t i = 0; i < known.size(); ++i) {
        const std::string names(known[i]->names);
        parsed.push_back(known[i]->isFlag()
                             ? parser.add_flag(names)
                             : parser.add_option(names, words.values[i])->allow_extra_args(false));
    }
    try {
        parser.parse(
            std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // it wants them reversed
    } catch (const CLI::ArgumentMismatch& error) {
        const std::string text = error.what();  // "--size: 1 required TEXT missing"
        throw UsageError(text.substr(0, text.find(':')) + " needs a value");
    } catch (const CLI::ParseError& error) {
        throw UsageError(error.what());
    }
    if (const std::vector<std::string> unknown = parser.remaining(); !unknown.empty())
        refuseUnknown(known, unknown.front());
    for (std::size_t i = 0; i < known.size(); ++i) {
        if (!known[i]->isFlag()) continue;
        // CLI11 would take --flag=false for an answer.
        if (parsed[i]->results() != std::vector<std::string>(parsed[i]->count(), "true"))
            throw UsageError(std::string(known[i]->longName()) + " takes no value");
        words.values[i].resize(parsed[i]->count());
    }
    return words;
}

void checkOperands(const Command& command, const std::vector<std::string>& operands) {
    const std::string what(command.operands);
    if (operands.size() < command.minOperands) throw UsageError(what + " is missing");
    if (operands.size() > command.maxOperands) {
        throw UsageError("'" + operands[command.maxOperands] + "' is too much: " + fullName(command) +
                         " takes " + (what.empty() ? "options only" : what + " and options"));
    }
    for (const std::string& operand : operands)
        if (operand.empty()) throw UsageError(what + " is empty");
}

Request understand(const Command& command, const std::vector<const Option*>& known, const Words& words) {
    checkOperands(command, words.operands);
    Request request;
    request.operands = words.operands;
    for (std::size_t i = 0; i < known.size(); ++i) {
        const std::string name(known[i]->longName());
        if (words.values[i].size() > 1 && !known[i]->repeatable) throw UsageError(name + " is given twice");
        try {
            for (const std::string& value : words.values[i]) known[i]->parse(request, value);
        } catch (const UsageError& error) {
            throw UsageError(name + ' ' + error.what());
        }
    }
    if (command.needsOutput && request.outputs.empty()) throw UsageError("-o FILE is missing");
    checkConflicts(request);
    return request;
}

}  // namespace

Request parseArguments(const Command& command, const std::vector<std::string>& arguments) {
    const std::vector<const Option*> known = optionsOf(command);
    try {
        return understand(command, known, readWords(known, arguments));
    } catch (const UsageError& error) {
        throw UsageError(error.what(), fullName(command));
    }
}

}  // namespace cutis::app
