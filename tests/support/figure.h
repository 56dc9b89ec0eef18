// One way to state a measured figure and its limit, on stdout and in the test's XML.
#pragma once

#include <string>

namespace cutis::test {

// Prints `figure: NAME VALUE LIMIT`, records it as a property of the running test, and fails that test when
// the value is above the limit or is not a number.
void expectAtMost(const std::string& name, double value, double limit);

// Prints and records a figure that no limit is stated for.
void reportFigure(const std::string& name, double value);

}  // namespace cutis::test
