// Buffer views that are compressed by EXT_meshopt_compression.
#include <meshoptimizer.h>

#include <algorithm>

#include "renderer/scene/gltf_document.h"

namespace cutis::gltf {
namespace {

// Decoded in place: unit vectors, quaternions or floats of few bits (the extension's appendix B).
void applyFilter(const JsonView& extension, std::vector<std::byte>& data, std::size_t count,
                 std::size_t stride) {
    const std::string filter = extension.string("filter", "NONE");
    const auto need = [&](bool fits) {
        if (!fits)
            extension.member("filter").fail(filter + " does not go with a stride of " +
                                            std::to_string(stride));
    };
    if (filter == "OCTAHEDRAL") {
        need(stride == 4 || stride == 8);
        meshopt_decodeFilterOct(data.data(), count, stride);
    } else if (filter == "QUATERNION") {
        need(stride == 8);
        meshopt_decodeFilterQuat(data.data(), count, stride);
    } else if (filter == "EXPONENTIAL") {
        need(stride % 4 == 0);
        meshopt_decodeFilterExp(data.data(), count, stride);
    } else if (filter != "NONE") {
        extension.member("filter").fail("there is no filter \"" + filter + "\"");
    }
}

}  // namespace

std::vector<std::byte> Document::decodeMeshopt(const JsonView& extension) {
    const auto source = slice(extension);
    const auto* bytes = reinterpret_cast<const unsigned char*>(source.data());
    const std::size_t stride = extension.natural("byteStride", 0), count = extension.natural("count", 0);
    const std::string mode = extension.member("mode").string();
    const bool vertices = mode == "ATTRIBUTES";
    if (!vertices && mode != "TRIANGLES" && mode != "INDICES")
        extension.member("mode").fail("there is no mode \"" + mode + "\"");
    const bool fits = vertices ? stride > 0 && stride <= 256 && stride % 4 == 0 : stride == 2 || stride == 4;
    if (!fits)
        extension.member("byteStride")
            .fail("a stride of " + std::to_string(stride) + " does not go with " + mode);
    if (count == 0 || count > kMaxDecodedBytes / stride || (mode == "TRIANGLES" && count % 3 != 0))
        extension.member("count").fail("there cannot be " + std::to_string(count));
    spend(count * stride, extension);
    std::vector<std::byte> data(count * stride);
    const int failure =
        vertices              ? meshopt_decodeVertexBuffer(data.data(), count, stride, bytes, source.size())
        : mode == "TRIANGLES" ? meshopt_decodeIndexBuffer(data.data(), count, stride, bytes, source.size())
                              : meshopt_decodeIndexSequence(data.data(), count, stride, bytes, source.size());
    if (failure != 0) extension.fail("its data is damaged");
    if (vertices) applyFilter(extension, data, count, stride);
    return data;
}

}  // namespace cutis::gltf
