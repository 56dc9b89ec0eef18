// What settings of the default scene were measured at: `cutis measure default --camera group --budget 60s
// --repeats 9` (docs/measure.md): rows from fast to close, in an order that holds on a GPU and on a CPU alike.
#include "renderer/measure/front.h"

namespace cutis {

MeasuredFront defaultFront() {
    const Setting draft{
        .name = "draft", .irradianceSize = 512, .gaussians = 3, .lightMapSize = 512, .areaSamples = 1};
    MeasuredFront front{.device = "NVIDIA H200", .width = 480, .height = 270, .settings = {}};
    front.settings = {{draft, 0.0836, 19.3},
                      {{.name = "light maps 256", .lightMapSize = 256}, 0.0600, 24.8},
                      {{.name = "default"}, 0.0388, 57.8},
                      {{.name = "light maps 2048", .lightMapSize = 2048}, 0.0330, 92.7}};
    return front;
}

}  // namespace cutis
