// A command line that asks for nothing that cutis could do: exit status 2.
#pragma once

#include <stdexcept>
#include <string>

namespace cutis::app {

class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace cutis::app
