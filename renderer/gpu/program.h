// Compute and raster programs: pipelines whose bindings are known by name from their SPIR-V.
#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/gpu/reflection.h"

namespace cutis::gpu {

class Device;

// The value of one `layout(constant_id = id) const`; int, float and bool as well as uint.
struct SpecializationConstant {
    std::uint32_t id = 0, bits = 0;
    SpecializationConstant(std::uint32_t constant, std::uint32_t value) : id(constant), bits(value) {}
    SpecializationConstant(std::uint32_t constant, int value)
        : id(constant), bits(std::bit_cast<std::uint32_t>(value)) {}
    SpecializationConstant(std::uint32_t constant, float value)
        : id(constant), bits(std::bit_cast<std::uint32_t>(value)) {}
    SpecializationConstant(std::uint32_t constant, bool value)
        : id(constant), bits(value ? VK_TRUE : VK_FALSE) {}
};
using Specialization = std::vector<SpecializationConstant>;

// Fixed state of a raster program. Triangle lists without vertex input: vertex shaders read storage buffers
// by gl_VertexIndex. Viewport and scissor are the render targets' size. No blending.
struct RasterState {
    std::vector<VkFormat> colorFormats{};
    VkFormat depthFormat = VK_FORMAT_UNDEFINED;  // undefined: no depth attachment
    bool depthTest = true, depthWrite = true;
    VkCompareOp depthCompare = VK_COMPARE_OP_LESS;
    bool depthClamp = false;
    float depthBias = 0, depthBiasSlope = 0, depthBiasClamp = 0;  // as vkCmdSetDepthBias
    VkCullModeFlags cull = VK_CULL_MODE_NONE;
    VkFrontFace frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
};

class Program {
  public:
    // `shaders`: one compute shader, or a vertex shader and perhaps a fragment shader. Use Device::program,
    // which keeps them. Throws std::logic_error for an unknown shader or constant, or stages that do not fit
    // together.
    Program(Device& device, const std::vector<std::string>& shaders, const RasterState* state,
            const Specialization& constants);
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    const std::string& name() const { return name_; }
    bool isCompute() const { return localSize_[0] > 0; }
    const std::vector<BindingInfo>& bindings() const { return bindings_; }
    std::uint32_t pushBytes() const { return pushBytes_; }
    VkShaderStageFlags stages() const { return stages_; }
    const std::array<std::uint32_t, 3>& localSize() const { return localSize_; }  // compute; else zeros
    const RasterState& rasterState() const { return rasterState_; }
    VkPipeline pipeline() const { return pipeline_; }
    VkPipelineLayout layout() const { return layout_; }
    VkDescriptorSetLayout setLayout() const { return setLayout_; }

  private:
    struct Stage;
    void addStage(const ShaderReflection& reflection);
    void createLayout();
    void createComputePipeline(const Stage& stage);
    void createRasterPipeline(const std::vector<Stage>& stages);
    void destroy();

    Device& device_;
    std::string name_;
    std::vector<BindingInfo> bindings_;  // by binding number
    std::uint32_t pushBytes_ = 0;
    VkShaderStageFlags stages_ = 0;
    std::array<std::uint32_t, 3> localSize_{};
    RasterState rasterState_;
    VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

}  // namespace cutis::gpu
