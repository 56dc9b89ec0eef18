#include "renderer/scene/gltf_document.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string_view>

#include "renderer/core/error.h"
#include "renderer/core/files.h"

namespace cutis::gltf {
namespace fs = std::filesystem;
namespace {

constexpr const char* kSupported[] = {
    "KHR_lights_punctual",   "KHR_materials_emissive_strength", "KHR_materials_unlit",
    "KHR_mesh_quantization", "KHR_texture_transform",           "EXT_texture_webp",
    "EXT_meshopt_compression", "KHR_draco_mesh_compression",
    "KHR_materials_ior", "KHR_materials_specular", "KHR_materials_clearcoat", "KHR_materials_sheen",
    "KHR_materials_transmission",
    "KHR_materials_diffuse_transmission", "KHR_materials_volume", "KHR_materials_volume_scatter",  // as hints at skin
};

// Values of the character set of RFC 4648, -1 for others.
std::vector<std::byte> decodeBase64(std::string_view text, const JsonView& where) {
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() * 3 / 4);
    std::uint32_t bits = 0;
    int held = 0;
    for (const char c : text) {
        const int digit = c >= 'A' && c <= 'Z'   ? c - 'A'
                          : c >= 'a' && c <= 'z' ? c - 'a' + 26
                          : c >= '0' && c <= '9' ? c - '0' + 52
                          : c == '+' || c == '-' ? 62
                          : c == '/' || c == '_' ? 63
                                                 : -1;
        if (digit < 0) where.fail("its data is not base64");
        bits = bits << 6 | std::uint32_t(digit);
        held += 6;
        if (held >= 8) {
            held -= 8;
            bytes.push_back(std::byte(bits >> held & 0xff));
        }
    }
    return bytes;
}

std::string decodePercent(std::string_view text, const JsonView& where) {
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            decoded += text[i];
            continue;
        }
        const auto digit = [&](std::size_t at) {
            const std::string_view digits = "0123456789abcdef";
            const std::size_t value =
                at < text.size() ? digits.find(char(std::tolower(static_cast<unsigned char>(text[at])))) : 16;
            if (value > 15) where.fail("its percent encoding is broken");
            return value;
        };
        decoded += char(digit(i + 1) << 4 | digit(i + 2));
        i += 2;
    }
    return decoded;
}

// Why the text must not be parsed: a document of nothing but brackets takes 30 times its size in memory, so
// what is not in strings (where embedded data is) is limited; nesting too, for whoever recurses.
std::string excessOf(std::span<const std::byte> text) {
    constexpr std::size_t kMaxStructure = std::size_t(128) << 20, kMaxDepth = 256;
    std::size_t structure = 0, depth = 0;
    bool inString = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = char(text[i]);
        if (inString) {
            if (c == '\\') ++i;
            inString = c != '"';
            continue;
        }
        inString = c == '"';
        if (c == '[' || c == '{') ++depth;
        if ((c == ']' || c == '}') && depth > 0) --depth;
        if (depth > kMaxDepth) return "its JSON nests more than " + std::to_string(kMaxDepth) + " deep";
        if (++structure > kMaxStructure) return "its JSON has more than 128 MiB outside of strings";
    }
    return {};
}

bool isWithin(const fs::path& path, const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

constexpr std::uint32_t kMagic = 0x46546c67;  // "glTF", with which a .glb file begins

std::uint32_t wordAt(std::span<const std::byte> bytes, std::size_t at) {
    std::uint32_t word;
    std::memcpy(&word, bytes.data() + at, sizeof word);
    return word;
}

}  // namespace

Document::Document(const fs::path& file)
    : file_(file), source_{"cannot load scene", file.string()} {
    checkHead();
    bytes_ = readFile(file, kMaxFileBytes);
    openContainer();
    const JsonView asset = root().member("asset");
    const std::string version = asset.member("version").string();
    if (!version.starts_with("2."))
        asset.member("version").fail("version " + version + ", only 2.x is supported");
    if (const auto least = asset.find("minVersion"); least && least->string() != "2.0") {
        least->fail("version " + least->string() + " is required, only 2.0 is supported");
    }
    checkExtensions();
    buffers_.resize(count("buffers"));
}

Document::~Document() = default;

// Refuses what is neither .glb nor JSON text; of an empty file the parser says what is missing.
void Document::checkHead() const {
    const std::vector<std::byte> head = readFileStart(file_, 16);
    if (head.size() >= 4 && wordAt(head, 0) == kMagic) return;
    std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // the byte order mark of UTF-8
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first != std::string_view::npos && text[first] != '{')
        throw Error(source_.what, "not glTF: it begins neither as .glb nor as a JSON object", source_.file);
}

// glTF 2.0, §4.4: a header, a chunk of JSON, perhaps one of binary data. Anything else is JSON text.
void Document::openContainer() {
    constexpr std::uint32_t kJson = 0x4e4f534a, kBinary = 0x004e4942;
    if (bytes_.size() < 4 || wordAt(bytes_, 0) != kMagic) return parse(bytes_);
    const auto fail = [&](const std::string& why) { throw Error(source_.what, why, source_.file); };
    if (bytes_.size() < 20) fail("the .glb file is truncated");
    if (wordAt(bytes_, 4) != 2)
        fail("the .glb file has version " + std::to_string(wordAt(bytes_, 4)) + ", not 2");
    const std::uint64_t total = wordAt(bytes_, 8);
    if (total > bytes_.size()) fail("the .glb file is truncated");
    std::span<const std::byte> text;
    for (std::uint64_t at = 12; at + 8 <= total;) {
        const std::uint64_t length = wordAt(bytes_, at), type = wordAt(bytes_, at + 4);
        if (at + 8 + length > total) fail("a chunk of the .glb file exceeds it");
        const auto chunk = std::span(bytes_).subspan(at + 8, length);
        if (at == 12 && type != kJson) fail("the first chunk of the .glb file is not JSON");
        if (type == kJson && text.empty()) text = chunk;
        if (type == kBinary && binaryChunk_.empty()) binaryChunk_ = chunk;
        at += 8 + length;
    }
    parse(text);
}

void Document::parse(std::span<const std::byte> text) {
    if (const std::string why = excessOf(text); !why.empty()) throw Error(source_.what, why, source_.file);
    const char* begin = reinterpret_cast<const char*>(text.data());
    try {
        json_ = std::make_unique<nlohmann::json>(nlohmann::json::parse(begin, begin + text.size()));
    } catch (const nlohmann::json::exception& error) {
        // "[json.exception.parse_error.101] parse error at line 1, column 1: …": the part in brackets says
        // nothing.
        std::string why = error.what();
        if (const std::size_t end = why.find("] "); end != std::string::npos) why.erase(0, end + 2);
        throw Error(source_.what, "not glTF: " + why, source_.file);
    }
    if (!json_->is_object()) throw Error(source_.what, "not glTF: the JSON is not an object", source_.file);
}

void Document::checkExtensions() const {
    const auto supported = [](const std::string& name) {
        return std::ranges::any_of(kSupported, [&](std::string_view s) { return s == name; });
    };
    if (const auto required = root().find("extensionsRequired")) {
        for (const JsonView& name : required->elements()) {
            if (!supported(name.string()))
                name.fail("the required extension " + name.string() + " is not supported");
        }
    }
    if (const auto used = root().find("extensionsUsed")) {
        for (const JsonView& name : used->elements()) {
            if (!supported(name.string())) {
                warn("extension " + name.string() + " is not supported and left out, " + name.where());
            }
        }
    }
}

JsonView Document::root() const {
    return {*json_, source_};
}

std::size_t Document::count(const char* name) const {
    const auto array = root().find(name);
    return array ? array->size() : 0;
}

JsonView Document::entry(const char* name, std::size_t index) const {
    return root().member(name).element(index);
}

JsonView Document::resolve(const JsonView& reference, const char* name) const {
    return entry(name, reference.index(count(name), name));
}

std::span<const std::byte> Document::buffer(std::size_t index) {
    const JsonView entryView = entry("buffers", index);
    const JsonView length = entryView.member("byteLength");
    const std::int64_t stated = length.integer();
    const auto uri = entryView.find("uri");
    std::span<const std::byte> bytes;
    if (!uri && index == 0 && !binaryChunk_.empty()) {
        bytes = binaryChunk_;
    } else {
        if (!uri) entryView.fail("it has no data");
        if (!buffers_[index]) {
            // No more than it states, of a file that may be longer or that other buffers name as well; and no more
            // than a byte beyond what is left.
            const std::uint64_t left = kMaxFileBytes - loaded_ + 1;
            buffers_[index] = readUriStart(*uri, std::min(std::uint64_t(std::max<std::int64_t>(stated, 0)), left));
            loaded_ += buffers_[index]->size();
            if (loaded_ > kMaxFileBytes) entryView.fail("the scene has more than 4 GiB of buffers");
        }
        bytes = *buffers_[index];
    }
    if (stated < 0 || std::uint64_t(stated) > bytes.size()) {
        length.fail("it states " + std::to_string(stated) + " bytes, there are " +
                    std::to_string(bytes.size()));
    }
    return bytes.first(std::size_t(stated));
}

std::span<const std::byte> Document::bufferView(std::size_t index) {
    const JsonView view = entry("bufferViews", index);
    const auto extensions = view.find("extensions");
    const auto compression = extensions ? extensions->find("EXT_meshopt_compression") : std::nullopt;
    if (!compression) return slice(view);
    const auto known = decoded_.find(index);
    return known != decoded_.end() ? known->second : decoded_[index] = decodeMeshopt(*compression);
}

std::span<const std::byte> Document::slice(const JsonView& view) {
    const auto bytes = buffer(view.member("buffer").index(count("buffers"), "buffers"));
    view.member("byteLength");
    const std::size_t offset = view.natural("byteOffset", 0), length = view.natural("byteLength", 0);
    if (offset > bytes.size() || length > bytes.size() - offset) {
        view.fail("bytes " + std::to_string(offset) + " to " + std::to_string(offset + length) +
                  " of a buffer of " + std::to_string(bytes.size()));
    }
    return bytes.subspan(offset, length);
}

std::vector<std::byte> Document::readUri(const JsonView& uri) const {
    const std::string text = uri.string();
    if (!text.starts_with("data:")) return readFile(fileOfUri(uri), kMaxFileBytes);
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos || !std::string_view(text).substr(0, comma).ends_with(";base64")) {
        uri.fail("only data URIs in base64 are supported");
    }
    return decodeBase64(std::string_view(text).substr(comma + 1), uri);
}

std::vector<std::byte> Document::readUriStart(const JsonView& uri, std::uint64_t bytes) const {
    if (!uri.string().starts_with("data:")) return readFileStart(fileOfUri(uri), bytes);
    std::vector<std::byte> start = readUri(uri);
    start.resize(std::min<std::uint64_t>(start.size(), bytes));
    return start;
}

// A scene file may come from anyone: it must not make cutis read what it has no business with.
fs::path Document::fileOfUri(const JsonView& uri) const {
    const std::string text = uri.string();
    const std::size_t colon = text.find_first_of(":/?#");
    if (colon != std::string::npos && text[colon] == ':') {
        uri.fail("the scheme \"" + text.substr(0, colon + 1) +
                 "\" is not allowed, only data: and files beside the scene");
    }
    const std::string decoded = decodePercent(text, uri);
    if (decoded.empty() || decoded.find('\0') != std::string::npos) uri.fail("not the name of a file");
    const fs::path relative(decoded);
    const bool climbs = std::ranges::any_of(relative, [](const fs::path& part) { return part == ".."; });
    std::error_code error;
    const fs::path folder = fs::weakly_canonical(fs::absolute(file_).parent_path(), error);
    const fs::path resolved = fs::weakly_canonical(folder / relative, error);
    if (relative.is_absolute() || climbs || error || !isWithin(resolved, folder)) {
        uri.fail("\"" + decoded + "\" is outside the scene's folder");
    }
    if (!fs::is_regular_file(resolved, error)) uri.fail("no such file \"" + decoded + "\"");
    return resolved;
}

void Document::spend(std::uint64_t bytes, const JsonView& where) {
    spent_ += bytes;
    if (bytes > kMaxDecodedBytes || spent_ > kMaxDecodedBytes)
        where.fail("the scene has more than 4 GiB of vertex data");
}

}  // namespace cutis::gltf
