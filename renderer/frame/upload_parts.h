// What the files that upload the scene share.
#pragma once

#include <algorithm>
#include <vector>

#include "renderer/gpu/buffer.h"
#include "renderer/gpu/commands.h"

namespace cutis {

template <class T>
gpu::Buffer uploadBuffer(gpu::Device& device, gpu::Commands& commands, const char* name,
                         const std::vector<T>& values, bool index = false) {
    gpu::Buffer buffer(device, {.name = name, .bytes = values.size() * sizeof(T), .index = index});
    if (!values.empty()) commands.upload(buffer, values);
    return buffer;
}

// Place of a value in a list of distinct ones, appended when it is new.
template <class T>
std::size_t indexOf(std::vector<T>& list, const T& value) {
    const auto known = std::find(list.begin(), list.end(), value);
    if (known != list.end()) return static_cast<std::size_t>(known - list.begin());
    list.push_back(value);
    return list.size() - 1;
}

}  // namespace cutis
