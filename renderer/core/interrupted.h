// How long work is told to stop before it is done.
#pragma once

#include <exception>
#include <functional>

namespace cutis {

// Asked from time to time on the thread that works: true when nobody wants the result any more.
using StopAsked = std::function<bool()>;

// Thrown out of work that was asked to stop. It is nobody's error: whoever asked catches it.
class Interrupted : public std::exception {
  public:
    const char* what() const noexcept override { return "interrupted"; }
};

}  // namespace cutis
