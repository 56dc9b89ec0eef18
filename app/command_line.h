// argv to a command and its request, and the texts of --help.
#pragma once

#include <string>
#include <vector>

#include "app/command.h"

namespace cutis::app {

// Reads the arguments that follow the command's name. Throws UsageError: an unknown option, one that is given
// twice, one without its value or with an impossible one, too few or too many operands, options that exclude
// each other.
Request parseArguments(const Command& command, const std::vector<std::string>& arguments);

// The program's help, and a command's own, which lists all of its options.
std::string programHelp();
std::string commandHelp(const Command& command);

}  // namespace cutis::app
