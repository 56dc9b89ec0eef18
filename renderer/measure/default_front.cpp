// What settings of the default scene were measured at: `cutis measure default --camera group --budget 60s
// --repeats 5` (docs/measure.md): rows from fast to close, in an order that holds on a GPU and on a CPU alike.
#include "renderer/measure/front.h"

namespace cutis {

MeasuredFront defaultFront() {
    const Setting draft{
        .name = "draft", .irradianceSize = 512, .gaussians = 3, .lightMapSize = 512, .areaSamples = 1};
    MeasuredFront front{.device = "NVIDIA H200", .width = 480, .height = 270, .settings = {}};
    // Each error with its standard error added.
    front.settings = {{draft, 0.0776, 19.3},
                      {{.name = "light maps 256", .lightMapSize = 256}, 0.0592, 25.4},
                      {{.name = "default"}, 0.0469, 42.2},
                      {{.name = "atlas 1024", .irradianceSize = 1024}, 0.0442, 42.3}};
    return front;
}

}  // namespace cutis
