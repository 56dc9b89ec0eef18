// Who is in the default scene: scenes/people.json.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

namespace cutis::people {

struct SkinRecipe {
    std::string map;           // a file under MakeHuman's public/data/skins, or "morse" for the 2048² map
    glm::dvec3 gain{1};        // multiplies the map's albedo
    double contrast = 1;       // of the map's variation about its mean colour
    double blotches = 1;       // uneven blood: strength of slow reddish variation
    double freckles = 0;       // pigment spots: share of the spots that show, 0 to 1
    double pores = 1;          // depth of pores
    double wrinkles = 1;       // depth of fine creases
    double lips = 0;           // blood in the lips, beyond what the map has
    double flush = 0;          // blood in cheeks, nose and ears, likewise
    double stubble = 0;        // shaved beard: strength of dark dots on the lower face
    double roughness = 0.3;    // written to extras.skin
    double mix = 0.5;          // written to extras.skin
    double specular = 1;       // written to extras.skin
    double lobeWeight = 0.25;  // of a second lobe, half as rough; written to extras.skin
    double detail = 1;         // pores finer than the maps hold; written to extras.skin
};

struct HairRecipe {
    std::string proxy;      // for example "hair/short02"
    double saturation = 1;  // of the texture; 0 makes it grey
    glm::dvec3 gain{1};     // multiplies the texture then
    double cutoff = 0;      // alpha mask threshold; 0 blends
    double roughness = 0.5;
};

struct ShirtRecipe {
    glm::dvec3 color{0.05};
    double drop = 0;  // lowers the neckline, metres
};

struct PersonRecipe {
    std::string name;
    std::map<std::string, double> targets;  // shape targets and weights, see applyTargets
    SkinRecipe skin;
    std::string iris;                                // a colour of MakeHuman's eyes: brown, blue, …
    std::vector<HairRecipe> hair;                    // scalp hair, brows and lashes
    glm::dvec3 eyes{0, 1.6, 0};                      // where the point between the eyes goes, metres
    double turn = 0;                                 // of the body about +Y, degrees, towards +X
    double headTurn = 0, headNod = 0, headTilt = 0;  // of the head on the neck, degrees
    ShirtRecipe shirt;
    double irisScale = 1;
    glm::dvec3 irisGain{1};  // multiplies the picture's iris: below 1 makes light brown dark
};

struct Recipe {
    int mapSize = 2048;  // texels along a side of a skin map
    int levels = 1;      // of subdivision
    std::string rig;     // file beside the recipe that is copied beside the scene
    std::vector<PersonRecipe> people;
};

// Throws Error with the JSON path of what is wrong.
Recipe readRecipe(const std::filesystem::path& path);

}  // namespace cutis::people
