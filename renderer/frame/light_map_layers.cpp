#include "renderer/frame/light_map_layers.h"

#include <algorithm>
#include <map>

#include "renderer/core/hash.h"

namespace cutis {
namespace {

// Of what is drawn: the layer is only where.
std::uint64_t keyOf(const shared::LightView& view, std::uint64_t content) {
    return ContentHash().add(view.worldToClip, view.depthToDistance, view.texelSize, content).value();
}

}  // namespace

LightMapLayers::Assignment LightMapLayers::assign(std::vector<shared::LightView>& views,
                                                  const std::vector<bool>& needed,
                                                  const std::vector<std::uint64_t>& contents) {
    constexpr std::uint32_t kNone = 0xffffffffu;
    Assignment result;
    std::vector<std::uint64_t> keys;
    for (std::size_t v = 0; v < views.size(); ++v) keys.push_back(keyOf(views[v], contents.empty() ? 0 : contents[v]));
    std::map<std::uint64_t, std::uint32_t> known;
    for (std::uint32_t layer = 0; layer < held_.size(); ++layer) {
        if (held_[layer]) known.emplace(*held_[layer], layer);
    }
    std::vector<bool> used(held_.size(), false);
    std::size_t missing = 0, wanted = 1;  // one layer at the least, for views to point at
    for (std::size_t v = 0; v < views.size(); ++v) {
        if (!needed[v]) continue;
        ++wanted;
        const auto found = known.find(keys[v]);
        views[v].layer = found == known.end() ? kNone : found->second;
        if (found == known.end()) ++missing;
        else used[views[v].layer] = true;
    }
    if (wanted > 1) --wanted;
    const auto free = static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
    // Layers that lights left are kept for those that come, up to as many as are in use.
    result.newImage = missing > free || held_.size() > 2 * wanted || held_.empty();
    if (result.newImage) {
        std::vector<std::optional<std::uint64_t>> moved;
        std::vector<std::uint32_t> place(held_.size(), kNone);
        for (std::uint32_t layer = 0; layer < held_.size(); ++layer) {
            if (!used[layer]) continue;
            place[layer] = static_cast<std::uint32_t>(moved.size());
            result.moves.push_back({layer, place[layer]});
            moved.push_back(held_[layer]);
        }
        for (std::size_t v = 0; v < views.size(); ++v) {
            if (needed[v] && views[v].layer != kNone) views[v].layer = place[views[v].layer];
        }
        used.assign(moved.size(), true);
        moved.resize(std::max<std::size_t>(moved.size() + missing, 1));
        used.resize(moved.size(), false);
        held_ = std::move(moved);
    }
    // Layers that hold nothing first: a light that was turned off may come back.
    std::vector<std::uint32_t> empty, stale;
    for (std::uint32_t layer = 0; layer < held_.size(); ++layer) {
        if (!used[layer]) (held_[layer] ? stale : empty).push_back(layer);
    }
    empty.insert(empty.end(), stale.begin(), stale.end());
    auto next = empty.begin();
    for (std::uint32_t v = 0; v < views.size(); ++v) {
        if (!needed[v]) views[v].layer = 0;
        if (views[v].layer != kNone) continue;
        views[v].layer = *next++;
        held_[views[v].layer] = keys[v];
        result.draw.push_back(v);
    }
    return result;
}

}  // namespace cutis
