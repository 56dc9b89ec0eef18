#include "renderer/core/warn_once.h"

#include <mutex>
#include <unordered_set>

#include "renderer/core/error.h"

namespace cutis {

void warnOnce(const std::string& text) {
    static std::mutex mutex;
    static std::unordered_set<std::string> said;
    {
        const std::lock_guard lock(mutex);
        if (!said.insert(text).second) return;
    }
    warn(text);
}

}  // namespace cutis
