#include "renderer/frame/light_map_layers.h"

#include <gtest/gtest.h>

#include <set>

namespace cutis::test {
namespace {

std::vector<shared::LightView> viewsOf(const std::vector<int>& ids) {
    std::vector<shared::LightView> views;
    for (const int id : ids) {
        shared::LightView view{};
        view.worldToClip = glm::mat4(static_cast<float>(id));
        view.layer = 77;  // must not count
        views.push_back(view);
    }
    return views;
}

// Assigns and returns how many views must be drawn; every view has a layer of its own.
std::size_t drawn(LightMapLayers& layers, const std::vector<int>& ids, std::vector<std::uint32_t>* at = nullptr) {
    auto views = viewsOf(ids);
    const LightMapLayers::Assignment result = layers.assign(views, std::vector(views.size(), true));
    std::set<std::uint32_t> used;
    for (const shared::LightView& view : views) used.insert(view.layer);
    EXPECT_EQ(used.size(), ids.size());
    EXPECT_LT(*used.rbegin(), layers.layers());
    if (at) {
        at->clear();
        for (const shared::LightView& view : views) at->push_back(view.layer);
    }
    return result.draw.size();
}

TEST(LightMapLayers, OnlyNewViewsAreDrawn) {
    LightMapLayers layers;
    std::vector<std::uint32_t> before, after;
    EXPECT_EQ(drawn(layers, {1, 2, 3, 4}, &before), 4u);
    EXPECT_EQ(layers.layers(), 4u);
    EXPECT_EQ(drawn(layers, {1, 2, 3, 4}), 0u);
    EXPECT_EQ(drawn(layers, {1, 2, 9, 4}, &after), 1u) << "one moved";
    EXPECT_EQ(after, before) << "in the layer that was free";
    EXPECT_EQ(drawn(layers, {4, 9, 2, 1}), 0u) << "reordered";
    EXPECT_EQ(layers.layers(), 4u);
}

TEST(LightMapLayers, ViewsWhoseContentMovedAreDrawn) {
    LightMapLayers layers;
    const auto drawnWith = [&](const std::vector<std::uint64_t>& contents) {
        auto views = viewsOf({1, 2, 3});
        return layers.assign(views, {true, true, true}, contents).draw;
    };
    EXPECT_EQ(drawnWith({7, 8, 9}).size(), 3u);
    EXPECT_TRUE(drawnWith({7, 8, 9}).empty());
    EXPECT_EQ(drawnWith({7, 5, 9}), std::vector<std::uint32_t>{1});
    EXPECT_EQ(layers.layers(), 3u);
}

TEST(LightMapLayers, ALightThatWasOffComesBack) {
    LightMapLayers layers;
    drawn(layers, {1, 2, 3, 4});
    EXPECT_EQ(drawn(layers, {1, 3, 4}), 0u);
    EXPECT_EQ(drawn(layers, {1, 2, 3, 4}), 0u);
}

TEST(LightMapLayers, GrowsAndShrinksWithoutDrawingAnew) {
    LightMapLayers layers;
    drawn(layers, {1, 2});
    auto views = viewsOf({5, 2, 1, 6, 7});
    const LightMapLayers::Assignment grown = layers.assign(views, std::vector(views.size(), true));
    EXPECT_TRUE(grown.newImage);
    EXPECT_EQ(layers.layers(), 5u);
    EXPECT_EQ(grown.draw, (std::vector<std::uint32_t>{0, 3, 4}));
    ASSERT_EQ(grown.moves.size(), 2u);
    for (const LightMapLayers::Move& move : grown.moves) {
        // View 2 had layer 1, view 1 had layer 0.
        EXPECT_EQ(views[move.from == 1 ? 1 : 2].layer, move.to);
    }
    views = viewsOf({6});
    const LightMapLayers::Assignment shrunk = layers.assign(views, std::vector(views.size(), true));
    EXPECT_TRUE(shrunk.newImage);
    EXPECT_EQ(layers.layers(), 1u);
    EXPECT_TRUE(shrunk.draw.empty());
}

TEST(LightMapLayers, WhatNothingLooksUpHasNoLayer) {
    LightMapLayers layers;
    auto views = viewsOf({1, 2, 3, 4});
    LightMapLayers::Assignment result = layers.assign(views, {false, true, false, true});
    EXPECT_EQ(layers.layers(), 2u);
    EXPECT_EQ(result.draw, (std::vector<std::uint32_t>{1, 3}));
    EXPECT_NE(views[1].layer, views[3].layer);
    for (const shared::LightView& view : views) EXPECT_LT(view.layer, 2u);
    result = layers.assign(views, {false, true, true, true});
    EXPECT_EQ(result.draw, (std::vector<std::uint32_t>{2}));
    LightMapLayers none;
    EXPECT_TRUE(none.assign(views, std::vector(views.size(), false)).draw.empty());
    EXPECT_EQ(none.layers(), 1u);
}

}  // namespace
}  // namespace cutis::test
