// Typed reads of a JSON document whose errors name the file and the JSON path.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cutis {

// What a document is called in messages: `cutis: error: WHAT: why, FILE, path`.
struct JsonSource {
    std::string what;  // "cannot load scene"
    std::string file;
};

// One value of a document, with its path. Cheap to copy; the document and its source must outlive it.
class JsonView {
  public:
    JsonView(const nlohmann::json& value, const JsonSource& source, std::string path = {})
        : value_(&value), source_(&source), path_(std::move(path)) {}

    const std::string& path() const { return path_; }
    const nlohmann::json& json() const { return *value_; }
    [[noreturn]] void fail(const std::string& why) const;
    std::string where() const;  // "FILE, path"

    // Members of an object. `member` fails when there is none of that name, `find` is empty then.
    JsonView member(const char* key) const;
    std::optional<JsonView> find(const char* key) const;
    std::vector<std::pair<std::string, JsonView>> members() const;
    void allowOnly(std::initializer_list<const char*> keys) const;  // fails at the first other key

    // Elements of an array.
    std::size_t size() const;
    JsonView element(std::size_t index) const;
    std::vector<JsonView> elements() const;

    // This value as a type; fails when it is not of that type.
    bool boolean() const;
    double number() const;  // finite
    std::int64_t integer() const;
    std::string string() const;
    // An array of exactly (count) or any number (0) of finite numbers.
    std::vector<double> numbers(std::size_t count = 0) const;
    // A whole number in [0, limit).
    std::size_t index(std::size_t limit, const char* ofWhat) const;

    // The member of that name, or the fallback where there is none. `natural`: a whole number, not negative.
    std::size_t natural(const char* key, std::size_t fallback) const;
    bool boolean(const char* key, bool fallback) const;
    double number(const char* key, double fallback) const;
    std::string string(const char* key, const std::string& fallback = {}) const;

  private:
    const nlohmann::json* value_;
    const JsonSource* source_;
    std::string path_;
};

}  // namespace cutis
