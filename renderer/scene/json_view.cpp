#include "renderer/scene/json_view.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "renderer/core/error.h"

namespace cutis {

std::string JsonView::where() const {
    return path_.empty() ? source_->file : source_->file + ", " + path_;
}

void JsonView::fail(const std::string& why) const {
    throw Error(source_->what, why, where());
}

std::optional<JsonView> JsonView::find(const char* key) const {
    if (!value_->is_object()) fail("must be an object");
    const auto it = value_->find(key);
    if (it == value_->end()) return std::nullopt;
    return JsonView(*it, *source_, path_.empty() ? key : path_ + "." + key);
}

JsonView JsonView::member(const char* key) const {
    const std::optional<JsonView> found = find(key);
    if (!found) fail("\"" + std::string(key) + "\" is missing");
    return *found;
}

std::vector<std::pair<std::string, JsonView>> JsonView::members() const {
    if (!value_->is_object()) fail("must be an object");
    std::vector<std::pair<std::string, JsonView>> all;
    for (const auto& [key, value] : value_->items()) {
        all.emplace_back(key, JsonView(value, *source_, path_.empty() ? key : path_ + "." + key));
    }
    return all;
}

void JsonView::allowOnly(std::initializer_list<const char*> keys) const {
    for (const auto& [key, value] : members()) {
        if (std::ranges::find(keys, std::string_view(key)) == keys.end()) value.fail("unknown key");
    }
}

std::size_t JsonView::size() const {
    if (!value_->is_array()) fail("must be an array");
    return value_->size();
}

JsonView JsonView::element(std::size_t i) const {
    if (i >= size()) fail("has no element " + std::to_string(i));
    return JsonView((*value_)[i], *source_, path_ + "[" + std::to_string(i) + "]");
}

std::vector<JsonView> JsonView::elements() const {
    std::vector<JsonView> all;
    for (std::size_t i = 0; i < size(); ++i) all.push_back(element(i));
    return all;
}

bool JsonView::boolean() const {
    if (!value_->is_boolean()) fail("must be true or false");
    return value_->get<bool>();
}

double JsonView::number() const {
    if (!value_->is_number()) fail("must be a number");
    const double number = value_->get<double>();
    if (!std::isfinite(number)) fail("must be finite");
    return number;
}

std::int64_t JsonView::integer() const {
    constexpr double kExact = 9007199254740992.0;  // 2^53
    const double value = number();
    if (value != std::floor(value) || std::abs(value) > kExact) fail("must be a whole number");
    return static_cast<std::int64_t>(value);
}

std::string JsonView::string() const {
    if (!value_->is_string()) fail("must be a string");
    return value_->get<std::string>();
}

std::vector<double> JsonView::numbers(std::size_t count) const {
    if (count != 0 && size() != count) fail("must be an array of " + std::to_string(count) + " numbers");
    std::vector<double> all;
    for (const JsonView& e : elements()) all.push_back(e.number());
    return all;
}

std::size_t JsonView::index(std::size_t limit, const char* ofWhat) const {
    const std::int64_t value = integer();
    if (value < 0 || static_cast<std::uint64_t>(value) >= limit) {
        fail("there is no " + std::string(ofWhat) + "[" + std::to_string(value) + "], there are " +
             std::to_string(limit));
    }
    return static_cast<std::size_t>(value);
}

std::size_t JsonView::natural(const char* key, std::size_t fallback) const {
    const auto found = find(key);
    if (!found) return fallback;
    const std::int64_t value = found->integer();
    if (value < 0) found->fail("must not be negative");
    return static_cast<std::size_t>(value);
}

bool JsonView::boolean(const char* key, bool fallback) const {
    const auto found = find(key);
    return found ? found->boolean() : fallback;
}

double JsonView::number(const char* key, double fallback) const {
    const auto found = find(key);
    return found ? found->number() : fallback;
}

std::string JsonView::string(const char* key, const std::string& fallback) const {
    const auto found = find(key);
    return found ? found->string() : fallback;
}

}  // namespace cutis
