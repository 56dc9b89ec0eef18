// Arguments to a request.
#pragma once

#include <string>
#include <vector>

#include "app/command.h"

namespace cutis::app {

// Reads the arguments that follow the command's name. Throws UsageError: an unknown option, one that is given
// twice, one without its value or with an impossible one, too few or too many operands, options that exclude
// each other.
Request parseArguments(const Command& command, const std::vector<std::string>& arguments);

}  // namespace cutis::app
