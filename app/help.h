// The texts of --help, made from the command table and the option table.
#pragma once

#include <string>

#include "app/command.h"

namespace cutis::app {

// The program's: all commands.
std::string programHelp();
// A command's own: all of its options.
std::string commandHelp(const Command& command);

}  // namespace cutis::app
