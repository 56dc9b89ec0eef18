// Pieces of the pages that reports consist of.
#pragma once

#include <string>

namespace cutis {

std::string escapeHtml(const std::string& text);
// The beginning of a page, up to and including its heading; the caller ends it with </html>.
std::string htmlHead(const std::string& title);
// A table's cell with a number in printf's format.
std::string htmlNumber(const char* format, double value);

}  // namespace cutis
