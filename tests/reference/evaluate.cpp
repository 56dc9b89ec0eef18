#include "tests/reference/evaluate.h"

#include "renderer/scene/camera.h"
#include "renderer/scene/characters.h"

namespace cutis::test {

reference::Result evaluate(const ReferenceJob& job) {
    Scene scene = job.scene;
    prepareScene(scene);
    Environment environment;
    reference::Input input;
    input.scene = &scene;
    input.rig.lights = job.lights;
    if (job.environment) {
        environment.width = job.environment->width;
        environment.height = job.environment->height;
        for (std::size_t i = 0; i < job.environment->values.size(); i += 3) {
            const float* v = &job.environment->values[i];
            environment.radiance.emplace_back(v[0], v[1], v[2]);
        }
        input.environment = &environment;
    }
    input.camera = cameraFor(scene, "", double(job.width) / job.height);
    return reference::evaluate(input, {.width = job.width,
                                       .height = job.height,
                                       .seed = job.seed,
                                       .error = 0,
                                       .maxPasses = job.passes,
                                       .resume = false,
                                       .aovs = job.aovs});
}

void ErrorCover::add(double value, double exact, double standardError) {
    if (!(standardError > 0)) return;
    const double z = (value - exact) / standardError;
    sum_ += z, squares_ += z * z, ++count_;
}

}  // namespace cutis::test
