// A hash over values, field by field: equal values give equal hashes on every machine of one byte order.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "renderer/core/files.h"

namespace cutis {

class ContentHash {
  public:
    // Numbers, enums, vectors and matrices: types without padding. Structs are added field by field.
    template <class... T>
    ContentHash& add(const T&... values) {
        static_assert((std::is_trivially_copyable_v<T> && ...));
        ((hash_ = hashBytes(std::as_bytes(std::span(&values, 1)), hash_)), ...);
        return *this;
    }
    template <class T>
    ContentHash& add(const std::vector<T>& values) {
        add(values.size());
        for (const T& value : values) add(value);
        return *this;
    }
    ContentHash& add(const std::string& text) {
        add(text.size());
        hash_ = hashBytes(std::as_bytes(std::span(text)), hash_);
        return *this;
    }
    std::uint64_t value() const { return hash_; }

  private:
    std::uint64_t hash_ = 0xcbf29ce484222325u;  // FNV-1a, as in hashBytes
};

}  // namespace cutis
