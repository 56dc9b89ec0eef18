#include "renderer/scene/json_fault.h"

#include <nlohmann/json.hpp>
#include <set>
#include <vector>

namespace cutis {
namespace {

using Json = nlohmann::json;

class Inspection : public Json::json_sax_t {
  public:
    Inspection(std::size_t maxDepth, std::size_t maxKeys) : maxDepth_(maxDepth), maxKeys_(maxKeys) {}
    const std::string& why() const { return why_; }

    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool string(string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool start_object(std::size_t) override { return open(); }
    bool end_object() override { return close(); }
    bool start_array(std::size_t) override { return open(); }
    bool end_array() override { return close(); }
    bool key(string_t& name) override {
        std::set<std::string>& keys = keys_.back();
        if (!keys.insert(name).second) return refuse("key '" + name + "' is given twice in one object");
        return keys.size() <= maxKeys_ ||
               refuse("an object has more than " + std::to_string(maxKeys_) + " keys");
    }
    bool parse_error(std::size_t, const std::string&, const Json::exception& error) override {
        // "[json.exception.parse_error.101] parse error at line 1, column 2: …": the part in brackets says
        // nothing.
        const std::string why = error.what();
        const std::size_t end = why.find("] ");
        return refuse(end == std::string::npos ? why : why.substr(end + 2));
    }

  private:
    bool refuse(const std::string& why) {
        why_ = why;
        return false;
    }
    bool open() {
        keys_.emplace_back();
        return keys_.size() <= maxDepth_ || refuse("it is nested too deep");
    }
    bool close() {
        keys_.pop_back();
        return true;
    }

    std::size_t maxDepth_, maxKeys_;
    std::vector<std::set<std::string>> keys_;  // of each object and list that is open
    std::string why_;
};

}  // namespace

std::string findJsonFault(const std::string& text, std::size_t maxDepth, std::size_t maxKeys) {
    Inspection inspection(maxDepth, maxKeys);
    Json::sax_parse(text, &inspection);
    return inspection.why();
}

}  // namespace cutis
