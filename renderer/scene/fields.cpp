#include "renderer/scene/fields.h"

#include <cstdio>

namespace cutis {

std::string Field::allowed() const {
    char range[96] = "";
    if (max > min)
        std::snprintf(range, sizeof range, "%s%g to %g%s%s", openMin ? "above " : "", min, max,
                      *unit ? " " : "", unit);
    if (!*of) return range;
    return *range ? std::string(of) + ", " + range : of;
}

}  // namespace cutis
