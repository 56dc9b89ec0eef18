#include "renderer/scene/codec/draco_codec.h"

#include <draco/compression/decode.h>

#include <cstring>
#include <exception>

namespace cutis::codec {
namespace {

// Copies values behind one another.
class Writer {
  public:
    explicit Writer(std::byte* to) : to_(to) {}
    template <class T>
    void put(const T& value) {
        std::memcpy(to_, &value, sizeof value);
        to_ += sizeof value;
    }

  private:
    std::byte* to_;
};

void writeAttribute(const draco::Mesh& mesh, const draco::PointAttribute& attribute, Writer& out) {
    const int components = attribute.num_components();
    std::array<float, 127> value{};
    for (draco::PointIndex p(0); p < mesh.num_points(); ++p) {
        if (!attribute.ConvertValue<float>(attribute.mapped_index(p), static_cast<std::int8_t>(components),
                                           value.data()))
            value.fill(0);
        for (int c = 0; c < components; ++c) out.put(value[c]);
    }
}

}  // namespace

std::string decodeDraco(std::span<const std::byte> data, std::uint64_t maxBytes, const Allocate& allocate) {
    try {
        draco::DecoderBuffer buffer;
        buffer.Init(reinterpret_cast<const char*>(data.data()), data.size());
        auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
        if (!decoded.ok()) return "its data is damaged: " + decoded.status().error_msg_string();
        const draco::Mesh& mesh = *decoded.value();
        const DracoHeader header{mesh.num_points(), mesh.num_faces(),
                                 static_cast<std::uint32_t>(mesh.num_attributes())};
        std::uint64_t bytes = sizeof header + std::uint64_t(header.triangles) * 3 * sizeof(std::uint32_t);
        for (int a = 0; a < mesh.num_attributes(); ++a) {
            bytes += sizeof(DracoAttribute) +
                     std::uint64_t(header.points) * mesh.attribute(a)->num_components() * sizeof(float);
        }
        if (bytes > maxBytes) return "it is too large";
        Writer out(allocate(bytes));
        out.put(header);
        for (int a = 0; a < mesh.num_attributes(); ++a) {
            out.put(DracoAttribute{mesh.attribute(a)->unique_id(),
                                   static_cast<std::uint32_t>(mesh.attribute(a)->num_components())});
        }
        for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f) {
            for (int corner = 0; corner < 3; ++corner) out.put(std::uint32_t(mesh.face(f)[corner].value()));
        }
        for (int a = 0; a < mesh.num_attributes(); ++a) writeAttribute(mesh, *mesh.attribute(a), out);
    } catch (const std::exception& error) {
        return error.what();
    }
    return {};
}

}  // namespace cutis::codec
