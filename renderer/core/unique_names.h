// Names that tell things apart.
#pragma once

#include <map>
#include <set>
#include <string>

namespace cutis {

// Hands each name out once: "head", then "head 2", "head 3". Thousands that want the same name take no
// longer.
class UniqueNames {
  public:
    std::string take(const std::string& wanted);

  private:
    std::set<std::string> taken_;
    std::map<std::string, int> last_;  // number that a wanted name was given last
};

}  // namespace cutis
