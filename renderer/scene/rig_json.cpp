// The rig format: one description of its keys, which reading and writing share.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <vector>

#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/core/suggest.h"
#include "renderer/scene/light_samples.h"
#include "renderer/scene/rig.h"

namespace cutis {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;
constexpr int kMaxDepth = 8;  // the format nests four deep
constexpr std::array<const char*, 4> kTypeNames = {"directional", "point", "spot", "rect"};

// What a value may be. Upper bounds keep single precision, in which lights are summed, far from overflow.
struct Range {
    double min, max;
    bool openMin = false;  // min itself is not allowed
};
constexpr Range kExposure{-64, 64};
constexpr Range kIntensity{0, 1e12}, kColor{0, 1e6}, kTemperature{kMinTemperature, kMaxTemperature};
constexpr Range kCone{0, std::numbers::pi / 2};
constexpr Range kCoordinate{-1e6, 1e6}, kLength{0, 1e6}, kDistance{0, 1e6, true};
constexpr Range kTurn{-36000, 36000}, kElevation{-90, 90};
constexpr Range kSamples{0, kMaxLightSamples};

// The keys of each object. `fields` is a Reader or a Writer.
template <class Fields>
void describePlacement(Fields& fields) {
    fields.text("subject", &Placement::subject);
    fields.number("azimuth", &Placement::azimuth, kTurn);
    fields.number("elevation", &Placement::elevation, kElevation);
    fields.number("distance", &Placement::distance, kDistance);
}

template <class Fields>
void describeLight(Fields& fields) {
    fields.text("name", &Light::name);
    fields.type("type", &Light::type);
    fields.flag("enabled", &Light::enabled);
    fields.vector("color", &Light::color, kColor);
    fields.number("temperature", &Light::temperature, kTemperature);
    fields.number("intensity", &Light::intensity, kIntensity);
    fields.number("inner_cone_angle", &Light::innerConeAngle, kCone);
    fields.number("outer_cone_angle", &Light::outerConeAngle, kCone);
    fields.number("radius", &Light::radius, kLength);
    fields.vector("size", &Light::size, kLength);
    fields.integer("samples", &Light::samples, kSamples);
    fields.number("range", &Light::range, kLength);
    fields.flag("shadow", &Light::shadow);
    fields.placement("place", &Light::place);
    fields.where("position", &Light::position);
    fields.where("direction", &Light::direction);
}

template <class Fields>
void describeEnvironment(Fields& fields) {
    fields.text("file", &EnvironmentSettings::file);
    fields.flag("enabled", &EnvironmentSettings::enabled);
    fields.number("intensity", &EnvironmentSettings::intensity, kIntensity);
    fields.number("rotation", &EnvironmentSettings::rotation, kTurn);
    fields.integer("shadow_samples", &EnvironmentSettings::shadowSamples, kSamples);
}

template <class Fields>
void describeRig(Fields& fields) {
    fields.version("cutis_rig");
    fields.text("name", &Rig::name);
    fields.number("exposure", &Rig::exposure, kExposure);
    fields.lights("lights", &Rig::lights);
    fields.environment("environment", &Rig::environment);
}

// A value as a message shows it.
std::string shown(const Json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return "a list of " + std::to_string(value.size());
    std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (text.size() > 48) text = text.substr(0, 45) + "...";
    return text;
}

struct Source {
    std::string name;
    std::vector<std::string> unused;  // paths of values that their light's type does not use
};

[[noreturn]] void refuse(const Source& source, const std::string& path, const std::string& why) {
    throw Error("cannot use rig", path.empty() ? why : path + ' ' + why, source.name);
}

double readNumber(const Json& value, const Range& range, const Source& source, const std::string& path) {
    if (!value.is_number()) refuse(source, path, "is " + shown(value) + ", it must be a number");
    const double number = value.get<double>();
    if (!(number >= range.min && number <= range.max) || (range.openMin && number == range.min)) {
        refuse(source, path,
               "is " + shown(value) + ", it must be " + (range.openMin ? "above " : "from ") +
                   shown(Json(range.min)) + (range.openMin ? " and at most " : " to ") +
                   shown(Json(range.max)));
    }
    return number;
}

// Reads one object into `value`, which holds the defaults.
template <class Object>
class Reader {
  public:
    Reader(const Json& json, Object& value, Source& source, std::string path)
        : json_(json), value_(value), source_(source), path_(std::move(path)) {
        if (!json.is_object()) refuse(source, path_.empty() ? "the file" : path_, "must be an object");
    }

    bool has(const char* key) const { return json_.contains(key); }
    std::string at(const char* key) const { return path_.empty() ? key : path_ + '.' + key; }

    void text(const char* key, std::string Object::*member) {
        const Json* json = find(key);
        if (!json) return;
        if (!json->is_string()) refuse(source_, at(key), "is " + shown(*json) + ", it must be a text");
        value_.*member = json->template get<std::string>();
    }
    void flag(const char* key, bool Object::*member) {
        const Json* json = find(key);
        if (!json) return;
        if (!json->is_boolean())
            refuse(source_, at(key), "is " + shown(*json) + ", it must be true or false");
        value_.*member = json->template get<bool>();
    }
    template <class Number>  // double or std::optional<double>
    void number(const char* key, Number Object::*member, const Range& range) {
        if (const Json* json = find(key)) value_.*member = readNumber(*json, range, source_, at(key));
    }
    void integer(const char* key, int Object::*member, const Range& range) {
        const Json* json = find(key);
        if (!json) return;
        if (!json->is_number_integer())
            refuse(source_, at(key), "is " + shown(*json) + ", it must be a whole number");
        value_.*member = static_cast<int>(readNumber(*json, range, source_, at(key)));
    }
    template <class Vector>
    void vector(const char* key, Vector Object::*member, const Range& range) {
        const Json* json = find(key);
        if (!json) return;
        constexpr auto kLengthOf = static_cast<std::size_t>(Vector::length());
        if (!json->is_array() || json->size() != kLengthOf) {
            refuse(source_, at(key),
                   "is " + shown(*json) + ", it must be a list of " + std::to_string(kLengthOf) + " numbers");
        }
        for (std::size_t i = 0; i < kLengthOf; ++i) {
            const std::string element = at(key) + '[' + std::to_string(i) + ']';
            (value_.*member)[static_cast<int>(i)] = readNumber((*json)[i], range, source_, element);
        }
    }
    void where(const char* key, glm::dvec3 Object::*member) { vector(key, member, kCoordinate); }
    void type(const char* key, LightType Object::*member) {
        const Json* json = find(key);
        if (!json) refuse(source_, at(key), "is missing: directional, point, spot or rect");
        for (std::size_t i = 0; json->is_string() && i < kTypeNames.size(); ++i) {
            if (json->template get<std::string>() != kTypeNames[i]) continue;
            value_.*member = static_cast<LightType>(i);
            return;
        }
        refuse(source_, at(key), "is " + shown(*json) + ", it must be directional, point, spot or rect");
    }
    void version(const char* key) {
        const Json* json = find(key);
        if (!json) refuse(source_, at(key), "is missing: this is not a rig file");
        if (*json != kVersion)
            refuse(source_, at(key),
                   "is " + shown(*json) + ", this program reads " + std::to_string(kVersion));
    }
    void placement(const char* key, std::optional<Placement> Object::*member) {
        if (const Json* json = find(key)) {
            Reader<Placement> fields(*json, (value_.*member).emplace(), source_, at(key));
            describePlacement(fields);
            fields.finish();
        }
    }
    void environment(const char* key, EnvironmentSettings Object::*member) {
        if (const Json* json = find(key)) {
            Reader<EnvironmentSettings> fields(*json, value_.*member, source_, at(key));
            describeEnvironment(fields);
            fields.finish();
        }
    }
    void lights(const char* key, std::vector<Light> Object::*member);

    // Every key that no field asked for is an error.
    void finish() const {
        for (const auto& [key, ignored] : json_.items()) {
            if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
            refuse(source_, path_, "unknown key '" + key + "'" + didYouMean(key, known_));
        }
    }

  private:
    const Json* find(const char* key) {
        known_.emplace_back(key);
        const auto found = json_.find(key);
        return found == json_.end() ? nullptr : &*found;
    }

    const Json& json_;
    Object& value_;
    Source& source_;
    std::string path_;
    std::vector<std::string> known_;
};

void noteUnused(const Reader<Light>& fields, const Light& light, Source& source) {
    const bool spot = light.type == LightType::spot, rect = light.type == LightType::rect;
    const bool round = spot || light.type == LightType::point;
    const std::pair<const char*, bool> uses[] = {
        {"inner_cone_angle", spot}, {"outer_cone_angle", spot}, {"radius", round}, {"size", rect},
        {"samples", round || rect}, {"range", round || rect},
    };
    for (const auto& [key, used] : uses)
        if (!used && fields.has(key)) source.unused.push_back(fields.at(key));
}

// What no single key shows.
void checkLight(const Reader<Light>& fields, Light& light, Source& source, const std::string& path) {
    const bool spot = light.type == LightType::spot, rect = light.type == LightType::rect;
    if (light.place) {
        for (const char* key : {"position", "direction"})
            if (fields.has(key)) refuse(source, fields.at(key), "and place exclude each other");
    } else {
        const std::string kind = lightTypeName(light.type);
        if (light.type != LightType::directional && !fields.has("position"))
            refuse(source, path, "needs a place or a position, as every " + kind + " light does");
        if (light.type != LightType::point && !fields.has("direction"))
            refuse(source, path, "needs a place or a direction, as every " + kind + " light does");
    }
    // A direction that is of unit length up to rounding stays as it is, so that saving and loading change
    // nothing.
    const double squared = glm::dot(light.direction, light.direction);
    if (!(squared > 1e-24)) refuse(source, fields.at("direction"), "has no length");
    if (std::abs(squared - 1) > 4e-15) light.direction /= std::sqrt(squared);
    if (light.innerConeAngle > light.outerConeAngle) {
        refuse(source, fields.at("inner_cone_angle"),
               "is " + shown(Json(light.innerConeAngle)) + ", it must not exceed outer_cone_angle, " +
                   shown(Json(light.outerConeAngle)));
    }
    if (spot && light.outerConeAngle == 0) refuse(source, fields.at("outer_cone_angle"), "must be above 0");
    if (rect && !(light.size.x > 0 && light.size.y > 0))
        refuse(source, fields.at("size"), "must hold a width and a height above 0, in metres");
}

template <class Object>
void Reader<Object>::lights(const char* key, std::vector<Light> Object::*member) {
    const Json* json = find(key);
    if (!json) return;
    if (!json->is_array()) refuse(source_, at(key), "is " + shown(*json) + ", it must be a list");
    if (json->size() > kMaxLights) {
        refuse(source_, at(key),
               "has " + std::to_string(json->size()) + " lights, the limit is " + std::to_string(kMaxLights));
    }
    for (std::size_t i = 0; i < json->size(); ++i) {
        const std::string path = at(key) + '[' + std::to_string(i) + ']';
        Light& light = (value_.*member).emplace_back();
        Reader<Light> fields((*json)[i], light, source_, path);
        describeLight(fields);
        fields.finish();
        checkLight(fields, light, source_, path);
        noteUnused(fields, light, source_);
    }
}

// Writes what differs from the defaults.
template <class Object>
class Writer {
  public:
    explicit Writer(const Object& value) : value_(value) {}

    void text(const char* key, std::string Object::*member) { plain(key, member); }
    void flag(const char* key, bool Object::*member) { plain(key, member); }
    void integer(const char* key, int Object::*member, const Range&) { plain(key, member); }
    void number(const char* key, double Object::*member, const Range&) { plain(key, member); }
    void number(const char* key, std::optional<double> Object::*member, const Range&) {
        if (value_.*member) json[key] = *(value_.*member);
    }
    template <class Vector>
    void vector(const char* key, Vector Object::*member, const Range&) {
        if (!same(value_.*member, defaults_.*member)) write(key, value_.*member);
    }
    void where(const char* key, glm::dvec3 Object::*member) {
        if (!value_.place) write(key, value_.*member);
    }
    void type(const char* key, LightType Object::*member) { json[key] = lightTypeName(value_.*member); }
    void version(const char* key) { json[key] = kVersion; }
    void placement(const char* key, std::optional<Placement> Object::*member) {
        if (!(value_.*member)) return;
        Writer<Placement> fields(*(value_.*member));
        describePlacement(fields);
        json[key] = fields.json;
    }
    void environment(const char* key, EnvironmentSettings Object::*member) {
        if (value_.*member == defaults_.*member) return;
        Writer<EnvironmentSettings> fields(value_.*member);
        describeEnvironment(fields);
        json[key] = fields.json;
    }
    void lights(const char* key, std::vector<Light> Object::*member) {
        Json& list = json[key] = Json::array();
        for (const Light& light : value_.*member) {
            Writer<Light> fields(light);
            describeLight(fields);
            list.push_back(fields.json);
        }
    }

    Json json = Json::object();

  private:
    template <class Value>
    void plain(const char* key, Value Object::*member) {
        if (!same(value_.*member, defaults_.*member)) json[key] = value_.*member;
    }
    template <class Vector>
    void write(const char* key, const Vector& vector) {
        Json& list = json[key] = Json::array();
        for (int i = 0; i < Vector::length(); ++i) list.push_back(vector[i]);
    }
    // Bit for bit: -0 is not the default 0.
    template <class Value>
    static bool same(const Value& a, const Value& b) {
        if constexpr (std::is_same_v<Value, std::string>)
            return a == b;
        else
            return std::memcmp(&a, &b, sizeof(Value)) == 0;
    }

    const Object& value_;
    const Object defaults_{};
};

// nlohmann keeps the last of repeated keys without a word, so they are caught while parsing.
Json parseJson(const std::string& text, const Source& source) {
    std::vector<std::set<std::string>> keys;
    const Json::parser_callback_t check = [&](int depth, Json::parse_event_t event, Json& parsed) {
        if (depth > kMaxDepth) refuse(source, "", "it is nested too deep");
        if (event == Json::parse_event_t::object_start) keys.emplace_back();
        if (event == Json::parse_event_t::object_end) keys.pop_back();
        if (event == Json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second)
            refuse(source, "", "key '" + parsed.get<std::string>() + "' is given twice in one object");
        return true;
    };
    try {
        return Json::parse(text, check);
    } catch (const Json::exception& error) {
        // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
        std::string why = error.what();
        if (const std::size_t end = why.find("] "); end != std::string::npos) why.erase(0, end + 2);
        refuse(source, "", why);
    }
}

Rig parse(const std::string& text, Source& source) {
    if (text.size() > kMaxRigBytes)
        refuse(source, "", "it has more than " + std::to_string(kMaxRigBytes) + " bytes");
    const Json json = parseJson(text, source);
    Rig rig;
    Reader<Rig> fields(json, rig, source, "");
    describeRig(fields);
    fields.finish();
    return rig;
}

}  // namespace

const char* lightTypeName(LightType type) {
    return kTypeNames[static_cast<std::size_t>(type)];
}

Rig parseRig(const std::string& json, const std::string& name) {
    Source source{name, {}};
    Rig rig = parse(json, source);
    if (!source.unused.empty()) {
        const std::size_t others = source.unused.size() - 1;
        warn("rig " + name + ": " + source.unused[0] +
             (others ? " and " + std::to_string(others) + " more have" : " has") +
             " no effect on a light of this type");
    }
    return rig;
}

Rig loadRig(const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = readFile(path, kMaxRigBytes);
    return parseRig({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path.string());
}

std::string rigToJson(const Rig& rig) {
    Writer<Rig> fields(rig);
    describeRig(fields);
    Source source{rig.name, {}};
    std::string text;
    try {
        text = fields.json.dump(2) + '\n';
    } catch (const Json::exception&) {
        refuse(source, "", "a name is not UTF-8 text");
    }
    parse(text, source);  // NaN, a negative size and the like: better refused now than when it is loaded
    return text;
}

void saveRig(const Rig& rig, const std::filesystem::path& path) {
    writeFileAtomically(path, rigToJson(rig));
}

}  // namespace cutis
