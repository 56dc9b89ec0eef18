// --help is complete, and so is the page that documents the command line.
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "tests/cli/program.h"

namespace cutis::test {
namespace {

const std::vector<std::vector<std::string>> kCommands = {
    {"view"},        {"render"},      {"plan"},         {"reference"},    {"compare"},       {"measure"},
    {"rig", "list"}, {"rig", "show"}, {"rig", "check"}, {"rig", "export"}, {"skin", "export"}, {"devices"}};

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

std::set<std::string> optionsIn(const std::string& help) {
    std::set<std::string> found;
    const std::regex row("\n  (?:-[a-z], )?(--[a-z-]+)");
    for (std::sregex_iterator match(help.begin(), help.end(), row), end; match != end; ++match)
        found.insert((*match)[1]);
    return found;
}

TEST(Help, NamesEveryCommand) {
    const ProcessResult help = runCutis({"--help"});
    expectSuccess(help);
    for (const auto& command : kCommands)
        EXPECT_NE(help.out.find("\n  " + joined(command)), std::string::npos) << joined(command);
    for (const char* name : {"CUTIS_DATA_DIR", "CUTIS_CACHE_DIR", "CUTIS_DEVICE", "CUTIS_VALIDATION"})
        EXPECT_NE(help.out.find(name), std::string::npos) << name;
    EXPECT_EQ(runCutis({"help"}).out, help.out);
    EXPECT_EQ(runCutis({"-h"}).out, help.out);
}

TEST(Help, EveryCommandHasItsOwn) {
    for (std::vector<std::string> command : kCommands) {
        std::vector<std::string> asked = command;
        asked.push_back("--help");
        const ProcessResult help = runCutis(asked);
        expectSuccess(help);
        EXPECT_NE(help.out.find("Usage: cutis " + joined(command)), std::string::npos) << help.out;
        command.insert(command.begin(), "help");
        EXPECT_EQ(runCutis(command).out, help.out);
    }
}

TEST(Help, WinsOverOtherMistakes) {
    expectSuccess(runCutis({"render", "--nonsense", "--help"}));
    expectSuccess(runCutis({"rig", "--help"}));
}

TEST(Help, RenderHasEveryOption) {
    const std::set<std::string> expected = {"--rig",
                                            "--animation",
                                            "--time",
                                            "--frames",
                                            "--fps",
                                            "--light",
                                            "--env",
                                            "--env-intensity",
                                            "--env-rotation",
                                            "--camera",
                                            "--size",
                                            "--skin",
                                            "--merge",
                                            "--tolerance",
                                            "--chain",
                                            "--taps",
                                            "--irradiance-size",
                                            "--gaussians",
                                            "--device",
                                            "--background",
                                            "--aov",
                                            "--stats",
                                            "--seed",
                                            "--exposure",
                                            "--no-prune",
                                            "--output",
                                            "--help"};
    EXPECT_EQ(optionsIn(runCutis({"render", "--help"}).out), expected);
}

TEST(Help, LinesFitAHundredColumns) {
    for (std::vector<std::string> command : kCommands) {
        command.push_back("--help");
        std::istringstream lines(runCutis(command).out);
        for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
    }
}

// The page lists all commands and options, and no other options.
TEST(Help, CommandLinePageIsComplete) {
    const std::string page = readText(CUTIS_COMMAND_LINE_PAGE);
    std::set<std::string> known = {"--version"};
    for (std::vector<std::string> command : kCommands) {
        EXPECT_NE(page.find("cutis " + joined(command)), std::string::npos) << joined(command);
        command.push_back("--help");
        for (const std::string& option : optionsIn(runCutis(command).out)) {
            known.insert(option);
            EXPECT_NE(page.find(option), std::string::npos) << option;
        }
    }
    const std::regex word("--[a-z][a-z-]*");
    for (std::sregex_iterator match(page.begin(), page.end(), word), end; match != end; ++match)
        EXPECT_TRUE(known.contains(match->str())) << match->str();
}

TEST(Version, IsOneLine) {
    const ProcessResult run = runCutis({"--version"});
    expectSuccess(run);
    EXPECT_TRUE(std::regex_match(run.out, std::regex("cutis [0-9]+\\.[0-9]+\\.[0-9]+\n"))) << run.out;
}

}  // namespace
}  // namespace cutis::test
