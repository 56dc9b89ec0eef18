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
constexpr std::uint64_t kCacheVersion = 1;  // grows with every change of what the shaders write

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

gpu::Groups groupsForCube(const gpu::Program& program, std::uint32_t size) {
    return gpu::groupsFor(program, size, size, 6);
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
        struct Push {
            std::uint32_t sourceCount;
            float largestAlbedo;
        };
        const std::vector<shared::EnvironmentSource> sources = environmentSources(environment_);
        const std::uint32_t size = irradianceFaceSize(sources);
        const gpu::Buffer buffer = uploaded("environment clusters", sources);
        const auto count = std::uint32_t(sources.size());
        maps.irradiance = makeCube(device_, "environment irradiance", size, 1, 1);
        fill(maps.irradiance, hashValue(size, key_), [&] {
            const gpu::Program& program = device_.program("environment_irradiance.comp");
            commands_.dispatch(program, {{"SourceBuffer", buffer}, {"target", maps.irradiance}},
                               Push{count, 0}, groupsForCube(program, size));
        });
        if (skins.empty()) return;
        maps.matte = makeCube(device_, "environment matte", size, std::uint32_t(skins.size()), 1);
        for (std::uint32_t i = 0; i < skins.size(); ++i) {
            const gpu::ImageView cube = maps.matte.layers(6 * i, 6);
            fill(cube, hashValue(skins[i], hashValue(size, key_)), [&] {
                const gpu::Buffer row =
                    uploaded("albedo row", skin::directionalAlbedoRow(skins[i].roughness));
                const gpu::Program& program = device_.program("environment_irradiance.comp+MATTE");
                commands_.dispatch(
                    program, {{"SourceBuffer", buffer}, {"target", cube}, {"AlbedoTableBuffer", row}},
                    Push{count, 1 / std::max(skins[i].scale, 1e-6f)}, groupsForCube(program, size));
            });
        }
    }

    void makeRadiance(EnvironmentMaps& maps) {
        struct FilterPush {
            float sigma, step;
        };
        const std::uint32_t size = shared::ENVIRONMENT_FACE, levels = shared::ENVIRONMENT_LEVELS;
        maps.radiance = makeCube(device_, "environment radiance", size, 1, levels);
        fill(maps.radiance, hashValue(levels, hashValue(size, key_)), [&] {
            resample(maps.radiance.mip(0));
            const VkSampler sampler = device_.sampler();
            double sigma = shared::ENVIRONMENT_SPREAD_0;
            for (std::uint32_t level = 1; level < levels; ++level) {
                // Variances of the source, of its interpolation (a sixth of a texel squared on average) and
                // of this step's lobe add up to that of the level.
                const double texel = 2.0 / (size >> (level - 1));
                const double wanted = shared::ENVIRONMENT_SPREAD * std::exp2(level);
                const double interpolated = level == 1 ? 0 : texel * texel / 6;
                const double own = std::sqrt(wanted * wanted - sigma * sigma - interpolated);
                sigma = wanted;
                const gpu::Program& program = device_.program("environment_filter.comp");
                commands_.dispatch(program,
                                   {{"source", gpu::sampled(maps.radiance.mip(level - 1), sampler)},
                                    {"target", maps.radiance.mip(level)}},
                                   FilterPush{float(own), float(texel)},
                                   groupsForCube(program, size >> level));
            }
        });
    }

    void resample(const gpu::ImageView& target) {
        const EnvironmentPeaks split = separatePeaks(environment_);
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
            std::uint32_t(split.peaks.size()), groupsForCube(program, target.width()));
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
