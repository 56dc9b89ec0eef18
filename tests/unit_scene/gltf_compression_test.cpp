// EXT_meshopt_compression and KHR_draco_mesh_compression, against what was compressed.
#include <draco/compression/encode.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <cmath>
#include <functional>

#include "gltf_file.h"
#include "renderer/core/error.h"
#include "renderer/scene/gltf.h"
#include "tests/support/process.h"

namespace cutis {
namespace {

using test::GltfFile;
using test::TemporaryFolder;

// A wavy sheet of 20 × 20 vertices.
constexpr int kSide = 20;

std::vector<glm::vec4> sheetPositions() {
    std::vector<glm::vec4> positions;
    for (int i = 0; i < kSide * kSide; ++i) {
        const auto x = float(i % kSide), y = float(i / kSide);
        positions.emplace_back(x, y, std::sin(0.3f * x) * std::cos(0.2f * y), 0);
    }
    return positions;
}

std::vector<std::uint32_t> sheetIndices() {
    std::vector<std::uint32_t> indices;
    for (std::uint32_t row = 0; row + 1 < kSide; ++row) {
        for (std::uint32_t column = 0; column + 1 < kSide; ++column) {
            const std::uint32_t a = row * kSide + column;
            indices.insert(indices.end(), {a, a + 1, a + kSide, a + 1, a + kSide + 1, a + kSide});
        }
    }
    return indices;
}

// Adds a view that is compressed, with the one it stands for in a buffer that holds nothing.
int addCompressed(GltfFile& file, const std::vector<unsigned char>& data, std::size_t count,
                  std::size_t stride, const char* mode, const char* filter = "NONE") {
    const int at = file.addView(data);
    nlohmann::json extension = file.json["bufferViews"][at];
    extension.update({{"count", count}, {"byteStride", stride}, {"mode", mode}, {"filter", filter}});
    nlohmann::json view = {{"buffer", 1}, {"byteOffset", 0}, {"byteLength", count * stride}};
    view["extensions"]["EXT_meshopt_compression"] = extension;
    if (mode == std::string("ATTRIBUTES")) view["byteStride"] = stride;
    file.json["bufferViews"].push_back(view);
    return int(file.json["bufferViews"].size()) - 1;
}

template <class T>
std::vector<unsigned char> encodeVertices(const std::vector<T>& vertices) {
    std::vector<unsigned char> data(meshopt_encodeVertexBufferBound(vertices.size(), sizeof(T)));
    data.resize(
        meshopt_encodeVertexBuffer(data.data(), data.size(), vertices.data(), vertices.size(), sizeof(T)));
    return data;
}

std::vector<unsigned char> encodeTriangles(const std::vector<std::uint32_t>& indices) {
    std::vector<unsigned char> data(meshopt_encodeIndexBufferBound(indices.size(), kSide * kSide));
    data.resize(meshopt_encodeIndexBuffer(data.data(), data.size(), indices.data(), indices.size()));
    return data;
}

std::vector<unsigned char> encodeSequence(const std::vector<std::uint32_t>& indices) {
    std::vector<unsigned char> data(meshopt_encodeIndexSequenceBound(indices.size(), kSide * kSide));
    data.resize(meshopt_encodeIndexSequence(data.data(), data.size(), indices.data(), indices.size()));
    return data;
}

GltfFile sheetFile(bool sequence = false) {
    GltfFile file = test::triangleFile();
    const std::vector<glm::vec4> positions = sheetPositions();
    const std::vector<std::uint32_t> indices = sheetIndices();
    const int vertexView = addCompressed(file, encodeVertices(positions), positions.size(), 16, "ATTRIBUTES");
    const int indexView = addCompressed(file, sequence ? encodeSequence(indices) : encodeTriangles(indices),
                                        indices.size(), 4, sequence ? "INDICES" : "TRIANGLES");
    nlohmann::json& primitive = file.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["POSITION"] =
        file.addAccessorJson(vertexView, "VEC3", test::kFloat, positions.size());
    primitive["indices"] = file.addAccessorJson(indexView, "SCALAR", test::kUnsignedInt, indices.size());
    file.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    file.json["buffers"] = {
        {{"byteLength", file.binary.size()}},
        {{"byteLength", 1 << 20}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    return file;
}

Primitive load(const GltfFile& file) {
    const TemporaryFolder folder;
    return loadGltf(file.saveGlb(folder.path())).meshes.at(0).primitives.at(0);
}

// The encoder may turn a triangle's corners round.
std::vector<std::uint32_t> canonical(std::vector<std::uint32_t> indices) {
    for (auto t = indices.begin(); t != indices.end(); t += 3)
        std::rotate(t, std::min_element(t, t + 3), t + 3);
    return indices;
}

TEST(GltfMeshopt, PositionsAndIndicesAreWhatWasCompressed) {
    for (const bool sequence : {false, true}) {
        const Primitive p = load(sheetFile(sequence));
        const std::vector<glm::vec4> expected = sheetPositions();
        ASSERT_EQ(p.positions.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_EQ(p.positions[i], glm::vec3(expected[i])) << i;
        EXPECT_EQ(canonical(p.indices), canonical(sheetIndices()));
    }
}

// Normals of 12 bits by octahedron: within 1e-3 of what they were.
TEST(GltfMeshopt, OctahedralNormals) {
    GltfFile file = sheetFile();
    std::vector<glm::vec4> normals;
    for (const glm::vec4& p : sheetPositions())
        normals.emplace_back(glm::normalize(glm::vec3(p.z, 0.3f, 1)), 0);
    std::vector<glm::i16vec4> packed(normals.size());
    meshopt_encodeFilterOct(packed.data(), packed.size(), sizeof(packed[0]), 12, &normals[0].x);
    const int view =
        addCompressed(file, encodeVertices(packed), packed.size(), 8, "ATTRIBUTES", "OCTAHEDRAL");
    file.json["buffers"][0]["byteLength"] = file.binary.size();
    file.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        file.addAccessorJson(view, "VEC3", test::kShort, packed.size(), {{"normalized", true}});
    const Primitive p = load(file);
    for (std::size_t i = 0; i < normals.size(); ++i)
        EXPECT_LT(glm::distance(p.normals[i], glm::vec3(normals[i])), 1e-3f) << i;
}

TEST(GltfMeshopt, DamagedDataIsOneLine) {
    struct Case {
        const char* error;
        std::function<void(nlohmann::json&)> spoil;
    };
    const std::vector<Case> cases{
        {"its data is damaged", [](nlohmann::json& e) { e["byteLength"] = 20; }},
        {"its data is damaged", [](nlohmann::json& e) { e["byteOffset"] = 0, e["byteLength"] = 36; }},
        {"there is no mode \"POINTS\"", [](nlohmann::json& e) { e["mode"] = "POINTS"; }},
        {"there is no filter \"FOURIER\"", [](nlohmann::json& e) { e["filter"] = "FOURIER"; }},
        {"OCTAHEDRAL does not go with a stride of 16", [](nlohmann::json& e) { e["filter"] = "OCTAHEDRAL"; }},
        {"a stride of 3 does not go with ATTRIBUTES", [](nlohmann::json& e) { e["byteStride"] = 3; }},
        {"there cannot be", [](nlohmann::json& e) { e["count"] = std::int64_t(1) << 52; }},
        {"of a buffer of", [](nlohmann::json& e) { e["byteLength"] = 1 << 30; }},
    };
    for (const Case& c : cases) {
        GltfFile file = sheetFile();
        for (nlohmann::json& view : file.json["bufferViews"]) {
            if (view.contains("extensions") && view.contains("byteStride"))
                c.spoil(view["extensions"]["EXT_meshopt_compression"]);
        }
        try {
            load(file);
            ADD_FAILURE() << c.error << ": no error";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(c.error), std::string::npos) << error.what();
        }
    }
}

// The sheet without loss, with joint 1 for every vertex: ids 0 and 1.
std::vector<char> dracoSheet() {
    const std::vector<glm::vec4> positions = sheetPositions();
    const std::vector<std::uint32_t> indices = sheetIndices();
    draco::Mesh mesh;
    const auto count = static_cast<std::uint32_t>(positions.size());
    mesh.set_num_points(count);
    draco::GeometryAttribute position, joints;
    position.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
    joints.Init(draco::GeometryAttribute::GENERIC, nullptr, 4, draco::DT_UINT8, false, 4, 0);
    const int positionId = mesh.AddAttribute(position, true, count),
              jointsId = mesh.AddAttribute(joints, true, count);
    for (std::uint32_t v = 0; v < count; ++v) {
        const std::array<std::uint8_t, 4> joint{1, 0, 0, 0};
        mesh.attribute(positionId)->SetAttributeValue(draco::AttributeValueIndex(v), &positions[v]);
        mesh.attribute(jointsId)->SetAttributeValue(draco::AttributeValueIndex(v), joint.data());
    }
    mesh.SetNumFaces(indices.size() / 3);
    for (std::uint32_t f = 0; f < indices.size() / 3; ++f) {
        draco::Mesh::Face face;
        for (int c = 0; c < 3; ++c) face[c] = draco::PointIndex(indices[3 * f + c]);
        mesh.SetFace(draco::FaceIndex(f), face);
    }
    draco::Encoder encoder;
    encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
    return {buffer.data(), buffer.data() + buffer.size()};
}

GltfFile dracoFile() {
    GltfFile file = test::triangleFile();
    const int view = file.addView(dracoSheet());
    const int count = kSide * kSide;
    nlohmann::json& primitive = file.json["meshes"][0]["primitives"][0];
    primitive["attributes"] = {{"POSITION", file.addAccessorJson(-1, "VEC3", test::kFloat, count)},
                               {"JOINTS_0", file.addAccessorJson(-1, "VEC4", test::kUnsignedByte, count)}};
    primitive["indices"] = file.addAccessorJson(-1, "SCALAR", test::kUnsignedShort, sheetIndices().size());
    primitive["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", view}, {"attributes", {{"POSITION", 0}, {"JOINTS_0", 1}}}};
    file.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return file;
}

TEST(GltfDraco, PositionsJointsAndIndicesAreWhatWasCompressed) {
    GltfFile file = dracoFile();
    Primitive p = load(file);
    const std::vector<glm::vec4> expected = sheetPositions();
    ASSERT_EQ(p.positions.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(p.positions[i], glm::vec3(expected[i])) << i;
    EXPECT_EQ(canonical(p.indices), canonical(sheetIndices()));
    // Its second joint stands 5 m aside.
    const std::vector<float> first(std::size_t(kSide * kSide) * 4, 0.25f);
    file.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] =
        file.addAccessor(first, "VEC4", test::kFloat, first.size() / 4);
    file.json["skins"] = {{{"joints", {1, 2}}}};
    file.json["nodes"] =
        nlohmann::json::parse(R"([{"mesh": 0, "skin": 0}, {}, {"translation": [20, 0, 0]}])");
    file.json["scenes"][0]["nodes"] = {0, 1, 2};
    p = load(file);
    EXPECT_LT(glm::distance(p.positions[7], glm::vec3(expected[7]) + glm::vec3(5, 0, 0)), 1e-5f);
}

TEST(GltfDraco, DamagedDataIsOneLine) {
    struct Case {
        const char* error;
        std::function<void(GltfFile&, nlohmann::json&)> spoil;
    };
    const std::vector<Case> cases{
        {"its data is damaged",
         [](GltfFile& f, nlohmann::json& e) {
             f.json["bufferViews"][e["bufferView"].get<int>()]["byteLength"] = 100;
         }},
        {"there is no attribute 7", [](GltfFile&, nlohmann::json& e) { e["attributes"]["POSITION"] = 7; }},
        {"400 elements of 4 that are compressed",
         [](GltfFile&, nlohmann::json& e) { e["attributes"]["POSITION"] = 1; }},
        {"bufferViews", [](GltfFile&, nlohmann::json& e) { e["bufferView"] = 99; }},
    };
    for (const Case& c : cases) {
        GltfFile file = dracoFile();
        c.spoil(file, file.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]);
        try {
            load(file);
            ADD_FAILURE() << c.error << ": no error";
        } catch (const Error& error) {
            const std::string text = error.what();
            EXPECT_NE(text.find(c.error), std::string::npos) << text;
        }
    }
}

}  // namespace
}  // namespace cutis
