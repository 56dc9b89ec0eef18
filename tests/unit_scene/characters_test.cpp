#include "renderer/scene/characters.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "renderer/core/error.h"

namespace cutis {
namespace {

constexpr int kSkin = 0, kCloth = 1;

// Scenes of boxes: every mesh is a unit cube about the origin, placed by its node.
class Builder {
  public:
    Builder() {
        Material skin, cloth;
        skin.skin = SkinMaterial{};
        scene.materials = {skin, cloth};
        for (const int material : {kSkin, kCloth}) {
            Primitive cube;
            for (int i = 0; i < 8; ++i) cube.positions.push_back(glm::vec3(i & 1, i >> 1 & 1, i >> 2) - 0.5f);
            cube.normals.assign(8, glm::vec3(0, 0, 1));
            cube.indices = {0, 1, 2, 4, 5, 6, 1, 3, 7};
            cube.material = material;
            scene.meshes.push_back({"cube", {cube}});
        }
    }
    int group(const std::string& name, int parent = -1) { return add(name, parent, -1, glm::dmat4(1)); }
    int box(const std::string& name, int parent, int material, glm::dvec3 centre, glm::dvec3 size) {
        return add(name, parent, material, glm::scale(glm::translate(glm::dmat4(1), centre), size));
    }
    // A body of 1.5 m with a head of 0.25 m on it, standing at x.
    void person(int parent, double x) {
        box("body", parent, kSkin, {x, 0.75, 0}, {0.5, 1.5, 0.3});
        box("head", parent, kSkin, {x, 1.625, 0}, {0.2, 0.25, 0.2});
    }
    const Scene& prepare() {
        prepareScene(scene);
        return scene;
    }
    Scene scene;

  private:
    int add(const std::string& name, int parent, int mesh, const glm::dmat4& local) {
        const int index = int(scene.nodes.size());
        Node node;
        node.name = name;
        node.parent = parent;
        node.mesh = mesh;
        node.local = local;
        scene.nodes.push_back(node);
        if (parent >= 0) scene.nodes[parent].children.push_back(index);
        return index;
    }
};

std::vector<std::string> names(const Scene& scene) {
    std::vector<std::string> all;
    for (const Character& character : scene.characters) all.push_back(character.name);
    return all;
}

using Names = std::vector<std::string>;

TEST(Characters, ABareHeadIsOne) {
    Builder b;
    b.box("Lee", -1, kSkin, {0, 0, 0}, {0.2, 0.3, 0.2});
    EXPECT_EQ(names(b.prepare()), Names{"Lee"});
    EXPECT_EQ(b.scene.characters[0].root, 0);
    EXPECT_EQ(b.scene.nodeCharacter, std::vector<int>{0});
}

TEST(Characters, TreesAreApartEvenWhereTheyTouch) {
    Builder b;
    b.box("a", -1, kSkin, {0, 0, 0}, {1, 1, 1});
    b.box("b", -1, kSkin, {0.5, 0, 0}, {1, 1, 1});
    b.box("floor", -1, kCloth, {0, -0.5, 0}, {1, 0.1, 1});
    EXPECT_EQ(names(b.prepare()), (Names{"a", "b"}));
    EXPECT_EQ(b.scene.nodeCharacter, (std::vector<int>{0, 1, -1}));
}

TEST(Characters, PartsUnderOneNodeAreOnePerson) {
    Builder b;
    const int anna = b.group("Anna");
    b.person(anna, 0);
    b.box("hair", anna, kCloth, {0, 1.7, 0}, {0.25, 0.2, 0.25});
    EXPECT_EQ(names(b.prepare()), Names{"Anna"});
    EXPECT_EQ(b.scene.characters[0].nodes, (std::vector<int>{1, 2, 3}));
    EXPECT_NEAR(b.scene.characters[0].bounds.max.y, 1.8, 1e-6);
}

TEST(Characters, GroupsUnderACommonRootAreSeveral) {
    Builder b;
    const int root = b.group("RootNode"), people = b.group("people", root);
    b.box("floor", root, kCloth, {0, 0, 0}, {20, 0.01, 20});
    const int anna = b.group("Person", people), ben = b.group("Person", people);
    b.person(anna, 0);
    b.person(ben, 0.4);  // shoulder in shoulder: their boxes overlap, they are two all the same
    b.box("hat", ben, kCloth, {0.4, 1.8, 0}, {0.3, 0.2, 0.3});
    EXPECT_EQ(names(b.prepare()), (Names{"Person", "Person 2"}));
    EXPECT_EQ(b.scene.characters[0].root, anna);
    EXPECT_EQ(b.scene.characters[1].root, ben);
    EXPECT_EQ(b.scene.characters[1].nodes.size(), 3u);
    EXPECT_EQ(b.scene.nodeCharacter[2], -1) << "the floor is nobody's";
}

TEST(Characters, BareSiblingsAreOneWhereTheyTouchAndSeveralWhereNot) {
    Builder b;
    const int root = b.group("RootNode");
    b.person(root, 0);
    b.person(root, 3);
    b.box("eye", root, kCloth, {3, 1.65, 0.09}, {0.03, 0.03, 0.03});
    b.box("chair", root, kCloth, {1.5, 0.5, 0}, {0.5, 1, 0.5});
    EXPECT_EQ(names(b.prepare()), (Names{"body", "body 2"}));
    EXPECT_EQ(b.scene.nodeCharacter, (std::vector<int>{-1, 0, 0, 1, 1, 1, -1}));
}

TEST(Characters, TheClimbToTheRootTakesEyesAndLeavesTheSet) {
    Builder b;
    const int root = b.group("Sketch"), rig = b.group("rig", root), meshes = b.group("meshes", rig);
    b.box("face", meshes, kSkin, {0, 1.6, 0}, {0.2, 0.3, 0.2});
    b.box("eyes", rig, kCloth, {0, 1.6, 0.09}, {0.1, 0.03, 0.03});
    b.box("sky", root, kCloth, {0, 0, 0}, {100, 100, 100});
    b.box("lamp", root, kCloth, {0.8, 1.6, 0}, {0.1, 0.1, 0.1});
    EXPECT_EQ(names(b.prepare()), Names{"Sketch"});
    EXPECT_EQ(b.scene.characters[0].nodes, (std::vector<int>{3, 4}));
    EXPECT_NEAR(b.scene.characters[0].bounds.size().x, 0.2, 1e-6);
}

TEST(Characters, WhatHangsOnASkinNodeBelongsToIt) {
    Builder b;
    const int body = b.box("body", -1, kSkin, {0, 0, 0}, {1, 1, 1});
    b.box("head", body, kSkin, {0, 5, 0}, {1, 1, 1});
    EXPECT_EQ(names(b.prepare()), Names{"body"});
    EXPECT_EQ(b.scene.characters[0].nodes, (std::vector<int>{0, 1}));
}

TEST(Characters, NoSkinNoCharacter) {
    Builder b;
    b.box("box", -1, kCloth, {0, 0, 0}, {1, 1, 1});
    EXPECT_TRUE(b.prepare().characters.empty());
    EXPECT_EQ(b.scene.nodeCharacter, std::vector<int>{-1});
    EXPECT_EQ(b.scene.bounds.size(), glm::dvec3(1));
}

TEST(HeadBounds, IsTheTopOfAFigureAndAllOfAHead) {
    Builder b;
    b.person(b.group("Anna"), 0);
    b.box("Head", -1, kSkin, {3, 1, 0}, {0.2, 0.24, 0.2});
    b.box("hat", 0, kCloth, {0, 1.85, 0}, {0.3, 0.2, 0.3});
    b.prepare();
    const Bounds anna = headBounds(b.scene, "Anna"), head = headBounds(b.scene, "Head");
    // 1.75 m of skin: the top 0.26 m, without the hat.
    EXPECT_NEAR(anna.max.y, 1.75, 1e-6);
    EXPECT_NEAR(anna.min.y, 1.49, 1e-6);
    EXPECT_NEAR(anna.size().x, 0.5, 1e-6);  // the shoulders at 1.5 m just reach into it
    EXPECT_NEAR(head.size().y, 0.24, 1e-6);
    const Bounds all = headBounds(b.scene, "*");
    EXPECT_NEAR(all.min.y, 0.88, 1e-6);
    EXPECT_NEAR(all.max.x, 3.1, 1e-6);
}

TEST(HeadBounds, FollowsTheUnitOfTheScene) {
    Builder b;
    b.scene.materials[kSkin].skin->mmPerUnit = 10;  // centimetres
    b.box("tall", -1, kSkin, {0, 87.5, 0}, {50, 175, 30});
    b.prepare();
    EXPECT_NEAR(headBounds(b.scene, "*").size().y, 26, 1e-4);
    b.scene.materials[kSkin].skin->mmPerUnit = 1000;  // taken for 175 m: an eighth of it
    EXPECT_NEAR(headBounds(b.scene, "*").size().y, 175.0 / 8, 1e-4);
}

TEST(HeadBounds, AnUnknownSubjectIsRefusedNamingThoseThereAre) {
    Builder b;
    b.box("Anna", -1, kSkin, {0, 0, 0}, {1, 1, 1});
    b.box("Ben", -1, kSkin, {5, 0, 0}, {1, 1, 1});
    b.prepare();
    try {
        headBounds(b.scene, "Carl");
        FAIL() << "an unknown subject was accepted";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("'Anna', 'Ben'"), std::string::npos) << error.what();
    }
    EXPECT_THROW(headBounds(Scene{}, "*"), Error);
}

TEST(WorldTransforms, BadTreesAreRefused) {
    Builder cycle;
    cycle.group("a", cycle.group("b"));
    cycle.scene.nodes[0].parent = 1;
    cycle.scene.nodes[1].children = {0};
    EXPECT_THROW(cycle.prepare(), Error);

    Builder shared;
    shared.group("child", shared.group("a"));
    shared.group("b");
    shared.scene.nodes[2].children = {1};
    EXPECT_THROW(shared.prepare(), Error);

    Builder outside;
    outside.group("a");
    outside.scene.nodes[0].children = {7};
    EXPECT_THROW(outside.prepare(), Error);
}

}  // namespace
}  // namespace cutis
