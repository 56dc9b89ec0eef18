#include "renderer/passes/environment.h"

#include <algorithm>
#include <cmath>
#include <cstring>
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
constexpr std::uint64_t kCacheVersion = 3;  // grows with every change of what the shaders write

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
    // All mips of some layers, on their way from the device to the cache.
    struct Pending {
        std::uint64_t key;
        std::vector<gpu::Readback> mips;
    };

    // The cached contents of those layers, or those that `record` makes.
    template <class Record>
    void fill(const gpu::ImageView& layers, std::uint64_t key, Record record) {
        std::uint64_t bytes = 0;
        for (std::uint32_t mip = 0; mip < layers.mipCount(); ++mip) bytes += bytesOf(layers.mip(mip));
        const std::vector<std::byte> cached = readCache(kCacheKind, key);
        if (cached.size() == bytes) {
            std::span<const std::byte> rest(cached);
            for (std::uint32_t mip = 0; mip < layers.mipCount(); ++mip) {
                const std::uint64_t size = bytesOf(layers.mip(mip));
                commands_.upload(layers.mip(mip), rest.first(size));
                rest = rest.subspan(size);
            }
            return;
        }
        commands_.beginPass("environment");
        record();
        commands_.endPass();
        Pending pending{key, {}};
        for (std::uint32_t mip = 0; mip < layers.mipCount(); ++mip)
            pending.mips.push_back(commands_.readback(layers.mip(mip)));
        pending_.push_back(std::move(pending));
    }

    static std::uint64_t bytesOf(const gpu::ImageView& mip) {
        return std::uint64_t(mip.width()) * mip.height() * mip.layerCount() * sizeof(glm::vec4);
    }

    static void save(const Pending& pending) {
        std::vector<std::byte> payload;
        for (const gpu::Readback& mip : pending.mips)
            payload.insert(payload.end(), mip.bytes().begin(), mip.bytes().end());
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
        fill(maps.irradiance, key, [&] { sumSources(sources, buffer, nullptr, maps.irradiance); });
        if (skins.empty()) return;
        maps.matte = makeCube(device_, "environment matte", sources.face, std::uint32_t(skins.size()), 1);
        for (std::uint32_t i = 0; i < skins.size(); ++i) {
            const gpu::ImageView cube = maps.matte.layers(6 * i, 6);
            fill(cube, hashValue(skins[i], key), [&] { sumSources(sources, buffer, &skins[i], cube); });
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
            row = uploaded("albedo row", skin::directionalAlbedoRow(skin->roughness));
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

    void makeRadiance(EnvironmentMaps& maps) {
        EnvironmentParts parts = separateSources(environment_);
        maps.sources = std::move(parts.sources);
        maps.radiance = makeCube(device_, "environment radiance", shared::ENVIRONMENT_FACE,
                                 shared::ENVIRONMENT_CUBES, shared::ENVIRONMENT_MIPS);
        fill(maps.radiance, hashValue(shared::ENVIRONMENT_LOBES, key_), [&] {
            makeLobes(environment_, maps.radiance.layers(6 * shared::ENVIRONMENT_ALL, 12));
            makeLobes(parts.soft, maps.radiance.layers(6 * shared::ENVIRONMENT_SOFT, 12));
        });
    }

    // All lobes of one pair of cubes, each from the one two before it: variances add up.
    void makeLobes(const Environment& environment, const gpu::ImageView& pair) {
        struct Push {
            float sigma, step;
        };
        const auto image = [&](std::uint32_t lobe) { return pair.layers(6 * (lobe % 2), 6).mip(lobe / 2); };
        const auto spread = [](std::uint32_t lobe) {
            return lobe == 0 ? shared::ENVIRONMENT_SPREAD_0
                             : shared::ENVIRONMENT_SPREAD * std::exp2(0.5 * lobe);
        };
        resample(environment, image(0));
        const gpu::Program& program = device_.program("environment_filter.comp");
        for (std::uint32_t lobe = 1; lobe < shared::ENVIRONMENT_LOBES; ++lobe) {
            const std::uint32_t from = lobe < 2 ? 0 : lobe - 2;
            const gpu::ImageView target = image(lobe);
            // Interpolation of the result adds a sixth of a texel squared along each axis on average.
            const double texel = 2.0 / target.width(), interpolation = texel * texel / 6;
            const double own =
                std::sqrt(spread(lobe) * spread(lobe) - spread(from) * spread(from) - interpolation);
            commands_.dispatch(program,
                               {{"source", gpu::sampled(image(from), device_.sampler())}, {"target", target}},
                               Push{float(own), float(spread(lobe) / 2)},
                               gpu::groupsFor(program, target.width(), target.width(), 6));
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
