#include "renderer/core/error.h"

#include <algorithm>
#include <atomic>
#include <cstdio>

namespace cutis {
namespace {

// One line whatever the parts hold: file names and library messages can carry line breaks.
std::string oneLine(std::string text) {
    std::replace_if(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return text;
}

std::string compose(const std::string& what, const std::string& why, const std::string& where) {
    std::string line = what + ": " + why;
    if (!where.empty()) line += ", " + where;
    return oneLine(std::move(line));
}

void printWarning(const std::string& text) {
    std::fprintf(stderr, "cutis: warning: %s\n", text.c_str());
}

std::atomic<WarningSink> warningSink{printWarning};

}  // namespace

Error::Error(std::string what, std::string why, std::string where)
    : std::runtime_error(compose(what, why, where)),
      subject_(std::move(what)),
      why_(std::move(why)),
      where_(std::move(where)) {}

void warn(const std::string& text) {
    warningSink.load()(oneLine(text));
}

WarningSink setWarningSink(WarningSink sink) {
    return warningSink.exchange(sink ? sink : printWarning);
}

}  // namespace cutis
