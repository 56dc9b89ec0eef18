// What is wrong with a JSON text, found without building anything of it.
#pragma once

#include <cstddef>
#include <string>

namespace cutis {

// Why a text is no JSON document for us: a syntax error with its place, more than `maxDepth` objects and
// lists within one another, a key that an object has twice, or more than `maxKeys` keys in an object. Empty
// where there is no fault.
//
// To be asked before nlohmann::json parses a text of strangers: that keeps the last of repeated keys without
// a word, and an ordered_json takes time that grows with the square of the number of keys.
std::string findJsonFault(const std::string& text, std::size_t maxDepth, std::size_t maxKeys);

}  // namespace cutis
