#include "renderer/scene/skin_file.h"

#include <nlohmann/json.hpp>

#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/core/suggest.h"
#include "renderer/scene/json_fault.h"
#include "renderer/scene/json_view.h"
#include "renderer/scene/skin_material.h"

namespace cutis {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kMaxBytes = 16 << 20;
constexpr const char *kVersion = "cutis_skin", *kMaterials = "materials", *kName = "name", *kSkin = "skin";

nlohmann::json parse(const std::filesystem::path& file, const JsonSource& source) {
    const std::vector<std::byte> bytes = readFile(file, kMaxBytes);
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    constexpr std::size_t kMaxDepth = 16, kMaxKeys = 100;
    if (const std::string why = findJsonFault(text, kMaxDepth, kMaxKeys); !why.empty())
        throw Error(source.what, "not JSON: " + why, source.file);
    return nlohmann::json::parse(text);
}

}  // namespace

bool isSkinFile(const std::string& name) {
    return name.ends_with(".json");
}

std::vector<std::optional<SkinMaterial>> loadSkinFile(const std::filesystem::path& file, const Scene& scene) {
    const JsonSource source{"cannot load skin", file.string()};
    const nlohmann::json json = parse(file, source);
    const JsonView root(json, source);
    root.allowOnly({kVersion, kMaterials});
    const JsonView version = root.member(kVersion);
    if (version.integer() != 1) version.fail("must be 1, the version of the format");
    std::vector<std::optional<SkinMaterial>> skin;
    std::vector<bool> named(scene.materials.size(), false);
    std::vector<std::string> names;
    for (const Material& material : scene.materials) {
        skin.push_back(material.skin);
        names.push_back(material.name);
    }
    for (const JsonView& entry : root.member(kMaterials).elements()) {
        entry.allowOnly({kName, kSkin});
        const std::string name = entry.member(kName).string();
        std::size_t place = 0;
        while (place < names.size() && (named[place] || names[place] != name)) ++place;
        if (place == names.size())
            entry.member(kName).fail("the scene has no such material" + didYouMean(name, names));
        named[place] = true;
        skin[place] = parseSkinMaterial(entry.member(kSkin));
    }
    return skin;
}

std::string skinFileText(const std::vector<std::optional<SkinMaterial>>& skin, const Scene& scene) {
    Json materials = Json::array();
    for (std::size_t i = 0; i < skin.size() && i < scene.materials.size(); ++i) {
        materials.push_back({{kName, scene.materials[i].name},
                             {kSkin, skin[i] ? Json(skinMaterialJson(*skin[i])) : Json(false)}});
    }
    return Json{{kVersion, 1}, {kMaterials, materials}}.dump(2) + '\n';
}

}  // namespace cutis
