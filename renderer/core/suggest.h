// "did you mean": the known name nearest to a mistyped one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cutis {

// The candidate with the smallest edit distance to `word`, ignoring case; empty when none is near enough to
// be a misspelling (more than a third of the word's letters, at least one, differ).
std::string nearestName(std::string_view word, const std::vector<std::string>& candidates);

// " (did you mean 'NAME'?)", or empty.
std::string didYouMean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace cutis
