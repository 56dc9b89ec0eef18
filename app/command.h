// What the program can do: one row a command.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/options.h"

namespace cutis::app {

struct Command {
    std::string_view group;     // "rig" of `cutis rig show`; empty for a command of one word
    std::string_view name;      // "render"; "show" of `cutis rig show`
    std::string_view operands;  // as help shows them: "SCENE"
    std::size_t minOperands, maxOperands;
    CommandSet options;                  // which rows of the option table it takes
    bool needsOutput;                    // -o must be given
    std::string_view summary;            // one line
    std::string_view details;            // paragraphs for its own help, each a line
    int (*run)(const Request& request);  // returns the exit status
    bool explainsRigs = false;           // its help lists the fields of a rig file
};

std::string fullName(const Command& command);  // "rig show"
std::vector<const Option*> optionsOf(const Command& command);

// In the order in which `cutis --help` prints them.
std::span<const Command> commands();

int runView(const Request& request);
int runRender(const Request& request);
int runPlan(const Request& request);
int runReference(const Request& request);
int runCompare(const Request& request);
int runMeasure(const Request& request);
int runRigList(const Request& request);
int runRigShow(const Request& request);
int runRigCheck(const Request& request);
int runRigExport(const Request& request);
int runSkinExport(const Request& request);
int runDevices(const Request& request);

}  // namespace cutis::app
