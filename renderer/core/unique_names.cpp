#include "renderer/core/unique_names.h"

namespace cutis {

std::string UniqueNames::take(const std::string& wanted) {
    if (taken_.insert(wanted).second) return wanted;
    int& n = last_.try_emplace(wanted, 1).first->second;
    for (;;) {
        // One of the file's own may be called so.
        std::string name = wanted + " " + std::to_string(++n);
        if (taken_.insert(name).second) return name;
    }
}

}  // namespace cutis
