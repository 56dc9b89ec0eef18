// What a run spends its time on, from the start of the process: spans of time with names, in the order in which they ended.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cutis {

struct TimelineEntry {
    std::string name;
    double fromMs = 0, toMs = 0;  // since the process started
};

// Lasts from its construction to its destruction. For any thread.
class TimeSpan {
  public:
    explicit TimeSpan(std::string_view name);
    ~TimeSpan();
    TimeSpan(const TimeSpan&) = delete;
    TimeSpan& operator=(const TimeSpan&) = delete;

  private:
    std::string name_;
    double fromMs_;
};

// Called first thing in main: what came before is a span too, "libraries".
void noteMain();

// All spans that have ended, at most the first few thousand: a viewer runs for days.
std::vector<TimelineEntry> timeline();

// Milliseconds since the process started: the loading of its libraries is in them, to a hundredth of a second.
double processMs();

}  // namespace cutis
