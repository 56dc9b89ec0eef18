#include "tests/env/environments.h"

#include <map>

#include "renderer/scene/environment.h"

namespace cutis::test {

const Environment& blenderEnvironment(const std::string& name) {
    static std::map<std::string, Environment> loaded;
    const auto found = loaded.find(name);
    if (found != loaded.end()) return found->second;
    const std::string folder = "/usr/share/blender/datafiles/studiolights/world/";
    return loaded.emplace(name, loadEnvironment(folder + name + ".exr")).first->second;
}

Environment uniformEnvironment(int width, int height) {
    return {"uniform", width, height, std::vector<glm::vec3>(std::size_t(width) * height, glm::vec3(1))};
}

Environment sunnyEnvironment(int width, int height) {
    Environment environment{"sunny", width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            environment.radiance.emplace_back(0.2f + float(x) / width, 0.5f, 1.2f - float(y) / height);
    environment.radiance[std::size_t(height / 4) * width + width / 3] = glm::vec3(30000, 28000, 25000);
    return environment;
}

}  // namespace cutis::test
