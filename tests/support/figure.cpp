#include "tests/support/figure.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace cutis::test {

namespace {

std::string propertyName(std::string name) {  // XML attributes take no blanks, slashes or dots
    for (char& c : name)
        if (!isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
}

}  // namespace

void expectAtMost(const std::string& name, double value, double limit) {
    std::printf("figure: %s %.6g %.6g\n", name.c_str(), value, limit);
    ::testing::Test::RecordProperty(propertyName(name), std::to_string(value));
    if (!(value <= limit)) ADD_FAILURE() << name << " is " << value << ", above its limit " << limit;
}

void reportFigure(const std::string& name, double value) {
    std::printf("figure: %s %.6g none\n", name.c_str(), value);
    ::testing::Test::RecordProperty(propertyName(name), std::to_string(value));
}

}  // namespace cutis::test
