// What a long run is doing, for someone who watches.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace cutis::app {

// Shows the current stage and the seconds since the start in one line on stderr, which it clears at the end.
// Silent where stderr is no terminal and for the first second.
class Progress {
  public:
    Progress();
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void setStage(const std::string& stage);

  private:
    void show();

    std::mutex mutex_;
    std::condition_variable changed_;
    std::string stage_;
    bool ended_ = false;
    std::thread thread_;
};

}  // namespace cutis::app
