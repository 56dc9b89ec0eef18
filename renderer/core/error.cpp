#include "renderer/core/error.h"

#include <atomic>
#include <cstdio>

namespace cutis {
namespace {

// One line of plain text whatever the parts hold: names in files and messages of libraries can carry line
// breaks, and escape sequences that command a terminal (ECMA-48: controls below 0x20, 0x7f, and U+0080 to
// U+009F).
std::string oneLine(std::string text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<unsigned char>(text[i]);
        const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0;
        if (c < 0x20 || c == 0x7f) text[i] = ' ';
        if (c == 0xc2 && next >= 0x80 && next <= 0x9f) text[i] = text[i + 1] = ' ';
    }
    // Its beginning says what failed, its end where.
    constexpr std::size_t kLongest = 4000;
    if (text.size() > kLongest) text.replace(kLongest / 2, text.size() - kLongest, " … ");
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
