#include "renderer/scene/characters.h"

#include <algorithm>
#include <functional>

#include "renderer/core/error.h"
#include "renderer/core/suggest.h"
#include "renderer/core/unique_names.h"

namespace cutis {
namespace {

constexpr double kHeadMillimetres = 260;  // chin to crown with some neck: 99th percentile of adults
constexpr double kHeadShare = 1.0 / 8;    // of the height, where the scene's unit is not what mmPerUnit says
constexpr double kSetPieceRatio = 4;      // a mesh this much larger than a character is not a part of it
constexpr double kTouchShare = 0.02;      // boxes closer than this share of the smaller one's size touch

bool isSkin(const Scene& scene, const Primitive& primitive) {
    return primitive.material >= 0 && scene.materials[primitive.material].skin.has_value();
}

double largestExtent(const Bounds& bounds) {
    return bounds.empty() ? 0 : std::max({bounds.size().x, bounds.size().y, bounds.size().z});
}

bool touch(const Bounds& a, const Bounds& b) {
    if (a.empty() || b.empty()) return false;
    const double gap = kTouchShare * std::min(largestExtent(a), largestExtent(b));
    return glm::all(glm::lessThanEqual(a.min - gap, b.max)) &&
           glm::all(glm::lessThanEqual(b.min - gap, a.max));
}

bool contains(const Bounds& bounds, const glm::dvec3& p) {
    return glm::all(glm::lessThanEqual(bounds.min, p)) && glm::all(glm::lessThanEqual(p, bounds.max));
}

// World bounds of the node's vertices that `wanted` takes.
template <typename Wanted>
void extendBy(Bounds& bounds, const Scene& scene, int node, bool skinOnly, const Wanted& wanted) {
    const Node& n = scene.nodes[node];
    if (n.mesh < 0) return;
    for (const Primitive& primitive : scene.meshes[n.mesh].primitives) {
        if (skinOnly && !isSkin(scene, primitive)) continue;
        for (const glm::vec3& position : primitive.positions) {
            const glm::dvec3 p(n.world * glm::dvec4(position, 1));
            if (wanted(p)) bounds.extend(p);
        }
    }
}

Bounds boundsOf(const Scene& scene, int node, bool skinOnly) {
    Bounds bounds;
    extendBy(bounds, scene, node, skinOnly, [](const glm::dvec3&) { return true; });
    return bounds;
}

// A group of skin nodes that belong together, on the way to a Character.
struct Cluster {
    std::vector<int> anchors;  // topmost skin nodes, siblings when there are several
    Bounds bounds;
    int root = -1;  // topmost ancestor without another cluster; the first anchor when even its parent has one
};

class CharacterFinder {
  public:
    explicit CharacterFinder(Scene& scene) : scene_(scene), meshBounds_(scene.nodes.size()) {
        for (std::size_t i = 0; i < scene.nodes.size(); ++i) meshBounds_[i] = boundsOf(scene, int(i), false);
    }

    void run() {
        for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
            if (scene_.nodes[i].parent < 0) collect(int(i));
        }
        std::vector<int> clustersBelow(scene_.nodes.size(), 0);
        for (const Cluster& cluster : clusters_) {
            for (int n = cluster.anchors[0]; n >= 0; n = scene_.nodes[n].parent) ++clustersBelow[n];
        }
        scene_.characters.clear();
        scene_.nodeCharacter.assign(scene_.nodes.size(), -1);
        for (Cluster& cluster : clusters_) {
            cluster.root = cluster.anchors[0];
            for (int p = scene_.nodes[cluster.root].parent; p >= 0 && clustersBelow[p] == 1;
                 p = scene_.nodes[p].parent) {
                cluster.root = p;
            }
        }
        std::sort(clusters_.begin(), clusters_.end(),
                  [](const Cluster& a, const Cluster& b) { return a.anchors < b.anchors; });
        for (const Cluster& cluster : clusters_) addCharacter(cluster);
        for (std::size_t i = 0; i < clusters_.size(); ++i) shareSiblings(clusters_[i], int(i));
        nameCharacters();
    }

  private:
    // Appends the clusters of the subtree. updateWorldTransforms has refused trees too deep to recurse into.
    void collect(int node) {
        if (hasSkin(scene_, node)) {
            clusters_.push_back(clusterOf(node));
            return;
        }
        std::vector<Cluster> siblings;
        for (const int child : scene_.nodes[node].children) {
            if (hasSkin(scene_, child)) {
                mergeInto(siblings, clusterOf(child));
            } else {
                collect(child);
            }
        }
        clusters_.insert(clusters_.end(), siblings.begin(), siblings.end());
    }

    Cluster clusterOf(int anchor) {
        Cluster cluster;
        cluster.anchors = {anchor};
        forSubtree(anchor, [&](int n) { cluster.bounds.extend(boundsOf(scene_, n, true)); });
        return cluster;
    }

    // Joins `cluster` with all of `siblings` that it touches.
    static void mergeInto(std::vector<Cluster>& siblings, Cluster cluster) {
        for (std::size_t i = 0; i < siblings.size();) {
            if (!touch(siblings[i].bounds, cluster.bounds)) {
                ++i;
                continue;
            }
            cluster.anchors.insert(cluster.anchors.end(), siblings[i].anchors.begin(),
                                   siblings[i].anchors.end());
            cluster.bounds.extend(siblings[i].bounds);
            siblings.erase(siblings.begin() + std::ptrdiff_t(i));
            i = 0;  // the box grew: what was apart may touch it now
        }
        std::sort(cluster.anchors.begin(), cluster.anchors.end());
        siblings.push_back(std::move(cluster));
    }

    void addCharacter(const Cluster& cluster) {
        const int index = int(scene_.characters.size());
        Character character;
        character.root = cluster.root;
        std::vector<int> others;
        const auto take = [&](int n) {
            const bool other = scene_.nodes[n].mesh >= 0 && !hasSkin(scene_, n);
            if (other) others.push_back(n);
            if (!other) addTo(character, index, n);
        };
        if (cluster.root == cluster.anchors[0]) {
            for (const int anchor : cluster.anchors) forSubtree(anchor, take);
        } else {
            forSubtree(cluster.root, take);
        }
        for (bool grew = true; grew;) {
            grew = false;
            for (const int n : others) {
                if (scene_.nodeCharacter[n] >= 0 || !belongs(character.bounds, meshBounds_[n])) continue;
                addTo(character, index, n);
                grew = true;
            }
        }
        std::sort(character.nodes.begin(), character.nodes.end());
        scene_.characters.push_back(std::move(character));
    }

    void addTo(Character& character, int index, int node) {
        scene_.nodeCharacter[node] = index;
        character.bounds.extend(meshBounds_[node]);
        if (scene_.nodes[node].mesh >= 0) character.nodes.push_back(node);
    }

    static bool belongs(const Bounds& character, const Bounds& mesh) {
        return touch(character, mesh) && largestExtent(mesh) <= kSetPieceRatio * largestExtent(character);
    }

    // Where several characters are bare siblings, the eyes and hair beside them go to the one whose box holds
    // them.
    void shareSiblings(const Cluster& cluster, int index) {
        const int parent = scene_.nodes[cluster.root].parent;
        if (parent < 0) return;
        Character& character = scene_.characters[index];
        for (const int n : scene_.nodes[parent].children) {
            if (scene_.nodeCharacter[n] >= 0 || scene_.nodes[n].mesh < 0) continue;
            const bool inside = contains(cluster.bounds, meshBounds_[n].centre());
            if (inside && belongs(cluster.bounds, meshBounds_[n])) addTo(character, index, n);
        }
        std::sort(character.nodes.begin(), character.nodes.end());
    }

    void nameCharacters() {
        UniqueNames names;
        for (std::size_t i = 0; i < scene_.characters.size(); ++i) {
            Character& character = scene_.characters[i];
            std::string base = scene_.nodes[character.root].name;
            if (base.empty() && scene_.nodes[character.nodes[0]].mesh >= 0) {
                base = scene_.meshes[scene_.nodes[character.nodes[0]].mesh].name;
            }
            if (base.empty()) base = "character " + std::to_string(i + 1);
            character.name = names.take(base);
        }
    }

    template <typename Visit>
    void forSubtree(int node, const Visit& visit) {
        visit(node);
        for (const int child : scene_.nodes[node].children) forSubtree(child, visit);
    }

    Scene& scene_;
    std::vector<Bounds> meshBounds_;
    std::vector<Cluster> clusters_;
};

[[noreturn]] void refuseSubject(const Scene& scene, const std::string& subject) {
    std::vector<std::string> names;
    std::string list;
    for (const Character& character : scene.characters) {
        names.push_back(character.name);
        list += (list.empty() ? "there are '" : ", '") + character.name + "'";
    }
    throw Error("no character '" + subject + "'" + didYouMean(subject, names),
                list.empty() ? "the scene has none" : list, scene.file.string());
}

Bounds headOf(const Scene& scene, const std::vector<int>& nodes, bool skinOnly) {
    const auto everything = [](const glm::dvec3&) { return true; };
    Bounds all;
    double mmPerUnit = SkinMaterial{}.mmPerUnit;
    for (const int n : nodes) {
        extendBy(all, scene, n, skinOnly, everything);
        if (scene.nodes[n].mesh < 0) continue;
        for (const Primitive& primitive : scene.meshes[scene.nodes[n].mesh].primitives) {
            if (isSkin(scene, primitive)) mmPerUnit = scene.materials[primitive.material].skin->mmPerUnit;
        }
    }
    if (all.empty()) return all;
    const double height = std::max(kHeadMillimetres / mmPerUnit, kHeadShare * all.size().y);
    const double chin = all.max.y - height;
    Bounds head;
    for (const int n : nodes) {
        extendBy(head, scene, n, skinOnly, [&](const glm::dvec3& p) { return p.y >= chin; });
    }
    // A mesh with long triangles may have no vertex at the cut.
    head.min.y = std::max(chin, all.min.y);
    return head;
}

}  // namespace

void prepareScene(Scene& scene) {
    // Those found before may have been of other nodes.
    scene.characters.clear();
    scene.nodeCharacter.clear();
    updateWorldTransforms(scene);
    computeBounds(scene);
    findCharacters(scene);
}

void computeBounds(Scene& scene) {
    scene.bounds = {};
    for (Character& character : scene.characters) character.bounds = {};
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Bounds bounds = boundsOf(scene, int(i), false);
        scene.bounds.extend(bounds);
        const int character = i < scene.nodeCharacter.size() ? scene.nodeCharacter[i] : -1;
        if (character >= 0) scene.characters[character].bounds.extend(bounds);
    }
}

void findCharacters(Scene& scene) {
    CharacterFinder(scene).run();
}

bool hasSkin(const Scene& scene, int node) {
    const int mesh = scene.nodes[node].mesh;
    if (mesh < 0) return false;
    return std::ranges::any_of(scene.meshes[mesh].primitives,
                               [&](const Primitive& p) { return isSkin(scene, p); });
}

Bounds headBounds(const Scene& scene, const std::string& subject) {
    Bounds heads;
    bool found = false;
    for (const Character& character : scene.characters) {
        if (subject != "*" && subject != character.name) continue;
        heads.extend(headOf(scene, character.nodes, true));
        found = true;
    }
    if (!found && subject != "*") refuseSubject(scene, subject);
    if (!found) {
        std::vector<int> all(scene.nodes.size());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = int(i);
        heads = headOf(scene, all, false);
    }
    if (heads.empty()) throw Error("cannot find a head", "the scene has no geometry", scene.file.string());
    return heads;
}

}  // namespace cutis
