#include "renderer/gpu/program.h"

#include <algorithm>
#include <stdexcept>

#include "renderer/gpu/check.h"
#include "renderer/gpu/device.h"
#include "renderer/gpu/shader_library.h"

namespace cutis::gpu {
namespace {

// Specialization constants of one stage, in Vulkan's form.
struct StageConstants {
    std::vector<VkSpecializationMapEntry> entries;
    std::vector<std::uint32_t> values;
    VkSpecializationInfo info{};

    StageConstants(const Specialization& constants, const ShaderReflection& reflection) {
        for (const SpecializationConstant& constant : constants) {
            const auto& ids = reflection.constantIds;
            if (std::find(ids.begin(), ids.end(), constant.id) == ids.end()) continue;
            entries.push_back({constant.id, static_cast<std::uint32_t>(values.size() * 4), 4});
            values.push_back(constant.bits);
        }
        info = {static_cast<std::uint32_t>(entries.size()), entries.data(), values.size() * 4, values.data()};
    }
    StageConstants(const StageConstants&) = delete;
    StageConstants& operator=(const StageConstants&) = delete;
};

std::string joinNames(const std::vector<std::string>& names) {
    std::string joined;
    for (const std::string& name : names) joined += (joined.empty() ? "" : "+") + name;
    return joined;
}

}  // namespace

struct Program::Stage {
    ShaderReflection reflection;
    VkShaderModule module = VK_NULL_HANDLE;
    std::unique_ptr<StageConstants> constants;

    VkPipelineShaderStageCreateInfo info() const {
        VkPipelineShaderStageCreateInfo result{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
        result.stage = reflection.stage;
        result.module = module;
        result.pName = "main";
        result.pSpecializationInfo = &constants->info;
        return result;
    }
};

Program::Program(Device& device, const std::vector<std::string>& shaders, const RasterState* state,
                 const Specialization& constants)
    : device_(device), name_(joinNames(shaders)) {
    std::vector<Stage> stages;
    try {
        for (const std::string& shader : shaders) {
            const auto words = findShader(shader);
            if (words.empty()) throw std::logic_error("shader \"" + shader + "\" does not exist");
            Stage& stage = stages.emplace_back();
            stage.reflection = reflect(words, shader);
            addStage(stage.reflection);
            stage.constants = std::make_unique<StageConstants>(constants, stage.reflection);
            VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
            info.codeSize = words.size_bytes();
            info.pCode = words.data();
            check(vkCreateShaderModule(device_.handle(), &info, nullptr, &stage.module),
                  "loading shader " + shader);
        }
        for (const SpecializationConstant& constant : constants) {
            const bool known = std::any_of(stages.begin(), stages.end(), [&](const Stage& stage) {
                const auto& ids = stage.reflection.constantIds;
                return std::find(ids.begin(), ids.end(), constant.id) != ids.end();
            });
            if (!known) {
                throw std::logic_error("program " + name_ + " has no constant_id " +
                                       std::to_string(constant.id));
            }
        }
        const VkShaderStageFlags wanted = state ? VK_SHADER_STAGE_VERTEX_BIT : VK_SHADER_STAGE_COMPUTE_BIT;
        if ((stages_ & ~VkShaderStageFlags(VK_SHADER_STAGE_FRAGMENT_BIT)) != wanted ||
            (!state && stages.size() != 1)) {
            throw std::logic_error("program " + name_ + ": these stages do not make a program");
        }
        createLayout();
        if (state) {
            rasterState_ = *state;
            createRasterPipeline(stages);
        } else {
            localSize_ = stages[0].reflection.localSize;
            for (std::size_t i = 0; i < 3; ++i) {
                for (const SpecializationConstant& constant : constants) {
                    if (constant.id == stages[0].reflection.localSizeIds[i]) localSize_[i] = constant.bits;
                }
            }
            createComputePipeline(stages[0]);
        }
    } catch (...) {
        for (const Stage& stage : stages) vkDestroyShaderModule(device_.handle(), stage.module, nullptr);
        destroy();
        throw;
    }
    for (const Stage& stage : stages) vkDestroyShaderModule(device_.handle(), stage.module, nullptr);
    device_.setName(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(pipeline_), name_);
}

Program::~Program() {
    destroy();
}

void Program::destroy() {
    vkDestroyPipeline(device_.handle(), pipeline_, nullptr);
    vkDestroyPipelineLayout(device_.handle(), layout_, nullptr);
    vkDestroyDescriptorSetLayout(device_.handle(), setLayout_, nullptr);
}

void Program::addStage(const ShaderReflection& reflection) {
    if (stages_ & reflection.stage) throw std::logic_error("program " + name_ + " has a stage twice");
    stages_ |= reflection.stage;
    pushBytes_ = std::max(pushBytes_, reflection.pushBytes);
    for (const BindingInfo& added : reflection.bindings) {
        const auto same = std::find_if(bindings_.begin(), bindings_.end(), [&](const BindingInfo& b) {
            return b.binding == added.binding || b.name == added.name;
        });
        if (same == bindings_.end()) {
            bindings_.push_back(added);
            continue;
        }
        if (same->binding != added.binding || same->name != added.name || same->type != added.type ||
            same->count != added.count || same->viewType != added.viewType) {
            throw std::logic_error("program " + name_ + ": bindings \"" + same->name + "\" and \"" +
                                   added.name + "\" clash (one number, one name and one type each)");
        }
        same->stages |= added.stages;
        same->reads |= added.reads;
        same->writes |= added.writes;
        same->used |= added.used;
    }
}

void Program::createLayout() {
    std::sort(bindings_.begin(), bindings_.end(),
              [](const BindingInfo& a, const BindingInfo& b) { return a.binding < b.binding; });
    std::vector<VkDescriptorSetLayoutBinding> entries;
    for (const BindingInfo& b : bindings_) entries.push_back({b.binding, b.type, b.count, b.stages, nullptr});
    VkDescriptorSetLayoutCreateInfo setInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    setInfo.bindingCount = static_cast<std::uint32_t>(entries.size());
    setInfo.pBindings = entries.data();
    check(vkCreateDescriptorSetLayout(device_.handle(), &setInfo, nullptr, &setLayout_), "program " + name_);
    const VkPushConstantRange range{stages_, 0, (pushBytes_ + 3) / 4 * 4};
    if (range.size > device_.limits().maxPushConstantsSize) {
        throw std::logic_error("program " + name_ + ": " + std::to_string(pushBytes_) +
                               " bytes of push constants, the device takes " +
                               std::to_string(device_.limits().maxPushConstantsSize));
    }
    VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    info.setLayoutCount = 1;
    info.pSetLayouts = &setLayout_;
    info.pushConstantRangeCount = pushBytes_ ? 1 : 0;
    info.pPushConstantRanges = &range;
    check(vkCreatePipelineLayout(device_.handle(), &info, nullptr, &layout_), "program " + name_);
}

void Program::createComputePipeline(const Stage& stage) {
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage = stage.info();
    info.layout = layout_;
    check(vkCreateComputePipelines(device_.handle(), device_.pipelineCache(), 1, &info, nullptr, &pipeline_),
          "compiling program " + name_);
}

void Program::createRasterPipeline(const std::vector<Stage>& stages) {
    std::vector<VkPipelineShaderStageCreateInfo> stageInfos;
    for (const Stage& stage : stages) stageInfos.push_back(stage.info());
    const VkPipelineVertexInputStateCreateInfo vertexInput{
        VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    VkPipelineInputAssemblyStateCreateInfo assembly{
        VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
    viewport.viewportCount = viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
    raster.depthClampEnable = rasterState_.depthClamp;
    raster.polygonMode = VK_POLYGON_MODE_FILL;
    raster.cullMode = rasterState_.cull;
    raster.frontFace = rasterState_.frontFace;
    raster.depthBiasEnable = rasterState_.depthBias != 0 || rasterState_.depthBiasSlope != 0;
    raster.depthBiasConstantFactor = rasterState_.depthBias;
    raster.depthBiasSlopeFactor = rasterState_.depthBiasSlope;
    raster.depthBiasClamp = rasterState_.depthBiasClamp;
    raster.lineWidth = 1;
    VkPipelineMultisampleStateCreateInfo multisample{
        VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
    multisample.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    const bool hasDepth = rasterState_.depthFormat != VK_FORMAT_UNDEFINED;
    depth.depthTestEnable = hasDepth && rasterState_.depthTest;
    depth.depthWriteEnable = hasDepth && rasterState_.depthWrite;
    depth.depthCompareOp = rasterState_.depthCompare;
    VkPipelineColorBlendAttachmentState write{};
    write.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT |
                           VK_COLOR_COMPONENT_A_BIT;
    const std::vector<VkPipelineColorBlendAttachmentState> writes(rasterState_.colorFormats.size(), write);
    VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
    blend.attachmentCount = static_cast<std::uint32_t>(writes.size());
    blend.pAttachments = writes.data();
    const VkDynamicState dynamicStates[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
    dynamic.dynamicStateCount = 2;
    dynamic.pDynamicStates = dynamicStates;
    VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
    rendering.colorAttachmentCount = static_cast<std::uint32_t>(rasterState_.colorFormats.size());
    rendering.pColorAttachmentFormats = rasterState_.colorFormats.data();
    rendering.depthAttachmentFormat = rasterState_.depthFormat;

    VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
    info.stageCount = static_cast<std::uint32_t>(stageInfos.size());
    info.pStages = stageInfos.data();
    info.pVertexInputState = &vertexInput;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &multisample;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = layout_;
    check(vkCreateGraphicsPipelines(device_.handle(), device_.pipelineCache(), 1, &info, nullptr, &pipeline_),
          "compiling program " + name_);
}

}  // namespace cutis::gpu
