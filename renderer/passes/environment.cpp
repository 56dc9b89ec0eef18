#include "renderer/passes/environment.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "renderer/core/files.h"
#include "renderer/gpu/commands.h"
#include "renderer/passes/environment_sources.h"
#include "renderer/skin/specular.h"
#include "shaders/shared/environment.h"

namespace cutis {
namespace {

constexpr const char* kCacheKind = "environment";
constexpr std::uint64_t kCacheVersion = 4;  // grows with every change of what the shaders write

template <class T>
std::uint64_t hashValue(const T& value, std::uint64_t seed) {
    return hashBytes(std::as_bytes(std::span(&value, 1)), seed);
}

std::uint64_t hashEnvironment(const Environment& environment) {
    std::uint64_t key = hashBytes(std::as_bytes(std::span(environment.radiance)));
    key = hashValue(environment.width, key);
    key = hashValue(environment.height, key);
    return hashValue(kCacheVersion, key);
}

gpu::Image makeCube(gpu::Device& device, const char* name, std::uint32_t size, std::uint32_t cubes,
                    std::uint32_t mips) {
    return gpu::Image(device, {.name = name,
                               .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                               .width = size,
                               .height = size,
                               .layers = 6 * cubes,
                               .mips = mips,
                               .cube = true});
}

// Records into one submission, taking from the cache what is there.
class Prefilter {
  public:
    Prefilter(gpu::Device& device, const Environment& environment)
        : device_(device), environment_(environment), key_(hashEnvironment(environment)), commands_(device) {}

    EnvironmentMaps run(std::span<const SkinSpecular> skins) {
        EnvironmentMaps maps;
        makeIrradiance(maps, skins);
        makeRadiance(maps);
        commands_.submitAndWait();
        for (const auto& timing : commands_.timings()) maps.gpuMs += timing.milliseconds;
        for (const Pending& pending : pending_) save(pending);
        return maps;
    }

  private:
    // Cubes on their way from the device to the cache.
    struct Pending {
        std::uint64_t key;
        std::vector<gpu::Readback> cubes;
    };

    // The cached contents of those cubes, one mip of each, or those that `record` makes.
    template <class Record>
    void fill(const std::vector<gpu::ImageView>& cubes, std::uint64_t key, Record record) {
        std::uint64_t bytes = 0;
        for (const gpu::ImageView& cube : cubes) bytes += bytesOf(cube);
        const std::vector<std::byte> cached = readCache(kCacheKind, key);
        if (cached.size() == bytes) {
            std::span<const std::byte> rest(cached);
            for (const gpu::ImageView& cube : cubes) {
                const std::uint64_t size = bytesOf(cube);
                commands_.upload(cube, rest.first(size));
                rest = rest.subspan(size);
            }
            return;
        }
        commands_.beginPass("environment");
        record();
        commands_.endPass();
        Pending pending{key, {}};
        for (const gpu::ImageView& cube : cubes) pending.cubes.push_back(commands_.readback(cube));
        pending_.push_back(std::move(pending));
    }

    static std::uint64_t bytesOf(const gpu::ImageView& mip) {
        return std::uint64_t(mip.width()) * mip.height() * mip.layerCount() * sizeof(glm::vec4);
    }

    static void save(const Pending& pending) {
        std::vector<std::byte> payload;
        for (const gpu::Readback& cube : pending.cubes)
            payload.insert(payload.end(), cube.bytes().begin(), cube.bytes().end());
        writeCache(kCacheKind, pending.key, payload);
    }

    template <class T>
    gpu::Buffer uploaded(const char* name, const std::vector<T>& values) {
        gpu::Buffer buffer(device_, {.name = name, .bytes = values.size() * sizeof(T)});
        if (!values.empty()) commands_.upload(buffer, values);
        return buffer;
    }

    void makeIrradiance(EnvironmentMaps& maps, std::span<const SkinSpecular> skins) {
        const EnvironmentSources sources = environmentSources(environment_);
        const gpu::Buffer buffer = uploaded("environment clusters", sources.sources);
        const std::uint64_t key = hashValue(sources.face, key_);
        maps.irradiance = makeCube(device_, "environment irradiance", sources.face, 1, 1);
        fill({maps.irradiance}, key, [&] { sumSources(sources, buffer, nullptr, maps.irradiance); });
        if (skins.empty()) return;
        maps.matte = makeCube(device_, "environment matte", sources.face, std::uint32_t(skins.size()), 1);
        for (std::uint32_t i = 0; i < skins.size(); ++i) {
            const gpu::ImageView cube = maps.matte.layers(6 * i, 6);
            fill({cube}, hashValue(skins[i], key), [&] { sumSources(sources, buffer, &skins[i], cube); });
        }
    }

    // Irradiance, or the matte of `skin`: faint sources on a coarse cube, then all of it on the target.
    void sumSources(const EnvironmentSources& sources, const gpu::Buffer& buffer, const SkinSpecular* skin,
                    const gpu::ImageView& target) {
        struct Push {
            std::uint32_t first, count;
            float largestAlbedo;
        };
        const std::string variant = skin ? "+MATTE" : "";
        const float largestAlbedo = skin ? 1 / std::max(skin->scale, 1e-6f) : 0;
        const gpu::Image coarse = makeCube(device_, "coarse irradiance", kCoarseFace, 1, 1);
        gpu::Bindings bindings{{"SourceBuffer", buffer}, {"target", coarse}};
        gpu::Buffer row;
        if (skin) {
            row = uploaded("albedo row", skin::mixedAlbedoRow(skin->roughness, skin->narrower, skin->weight));
            bindings.push_back({"AlbedoTableBuffer", row});
        }
        const gpu::Program& program = device_.program("environment_irradiance.comp" + variant);
        commands_.dispatch(program, bindings, Push{0, sources.faint, largestAlbedo},
                           gpu::groupsFor(program, kCoarseFace, kCoarseFace));
        bindings[1] = {"target", target};
        bindings.push_back({"coarse", gpu::sampled(coarse, device_.sampler())});
        const gpu::Program& fine = device_.program("environment_irradiance.comp" + variant + "+FINE");
        const auto bright = std::uint32_t(sources.sources.size()) - sources.faint;
        commands_.dispatch(fine, bindings, Push{sources.faint, bright, largestAlbedo},
                           gpu::groupsFor(fine, sources.face, sources.face));
    }

    // One lobe of a set, six faces.
    static gpu::ImageView lobeCube(const EnvironmentMaps& maps, std::uint32_t set, std::uint32_t lobe) {
        return maps.radiance.layers(6 * shared::environmentLobeCube(set, lobe), 6)
            .mip(shared::environmentLobeMip(lobe));
    }

    void makeRadiance(EnvironmentMaps& maps) {
        using namespace shared;
        maps.radiance =
            makeCube(device_, "environment radiance", ENVIRONMENT_FACE, ENVIRONMENT_CUBES, ENVIRONMENT_MIPS);
        commands_.clear(maps.radiance, {0, 0, 0, 0});  // cubes of the fine lobes have no coarse ones
        const std::uint64_t key = hashValue(ENVIRONMENT_LOBES, key_);
        fill(lobesOf(maps, ENVIRONMENT_ALL), key, [&] { makeLobes(environment_, maps, ENVIRONMENT_ALL); });
        maps.mediumSources = makeSet(maps, ENVIRONMENT_MEDIUM, kMediumSourceSpread, key);
        maps.roughSources = makeSet(maps, ENVIRONMENT_ROUGH, kRoughSourceSpread, key);
    }

    static std::vector<gpu::ImageView> lobesOf(const EnvironmentMaps& maps, std::uint32_t set) {
        std::vector<gpu::ImageView> cubes;
        for (std::uint32_t lobe = shared::environmentFirstLobe(set); lobe < shared::ENVIRONMENT_LOBES; ++lobe)
            cubes.push_back(lobeCube(maps, set, lobe));
        return cubes;
    }

    // Fills a set that lacks the environment's compact sources, and gives those.
    std::vector<shared::EnvironmentSource> makeSet(const EnvironmentMaps& maps, std::uint32_t set,
                                                   double maxSpread, std::uint64_t key) {
        key = hashValue(maxSpread, hashValue(set, key));
        const std::vector<std::byte> cached = readCache("environment-sources", key);
        std::vector<shared::EnvironmentSource> sources(cached.size() / sizeof(shared::EnvironmentSource));
        if (!sources.empty()) std::memcpy(sources.data(), cached.data(), sources.size() * sizeof(sources[0]));
        std::optional<EnvironmentParts> parts;
        if (sources.empty()) {
            parts = separateSources(environment_, maxSpread);
            sources = parts->sources;
            writeCache("environment-sources", key, std::as_bytes(std::span(sources)));
        }
        fill(lobesOf(maps, set), key, [&] {
            if (!parts) parts = separateSources(environment_, maxSpread);
            makeLobes(parts->rest, maps, set);
        });
        return sources;
    }

    // All lobes of a set, each from the one before it: variances add up. Those that the set does not keep are
    // made aside.
    void makeLobes(const Environment& environment, const EnvironmentMaps& maps, std::uint32_t set) {
        struct Push {
            float sigma, reach;
            std::int32_t rings;
        };
        constexpr double kReach = 3.2;  // of the Gaussian's own σ
        // What is left of the variance of a Gaussian in two dimensions that ends there.
        const double edge = std::exp(-kReach * kReach / 2),
                     kept = 1 - kReach * kReach / 2 * edge / (1 - edge);
        const auto spread = [](std::uint32_t lobe) {
            return lobe == 0 ? shared::ENVIRONMENT_SPREAD_0
                             : shared::ENVIRONMENT_SPREAD * std::exp2(0.5 * lobe);
        };
        std::vector<gpu::Image> aside;
        gpu::ImageView from;
        const gpu::Program& program = device_.program("environment_filter.comp");
        for (std::uint32_t lobe = 0; lobe < shared::ENVIRONMENT_LOBES; ++lobe) {
            gpu::ImageView target;
            if (lobe < shared::environmentFirstLobe(set)) {
                aside.push_back(makeCube(device_, "environment aside", shared::ENVIRONMENT_FACE, 1, 1));
                target = aside.back();
            } else {
                target = lobeCube(maps, set, lobe);
            }
            if (lobe == 0) {
                resample(environment, target);
            } else {
                // Interpolation of the result adds a sixth of a texel squared along each axis on average.
                const double texel = 2.0 / target.width(), interpolation = texel * texel / 6;
                const double before = spread(lobe - 1), all = spread(lobe);
                const double own = std::sqrt((all * all - before * before - interpolation) / kept);
                // Samples no further apart than lobe 0 has texels; what is smooth already needs fewer.
                const std::int32_t rings = lobe == 1 ? 5 : 3;
                commands_.dispatch(program,
                                   {{"source", gpu::sampled(from, device_.sampler())}, {"target", target}},
                                   Push{float(own), float(kReach * own), rings},
                                   gpu::groupsFor(program, target.width(), target.width(), 6));
            }
            from = target;
        }
    }

    void resample(const Environment& environment, const gpu::ImageView& target) {
        const EnvironmentPeaks split = separatePeaks(environment);
        const gpu::Image latLong(device_, {.name = "environment",
                                           .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                           .width = std::uint32_t(split.width),
                                           .height = std::uint32_t(split.height)});
        commands_.upload(latLong, split.rest);
        const gpu::Buffer peaks = uploaded("environment peaks", split.peaks);
        const gpu::Program& program = device_.program("environment_radiance.comp");
        const VkSampler around = device_.sampler({.u = VK_SAMPLER_ADDRESS_MODE_REPEAT});
        commands_.dispatch(
            program,
            {{"latLong", gpu::sampled(latLong, around)}, {"SourceBuffer", peaks}, {"target", target}},
            std::uint32_t(split.peaks.size()), gpu::groupsFor(program, target.width(), target.height()));
    }

    gpu::Device& device_;
    const Environment& environment_;
    std::uint64_t key_;
    gpu::Commands commands_;
    std::vector<Pending> pending_;
};

}  // namespace

EnvironmentMaps prefilterEnvironment(gpu::Device& device, const Environment& environment,
                                     std::span<const SkinSpecular> skins) {
    return Prefilter(device, environment).run(skins);
}

}  // namespace cutis
