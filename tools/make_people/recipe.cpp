#include "recipe.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "renderer/core/error.h"

namespace cutis::people {
namespace {

using nlohmann::json;

// An object whose keys must all be asked for: what is left over at the end is a misspelling.
class Fields {
  public:
    Fields(const json& object, std::string path) : object_(object), path_(std::move(path)) {
        if (!object_.is_object()) throw Error("recipe", "is not an object", path_);
    }
    void finish() const {
        for (const auto& [key, value] : object_.items())
            if (!seen_.contains(key)) throw Error("recipe", "unknown key", path_ + "/" + key);
    }
    bool has(const std::string& key) const { return object_.contains(key); }
    const json& raw(const std::string& key) {
        seen_.insert(key);
        if (!has(key)) throw Error("recipe", "is missing", path_ + "/" + key);
        return object_.at(key);
    }
    template <class T>
    void read(const std::string& key, T& value) {
        seen_.insert(key);
        if (!has(key)) return;
        try {
            object_.at(key).get_to(value);
        } catch (const json::exception&) {
            throw Error("recipe", "has the wrong type", path_ + "/" + key);
        }
    }
    void read(const std::string& key, glm::dvec3& value) {
        std::vector<double> list{value.x, value.y, value.z};
        read(key, list);
        if (list.size() != 3) throw Error("recipe", "is not three numbers", path_ + "/" + key);
        value = {list[0], list[1], list[2]};
    }
    std::string pathTo(const std::string& key) const { return path_ + "/" + key; }

  private:
    const json& object_;
    std::string path_;
    std::set<std::string> seen_;
};

SkinRecipe readSkin(const json& object, const std::string& path) {
    Fields fields(object, path);
    SkinRecipe skin;
    skin.map = fields.raw("map").get<std::string>();
    fields.read("gain", skin.gain);
    fields.read("contrast", skin.contrast);
    fields.read("blotches", skin.blotches);
    fields.read("freckles", skin.freckles);
    fields.read("pores", skin.pores);
    fields.read("wrinkles", skin.wrinkles);
    fields.read("lips", skin.lips);
    fields.read("flush", skin.flush);
    fields.read("stubble", skin.stubble);
    fields.read("roughness", skin.roughness);
    fields.read("mix", skin.mix);
    fields.read("specular", skin.specular);
    fields.read("lobe_weight", skin.lobeWeight);
    fields.read("detail", skin.detail);
    fields.finish();
    return skin;
}

HairRecipe readHair(const json& object, const std::string& path) {
    Fields fields(object, path);
    HairRecipe hair;
    hair.proxy = fields.raw("proxy").get<std::string>();
    fields.read("saturation", hair.saturation);
    fields.read("gain", hair.gain);
    fields.read("cutoff", hair.cutoff);
    fields.read("roughness", hair.roughness);
    fields.finish();
    return hair;
}

ShirtRecipe readShirt(const json& object, const std::string& path) {
    Fields fields(object, path);
    ShirtRecipe shirt;
    fields.read("color", shirt.color);
    fields.read("drop", shirt.drop);
    fields.finish();
    return shirt;
}

PersonRecipe readPerson(const json& object, const std::string& path) {
    Fields fields(object, path);
    PersonRecipe person;
    person.name = fields.raw("name").get<std::string>();
    fields.read("targets", person.targets);
    person.skin = readSkin(fields.raw("skin"), fields.pathTo("skin"));
    person.iris = fields.raw("iris").get<std::string>();
    const json& hair = fields.raw("hair");
    for (std::size_t i = 0; i < hair.size(); ++i)
        person.hair.push_back(readHair(hair.at(i), fields.pathTo("hair/" + std::to_string(i))));
    person.shirt = readShirt(fields.raw("shirt"), fields.pathTo("shirt"));
    fields.read("eyes", person.eyes);
    fields.read("turn", person.turn);
    fields.read("head_turn", person.headTurn);
    fields.read("head_nod", person.headNod);
    fields.read("head_tilt", person.headTilt);
    fields.read("iris_scale", person.irisScale);
    fields.read("iris_gain", person.irisGain);
    fields.finish();
    return person;
}

}  // namespace

Recipe readRecipe(const std::filesystem::path& path) {
    std::ifstream file(path);
    if (!file) throw Error("recipe", "no such file", path.string());
    try {
        const json root = json::parse(file);
        Fields fields(root, path.string() + ":");
        if (fields.raw("cutis_people") != 1) throw Error("recipe", "is not of version 1", path.string());
        Recipe recipe;
        fields.read("map_size", recipe.mapSize);
        fields.read("subdivide", recipe.levels);
        fields.read("rig", recipe.rig);
        if (recipe.mapSize < 64 || recipe.mapSize > 8192)
            throw Error("recipe", "is not 64 to 8192", fields.pathTo("map_size"));
        if (recipe.levels < 1 || recipe.levels > 3)
            throw Error("recipe", "is not 1 to 3", fields.pathTo("subdivide"));
        const json& people = fields.raw("people");
        for (std::size_t i = 0; i < people.size(); ++i)
            recipe.people.push_back(readPerson(people.at(i), fields.pathTo("people/" + std::to_string(i))));
        fields.finish();
        return recipe;
    } catch (const json::exception& e) {
        throw Error("recipe", e.what(), path.string());
    }
}

}  // namespace cutis::people
