#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/core/error.h"
#include "renderer/core/unique_names.h"
#include "renderer/scene/fields.h"
#include "renderer/scene/gltf_parts.h"

namespace cutis::gltf {
namespace {

glm::dmat4 readLocal(const JsonView& node) {
    if (const auto matrix = node.find("matrix")) {
        const std::vector<double> m = matrix->numbers(16);
        glm::dmat4 local;
        for (int i = 0; i < 16; ++i) local[i / 4][i % 4] = m[i];
        if (local[0].w != 0 || local[1].w != 0 || local[2].w != 0 || local[3].w != 1) {
            matrix->fail("its last row must be 0 0 0 1");
        }
        return local;
    }
    glm::dvec3 translation(0), scale(1);
    glm::dquat rotation(1, 0, 0, 0);
    if (const auto t = node.find("translation")) {
        const std::vector<double> v = t->numbers(3);
        translation = {v[0], v[1], v[2]};
    }
    if (const auto s = node.find("scale")) {
        const std::vector<double> v = s->numbers(3);
        scale = {v[0], v[1], v[2]};
    }
    if (const auto r = node.find("rotation")) {
        const std::vector<double> v = r->numbers(4);
        rotation = {v[3], v[0], v[1], v[2]};
        if (!(glm::length(rotation) > 1e-6 && glm::length(rotation) < 1e6)) r->fail("not a rotation");
        rotation = glm::normalize(rotation);
    }
    return glm::translate(glm::dmat4(1), translation) * glm::mat4_cast(rotation) *
           glm::scale(glm::dmat4(1), scale);
}

double positive(const JsonView& value) {
    if (value.number() <= 0) value.fail("must be above 0");
    return value.number();
}

Camera readCamera(const JsonView& camera) {
    Camera c;
    const std::string type = camera.member("type").string();
    if (type == "perspective") {
        const JsonView lens = camera.member("perspective");
        c.yfov = positive(lens.member("yfov"));
        if (c.yfov >= glm::pi<double>()) lens.member("yfov").fail("must be below π");
        c.znear = positive(lens.member("znear"));
        if (const auto aspect = lens.find("aspectRatio")) c.aspect = positive(*aspect);
        if (const auto zfar = lens.find("zfar")) c.zfar = positive(*zfar);
        if (c.zfar > 0 && c.zfar <= c.znear) lens.fail("zfar must be beyond znear");
    } else if (type == "orthographic") {
        const JsonView lens = camera.member("orthographic");
        c.orthographic = true;
        c.xmag = std::abs(lens.member("xmag").number());
        c.ymag = std::abs(lens.member("ymag").number());
        if (c.xmag == 0 || c.ymag == 0) lens.fail("xmag and ymag must not be 0");
        c.znear = lens.member("znear").number();
        c.zfar = lens.member("zfar").number();
        if (c.znear < 0 || c.zfar <= c.znear) lens.fail("must have 0 ≤ znear < zfar");
    } else {
        camera.member("type").fail("a camera is perspective or orthographic");
    }
    return c;
}

Light readLight(const JsonView& light) {
    Light l;
    const std::string type = light.member("type").string();
    if (type == "directional") {
        l.type = LightType::directional;
    } else if (type == "point") {
        l.type = LightType::point;
    } else if (type == "spot") {
        l.type = LightType::spot;
        const JsonView spot = light.member("spot");
        l.innerConeAngle = spot.number("innerConeAngle", 0);
        l.outerConeAngle = spot.number("outerConeAngle", glm::quarter_pi<double>());
        if (l.innerConeAngle < 0 || l.innerConeAngle >= l.outerConeAngle ||
            l.outerConeAngle > glm::half_pi<double>() + 1e-6) {
            spot.fail("must have 0 ≤ innerConeAngle < outerConeAngle ≤ π/2");
        }
    } else {
        light.member("type").fail("a light is directional, point or spot");
    }
    if (const auto color = light.find("color")) {
        const std::vector<double> c = color->numbers(3);
        l.color = {c[0], c[1], c[2]};
        if (std::min({c[0], c[1], c[2]}) < 0) color->fail("must not be negative");
        if (std::max({c[0], c[1], c[2]}) > fields::kColor.max) color->fail("must be at most 1e6");
    }
    l.intensity = light.number("intensity", 1);
    if (l.intensity < 0) light.member("intensity").fail("must not be negative");
    if (l.intensity > fields::kIntensity.max) light.member("intensity").fail("must be at most 1e12");
    if (const auto range = light.find("range")) l.range = positive(*range);
    return l;
}

// The name of a camera or light: that of its node, as an artist sees it, else its own, else its kind and
// place.
std::string uniqueName(const std::string& ofNode, const std::string& own, const std::string& kind,
                       std::size_t place, UniqueNames& names) {
    return names.take(!ofNode.empty() ? ofNode : !own.empty() ? own : kind + " " + std::to_string(place));
}

// Parents of all nodes of the file. Fails unless they form a forest.
std::vector<int> readParents(const Document& document) {
    const std::size_t count = document.count("nodes");
    std::vector<int> parents(count, kNone);
    for (std::size_t i = 0; i < count; ++i) {
        const auto children = document.entry("nodes", i).find("children");
        if (!children) continue;
        for (const JsonView& reference : children->elements()) {
            const std::size_t child = reference.index(count, "nodes");
            if (parents[child] != kNone) reference.fail("node " + std::to_string(child) + " has two parents");
            parents[child] = int(i);
        }
    }
    // Following parents from any node must end: marked by the walk that came by first.
    std::vector<int> walk(count, kNone);
    for (std::size_t i = 0; i < count; ++i) {
        int n = int(i);
        for (; n != kNone && walk[n] == kNone; n = parents[n]) walk[n] = int(i);
        if (n != kNone && walk[n] == int(i))
            document.entry("nodes", std::size_t(n)).fail("nodes form a cycle");
    }
    return parents;
}

// Which nodes the default scene holds.
std::vector<bool> readReached(const Document& document, const std::vector<int>& parents, Scene& scene) {
    const std::size_t scenes = document.count("scenes");
    if (scenes == 0) return std::vector<bool>(parents.size(), true);
    const auto choice = document.root().find("scene");
    const JsonView chosen = document.entry("scenes", choice ? choice->index(scenes, "scenes") : 0);
    if (const std::string name = chosen.string("name"); !name.empty()) scene.name = name;
    std::vector<bool> isRoot(parents.size(), false);
    if (const auto roots = chosen.find("nodes")) {
        for (const JsonView& reference : roots->elements()) {
            const std::size_t root = reference.index(parents.size(), "nodes");
            if (parents[root] != kNone)
                reference.fail("node " + std::to_string(root) + " is the child of another");
            isRoot[root] = true;
        }
    }
    std::vector<bool> reached(parents.size(), false);
    std::vector<int> topmost(parents.size(), kNone);
    for (std::size_t i = 0; i < parents.size(); ++i) {
        int top = int(i);
        while (parents[top] != kNone && topmost[top] == kNone) top = parents[top];
        if (topmost[top] != kNone) top = topmost[top];
        for (int n = int(i); n != kNone && topmost[n] == kNone; n = parents[n]) topmost[n] = top;
        reached[i] = isRoot[top];
    }
    return reached;
}

class NodeReader {
  public:
    NodeReader(Document& document, Scene& scene) : document_(document), scene_(scene) {}

    NodeMap run() {
        const std::vector<int> parents = readParents(document_);
        const std::vector<bool> reached = readReached(document_, parents, scene_);
        map_.sceneNode.assign(parents.size(), kNone);
        for (std::size_t i = 0; i < parents.size(); ++i) {
            if (!reached[i]) continue;
            map_.sceneNode[i] = int(map_.fileNode.size());
            map_.fileNode.push_back(int(i));
        }
        for (const int file : map_.fileNode)
            addNode(document_.entry("nodes", std::size_t(file)), parents[file]);
        return std::move(map_);
    }

  private:
    void addNode(const JsonView& entry, int parent) {
        Node node;
        node.name = entry.string("name");
        node.parent = parent == kNone ? kNone : map_.sceneNode[parent];
        node.local = readLocal(entry);
        if (const auto children = entry.find("children")) {
            for (const JsonView& reference : children->elements()) {
                node.children.push_back(map_.sceneNode[reference.index(map_.sceneNode.size(), "nodes")]);
            }
        }
        if (const auto mesh = entry.find("mesh"))
            node.mesh = int(mesh->index(document_.count("meshes"), "meshes"));
        if (const auto camera = entry.find("camera")) {
            const JsonView source = document_.resolve(*camera, "cameras");
            Camera c = readCamera(source);
            node.camera = int(scene_.cameras.size());
            c.name =
                uniqueName(node.name, source.string("name"), "camera", scene_.cameras.size(), cameraNames_);
            scene_.cameras.push_back(std::move(c));
        }
        const auto extensions = entry.find("extensions");
        if (const auto use = extensions ? extensions->find("KHR_lights_punctual") : std::nullopt) {
            const JsonView lights =
                document_.root().member("extensions").member("KHR_lights_punctual").member("lights");
            const JsonView source = lights.element(use->member("light").index(lights.size(), "lights"));
            Light l = readLight(source);
            node.light = int(scene_.lights.size());
            l.name = uniqueName(node.name, source.string("name"), "light", scene_.lights.size(), lightNames_);
            scene_.lights.push_back(std::move(l));
        }
        scene_.nodes.push_back(std::move(node));
    }

    Document& document_;
    Scene& scene_;
    NodeMap map_;
    UniqueNames cameraNames_, lightNames_;
};

}  // namespace

NodeMap readNodes(Document& document, Scene& scene) {
    return NodeReader(document, scene).run();
}

}  // namespace cutis::gltf
