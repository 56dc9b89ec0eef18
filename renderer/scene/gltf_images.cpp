#include <atomic>
#include <cmath>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/scene/codec/image_file.h"
#include "renderer/scene/gltf_parts.h"
#include "renderer/scene/image_io.h"
#include "renderer/scene/tonemap.h"

namespace cutis::gltf {
namespace {

// Decodes the sRGB code values of an image of 16-bit integers.
void linearize(Image& image) {
    const std::size_t texels = std::size_t(image.width) * image.height;
    for (std::size_t i = 0; i < texels; ++i) {
        std::uint64_t packed;
        std::memcpy(&packed, image.texels.data() + 8 * i, sizeof packed);
        glm::vec4 rgba = glm::unpackHalf4x16(packed);
        for (int c = 0; c < 3; ++c) rgba[c] = decodeSrgb(rgba[c]);
        packed = glm::packHalf4x16(rgba);
        std::memcpy(image.texels.data() + 8 * i, &packed, sizeof packed);
    }
}

class ImageReader {
  public:
    ImageReader(Document& document, const std::vector<ImageUse>& uses, Scene& scene)
        : document_(document), uses_(uses), scene_(scene), sources_(uses.size()), isFloat_(uses.size(), 0) {}

    void run() {
        for (std::size_t i = 0; i < uses_.size(); ++i) locate(i);
        // Before any is decoded: a few small files may claim gigabytes.
        std::atomic<std::uint64_t> files{0}, decoded{0};
        parallelFor(uses_.size(), [&](std::size_t i) {
            read(i);
            if ((files += sources_[i].bytes.size()) > kMaxDecodedBytes ||
                (decoded += decodedBytes(sources_[i].bytes)) > kMaxDecodedBytes) {
                throw Error("cannot load scene", "its images have more than 4 GiB",
                            document_.file().string());
            }
        });
        parallelFor(uses_.size(), [&](std::size_t i) { decode(i); });
        for (std::size_t i = 0; i < uses_.size(); ++i) settleColor(int(i));
    }

  private:
    struct Source {
        std::optional<JsonView> uri;       // where it is no buffer view
        std::vector<std::byte> file;       // what lies there
        std::span<const std::byte> bytes;  // of `file` or a buffer view
        std::string where;
    };

    void locate(std::size_t i) {
        const JsonView entry = document_.entry("images", uses_[i].fileImage);
        Source& source = sources_[i];
        if (const auto view = entry.find("bufferView")) {
            source.bytes = document_.bufferView(view->index(document_.count("bufferViews"), "bufferViews"));
        } else {
            source.uri = entry.member("uri");
        }
        source.where = entry.where();
        Image& image = scene_.images[i];
        image.name = entry.string("name");
        if (!image.name.empty()) return;
        const bool isFile = source.uri && !source.uri->string().starts_with("data:");
        image.name = isFile ? source.uri->string() : entry.path();
    }

    void read(std::size_t i) {
        Source& source = sources_[i];
        if (!source.uri) return;
        const bool isFile = !source.uri->string().starts_with("data:");
        if (isFile && imageFormat(document_.readUriStart(*source.uri, 16)).empty())
            throw Error("cannot read image", "not an image of a known format", source.where);
        source.file = document_.readUri(*source.uri);
        source.bytes = source.file;
    }

    void decode(std::size_t i) {
        Source& source = sources_[i];
        bool isFloat = false;
        const std::string name = scene_.images[i].name;
        scene_.images[i] = decodeImage(source.bytes, source.where, &isFloat);
        source.file = {};
        scene_.images[i].name = name;
        isFloat_[i] = isFloat;
    }

    // There are no sRGB textures of more than 8 bits: deeper colours are made linear here, floating-point
    // ones are so.
    void settleColor(int i) {
        if (scene_.images[i].format == TexelFormat::rgba8 || !uses_[i].asColor) return;
        int linear = i;
        if (!isFloat_[i]) {
            if (uses_[i].asData) {
                linear = int(scene_.images.size());
                scene_.images.push_back(scene_.images[i]);
            }
            linearize(scene_.images[linear]);
        }
        for (Texture& texture : scene_.textures) {
            if (texture.image != i || !texture.srgb) continue;
            texture.image = linear;
            texture.srgb = false;
        }
    }

    Document& document_;
    const std::vector<ImageUse>& uses_;
    Scene& scene_;
    std::vector<Source> sources_;
    std::vector<char> isFloat_;  // not bool: threads write neighbours at once
};

}  // namespace

void readImages(Document& document, const std::vector<ImageUse>& uses, Scene& scene) {
    ImageReader(document, uses, scene).run();
}

}  // namespace cutis::gltf
