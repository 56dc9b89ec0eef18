// The rig format: one description of its keys, which reading and writing share.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <vector>

#include "renderer/core/error.h"
#include "renderer/core/files.h"
#include "renderer/core/suggest.h"
#include "renderer/scene/fields.h"
#include "renderer/scene/json_fault.h"
#include "renderer/scene/light_samples.h"
#include "renderer/scene/rig.h"

namespace cutis {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;
constexpr std::size_t kMaxDepth = 8;   // the format nests four deep
constexpr std::size_t kMaxKeys = 100;  // of an object; the format has sixteen at the most
constexpr std::array<const char*, 4> kTypeNames = {"directional", "point", "spot", "rect"};

// The keys of each object. `object` is a Reader, a Writer or a Lister.
template <class Object>
void describePlacement(Object& object) {
    object.text(fields::kSubject, &Placement::subject);
    object.number(fields::kAzimuth, &Placement::azimuth);
    object.number(fields::kElevation, &Placement::elevation);
    object.number(fields::kDistance, &Placement::distance);
}

template <class Object>
void describeLight(Object& object) {
    object.text(fields::kLightName, &Light::name);
    object.type(fields::kType, &Light::type);
    object.flag(fields::kEnabled, &Light::enabled);
    object.vector(fields::kColor, &Light::color);
    object.number(fields::kTemperature, &Light::temperature);
    object.number(fields::kIntensity, &Light::intensity);
    object.number(fields::kInnerCone, &Light::innerConeAngle);
    object.number(fields::kOuterCone, &Light::outerConeAngle);
    object.number(fields::kRadius, &Light::radius);
    object.vector(fields::kSize, &Light::size);
    object.integer(fields::kSamples, &Light::samples);
    object.number(fields::kRange, &Light::range);
    object.flag(fields::kShadow, &Light::shadow);
    object.placement(fields::kPlace, &Light::place);
    object.where(fields::kPosition, &Light::position);
    object.where(fields::kDirection, &Light::direction);
}

template <class Object>
void describeEnvironment(Object& object) {
    object.text(fields::kFile, &EnvironmentSettings::file);
    object.flag(fields::kEnvironmentEnabled, &EnvironmentSettings::enabled);
    object.number(fields::kEnvironmentIntensity, &EnvironmentSettings::intensity);
    object.number(fields::kRotation, &EnvironmentSettings::rotation);
    object.integer(fields::kShadowSamples, &EnvironmentSettings::shadowSamples);
    object.flag(fields::kSunRemoved, &EnvironmentSettings::sunRemoved);
}

template <class Object>
void describeRig(Object& object) {
    object.version(fields::kVersion);
    object.text(fields::kRigName, &Rig::name);
    object.number(fields::kExposure, &Rig::exposure);
    object.lights(fields::kLights, &Rig::lights);
    object.environment(fields::kEnvironment, &Rig::environment);
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

double readNumber(const Json& value, const Field& range, const Source& source, const std::string& path) {
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

    void text(const Field& field, std::string Object::*member) {
        const Json* json = find(field.key);
        if (!json) return;
        if (!json->is_string()) refuse(source_, at(field.key), "is " + shown(*json) + ", it must be a text");
        value_.*member = json->template get<std::string>();
    }
    void flag(const Field& field, bool Object::*member) {
        const Json* json = find(field.key);
        if (!json) return;
        if (!json->is_boolean())
            refuse(source_, at(field.key), "is " + shown(*json) + ", it must be true or false");
        value_.*member = json->template get<bool>();
    }
    template <class Number>  // double or std::optional<double>
    void number(const Field& field, Number Object::*member) {
        if (const Json* json = find(field.key))
            value_.*member = readNumber(*json, field, source_, at(field.key));
    }
    void integer(const Field& field, int Object::*member) {
        const Json* json = find(field.key);
        if (!json) return;
        if (!json->is_number_integer())
            refuse(source_, at(field.key), "is " + shown(*json) + ", it must be a whole number");
        value_.*member = static_cast<int>(readNumber(*json, field, source_, at(field.key)));
    }
    template <class Vector>
    void vector(const Field& field, Vector Object::*member) {
        const Json* json = find(field.key);
        if (!json) return;
        constexpr auto kLengthOf = static_cast<std::size_t>(Vector::length());
        if (!json->is_array() || json->size() != kLengthOf) {
            refuse(source_, at(field.key),
                   "is " + shown(*json) + ", it must be a list of " + std::to_string(kLengthOf) + " numbers");
        }
        for (std::size_t i = 0; i < kLengthOf; ++i) {
            const std::string element = at(field.key) + '[' + std::to_string(i) + ']';
            (value_.*member)[static_cast<int>(i)] = readNumber((*json)[i], field, source_, element);
        }
    }
    void where(const Field& field, glm::dvec3 Object::*member) { vector(field, member); }
    void type(const Field& field, LightType Object::*member) {
        const Json* json = find(field.key);
        if (!json) refuse(source_, at(field.key), "is missing: directional, point, spot or rect");
        for (std::size_t i = 0; json->is_string() && i < kTypeNames.size(); ++i) {
            if (json->template get<std::string>() != kTypeNames[i]) continue;
            value_.*member = static_cast<LightType>(i);
            return;
        }
        refuse(source_, at(field.key),
               "is " + shown(*json) + ", it must be directional, point, spot or rect");
    }
    void version(const Field& field) {
        const Json* json = find(field.key);
        if (!json) refuse(source_, at(field.key), "is missing: this is not a rig file");
        if (*json != kVersion)
            refuse(source_, at(field.key),
                   "is " + shown(*json) + ", this program reads " + std::to_string(kVersion));
    }
    void placement(const Field& field, std::optional<Placement> Object::*member) {
        if (const Json* json = find(field.key)) {
            Reader<Placement> fields(*json, (value_.*member).emplace(), source_, at(field.key));
            describePlacement(fields);
            fields.finish();
        }
    }
    void environment(const Field& field, EnvironmentSettings Object::*member) {
        if (const Json* json = find(field.key)) {
            Reader<EnvironmentSettings> fields(*json, value_.*member, source_, at(field.key));
            describeEnvironment(fields);
            fields.finish();
        }
    }
    void lights(const Field& field, std::vector<Light> Object::*member);

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
void Reader<Object>::lights(const Field& field, std::vector<Light> Object::*member) {
    const Json* json = find(field.key);
    if (!json) return;
    if (!json->is_array()) refuse(source_, at(field.key), "is " + shown(*json) + ", it must be a list");
    if (json->size() > kMaxLights) {
        refuse(source_, at(field.key),
               "has " + std::to_string(json->size()) + " lights, the limit is " + std::to_string(kMaxLights));
    }
    for (std::size_t i = 0; i < json->size(); ++i) {
        const std::string path = at(field.key) + '[' + std::to_string(i) + ']';
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

    void text(const Field& field, std::string Object::*member) { plain(field.key, member); }
    void flag(const Field& field, bool Object::*member) { plain(field.key, member); }
    void integer(const Field& field, int Object::*member) { plain(field.key, member); }
    void number(const Field& field, double Object::*member) { plain(field.key, member); }
    void number(const Field& field, std::optional<double> Object::*member) {
        if (value_.*member) json[field.key] = *(value_.*member);
    }
    template <class Vector>
    void vector(const Field& field, Vector Object::*member) {
        if (!same(value_.*member, defaults_.*member)) write(field.key, value_.*member);
    }
    void where(const Field& field, glm::dvec3 Object::*member) {
        if (!value_.place) write(field.key, value_.*member);
    }
    void type(const Field& field, LightType Object::*member) {
        json[field.key] = lightTypeName(value_.*member);
    }
    void version(const Field& field) { json[field.key] = kVersion; }
    void placement(const Field& field, std::optional<Placement> Object::*member) {
        if (!(value_.*member)) return;
        Writer<Placement> fields(*(value_.*member));
        describePlacement(fields);
        json[field.key] = fields.json;
    }
    void environment(const Field& field, EnvironmentSettings Object::*member) {
        if (value_.*member == defaults_.*member) return;
        Writer<EnvironmentSettings> fields(value_.*member);
        describeEnvironment(fields);
        json[field.key] = fields.json;
    }
    void lights(const Field& field, std::vector<Light> Object::*member) {
        Json& list = json[field.key] = Json::array();
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

// Notes the fields of an object.
struct Lister {
    std::vector<Field> list;

    template <class Member>
    void text(const Field& field, Member) {
        list.push_back(field);
    }
    template <class Member>
    void flag(const Field& field, Member) {
        list.push_back(field);
    }
    template <class Member>
    void number(const Field& field, Member) {
        list.push_back(field);
    }
    template <class Member>
    void integer(const Field& field, Member) {
        list.push_back(field);
    }
    template <class Member>
    void vector(const Field& field, Member) {
        list.push_back(field);
    }
    template <class Member>
    void where(const Field& field, Member) {
        list.push_back(field);
    }
    template <class Member>
    void type(const Field& field, Member) {
        list.push_back(field);
    }
    template <class Member>
    void placement(const Field& field, Member) {
        list.push_back(field);
    }
    template <class Member>
    void environment(const Field& field, Member) {
        list.push_back(field);
    }
    template <class Member>
    void lights(const Field& field, Member) {
        list.push_back(field);
    }
    void version(const Field& field) { list.push_back(field); }
};

Rig parse(const std::string& text, Source& source) {
    if (text.size() > kMaxRigBytes)
        refuse(source, "", "it has more than " + std::to_string(kMaxRigBytes) + " bytes");
    const std::string why = findJsonFault(text, kMaxDepth, kMaxKeys);
    if (!why.empty()) refuse(source, "", why);
    const Json json = Json::parse(text);
    Rig rig;
    Reader<Rig> fields(json, rig, source, "");
    describeRig(fields);
    fields.finish();
    return rig;
}

}  // namespace

std::vector<FieldGroup> rigFields() {
    Lister rig, light, place, environment;
    describeRig(rig);
    describeLight(light);
    describePlacement(place);
    describeEnvironment(environment);
    return {{"A rig", rig.list},
            {"A light", light.list},
            {"A place", place.list},
            {"The environment", environment.list}};
}

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
