#include "renderer/skin/profile.h"

namespace cutis::skin {

Profile threeLayerProfile() {
    return {{{0.0064, {0.233, 0.455, 0.649}},
             {0.0484, {0.100, 0.336, 0.344}},
             {0.187, {0.118, 0.198, 0}},
             {0.567, {0.113, 0.007, 0.007}},
             {1.99, {0.358, 0.004, 0}},
             {7.41, {0.078, 0, 0}}}};
}

}  // namespace cutis::skin
