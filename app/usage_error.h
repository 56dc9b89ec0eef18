// A command line that asks for nothing that cutis could do: exit status 2.
#pragma once

#include <stdexcept>
#include <string>

namespace cutis::app {

class UsageError : public std::runtime_error {
  public:
    // `command` is the one whose help says more; empty for the program's.
    explicit UsageError(const std::string& why, std::string command = {})
        : std::runtime_error(why), command_(std::move(command)) {}

    const std::string& command() const { return command_; }

  private:
    std::string command_;
};

}  // namespace cutis::app
