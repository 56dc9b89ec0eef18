// The same scene with more or fewer lights and characters, to measure what each costs.
#pragma once

#include "renderer/scene/scene.h"

namespace cutis {

// The first `count` enabled lights. Beyond the rig's own, copies follow, turned about the scene's vertical
// axis by the golden angle each round; all are dimmed alike, so that the rig's light stays what it is.
// Placements must be resolved. A rig without lights stays as it is.
void repeatLights(Rig& rig, const Scene& scene, int count);

// The first `count` characters. Beyond the scene's own, copies stand behind them, each row a little higher,
// so that heads are seen. A scene without characters stays as it is.
void repeatCharacters(Scene& scene, int count);

}  // namespace cutis
