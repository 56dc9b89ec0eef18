#include "renderer/gpu/reflection.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <stdexcept>

namespace cutis::gpu {
namespace {

// Numbers of the SPIR-V specification (version 1.6, sections 3.x), of those parts that matter here.
enum Op : std::uint32_t {
    kOpName = 5,
    kOpEntryPoint = 15,
    kOpExecutionMode = 16,
    kOpTypeInt = 21,
    kOpTypeFloat = 22,
    kOpTypeVector = 23,
    kOpTypeMatrix = 24,
    kOpTypeImage = 25,
    kOpTypeSampler = 26,
    kOpTypeSampledImage = 27,
    kOpTypeArray = 28,
    kOpTypeRuntimeArray = 29,
    kOpTypeStruct = 30,
    kOpTypePointer = 32,
    kOpConstant = 43,
    kOpSpecConstantTrue = 48,
    kOpSpecConstantFalse = 49,
    kOpSpecConstant = 50,
    kOpFunction = 54,
    kOpVariable = 59,
    kOpDecorate = 71,
    kOpMemberDecorate = 72,
    kOpExecutionModeId = 331
};
enum Decoration : std::uint32_t {
    kSpecId = 1,
    kArrayStride = 6,
    kMatrixStride = 7,
    kNonWritable = 24,
    kNonReadable = 25,
    kBinding = 33,
    kDescriptorSet = 34,
    kOffset = 35
};
enum StorageClass : std::uint32_t {
    kUniformConstant = 0,
    kUniform = 2,
    kPushConstant = 9,
    kStorageBuffer = 12
};
constexpr std::uint32_t kModeLocalSize = 17, kModeLocalSizeId = 38;
constexpr std::uint32_t kDim2D = 1, kDim3D = 2, kDimCube = 3;
constexpr std::uint32_t kMagic = 0x07230203, kHeaderWords = 5;

using Decorations =
    std::map<std::uint32_t, std::uint32_t>;  // decoration -> its first operand, 0 when it has none

// All that is known of one result id.
struct Id {
    std::uint32_t op = 0;
    std::vector<std::uint32_t> operands;  // of the instruction that defines it, without type and result
    std::uint32_t type = 0;
    std::string name;
    Decorations decorations;
    std::map<std::uint32_t, Decorations> members;
    bool used = false;  // by an instruction of a function
    bool has(Decoration d) const { return decorations.contains(d); }
    std::uint32_t get(Decoration d) const { return has(d) ? decorations.at(d) : 0; }
};

VkFormat storageFormat(std::uint32_t spirvFormat) {
    switch (spirvFormat) {
        case 0:
            return VK_FORMAT_UNDEFINED;
        case 1:
            return VK_FORMAT_R32G32B32A32_SFLOAT;
        case 2:
            return VK_FORMAT_R16G16B16A16_SFLOAT;
        case 3:
            return VK_FORMAT_R32_SFLOAT;
        case 4:
            return VK_FORMAT_R8G8B8A8_UNORM;
        case 5:
            return VK_FORMAT_R8G8B8A8_SNORM;
        case 6:
            return VK_FORMAT_R32G32_SFLOAT;
        case 7:
            return VK_FORMAT_R16G16_SFLOAT;
        case 8:
            return VK_FORMAT_B10G11R11_UFLOAT_PACK32;
        case 9:
            return VK_FORMAT_R16_SFLOAT;
        case 10:
            return VK_FORMAT_R16G16B16A16_UNORM;
        case 11:
            return VK_FORMAT_A2B10G10R10_UNORM_PACK32;
        case 12:
            return VK_FORMAT_R16G16_UNORM;
        case 13:
            return VK_FORMAT_R8G8_UNORM;
        case 14:
            return VK_FORMAT_R16_UNORM;
        case 15:
            return VK_FORMAT_R8_UNORM;
        case 16:
            return VK_FORMAT_R16G16B16A16_SNORM;
        case 17:
            return VK_FORMAT_R16G16_SNORM;
        case 21:
            return VK_FORMAT_R32G32B32A32_SINT;
        case 24:
            return VK_FORMAT_R32_SINT;
        case 25:
            return VK_FORMAT_R32G32_SINT;
        case 30:
            return VK_FORMAT_R32G32B32A32_UINT;
        case 31:
            return VK_FORMAT_R16G16B16A16_UINT;
        case 32:
            return VK_FORMAT_R8G8B8A8_UINT;
        case 33:
            return VK_FORMAT_R32_UINT;
        case 35:
            return VK_FORMAT_R32G32_UINT;
        case 36:
            return VK_FORMAT_R16G16_UINT;
        case 38:
            return VK_FORMAT_R16_UINT;
        case 39:
            return VK_FORMAT_R8_UINT;
        default:
            throw std::logic_error("image format " + std::to_string(spirvFormat) +
                                   " is not in the format table");
    }
}

class Parser {
  public:
    Parser(std::span<const std::uint32_t> words, const std::string& name) : words_(words) {
        result_.name = name;
    }

    ShaderReflection parse() {
        if (words_.size() < kHeaderWords || words_[0] != kMagic) fail("not a SPIR-V module");
        bool inFunction = false;
        for (std::size_t at = kHeaderWords; at < words_.size();) {
            const std::uint32_t length = words_[at] >> 16;
            if (length == 0 || at + length > words_.size()) fail("damaged SPIR-V module");
            const std::uint32_t op = words_[at] & 0xffff;
            const auto operands = words_.subspan(at + 1, length - 1);
            inFunction |= op == kOpFunction;
            if (inFunction) {
                // Literals may happen to equal an id: a variable then counts as used, which only means it
                // must be bound.
                for (const std::uint32_t operand : operands) {
                    if (const auto found = ids_.find(operand); found != ids_.end()) found->second.used = true;
                }
            } else {
                readDeclaration(op, operands);
            }
            at += length;
        }
        for (const auto& [id, variable] : ids_) {
            if (variable.op == kOpVariable) addVariable(variable);
            if (variable.has(kSpecId)) result_.constantIds.push_back(variable.get(kSpecId));
        }
        std::sort(result_.bindings.begin(), result_.bindings.end(),
                  [](const auto& a, const auto& b) { return a.binding < b.binding; });
        resolveLocalSize();
        return std::move(result_);
    }

  private:
    [[noreturn]] void fail(const std::string& why) const {
        throw std::logic_error("shader " + result_.name + ": " + why);
    }

    void readDeclaration(std::uint32_t op, std::span<const std::uint32_t> operands) {
        const auto text = [&](std::size_t first) {
            const auto* begin = reinterpret_cast<const char*>(operands.data() + first);
            return std::string(begin, strnlen(begin, (operands.size() - first) * 4));
        };
        switch (op) {
            case kOpName:
                ids_[operands[0]].name = text(1);
                break;
            case kOpEntryPoint:
                result_.stage = operands[0] == 0   ? VK_SHADER_STAGE_VERTEX_BIT
                                : operands[0] == 4 ? VK_SHADER_STAGE_FRAGMENT_BIT
                                : operands[0] == 5 ? VK_SHADER_STAGE_COMPUTE_BIT
                                                   : throw std::logic_error("shader stage not supported");
                break;
            case kOpExecutionMode:
                if (operands[1] == kModeLocalSize)
                    result_.localSize = {operands[2], operands[3], operands[4]};
                break;
            case kOpExecutionModeId:
                if (operands[1] == kModeLocalSizeId)
                    localSizeConstants_ = {operands[2], operands[3], operands[4]};
                break;
            case kOpDecorate:
                ids_[operands[0]].decorations[operands[1]] = operands.size() > 2 ? operands[2] : 0;
                break;
            case kOpMemberDecorate:
                ids_[operands[0]].members[operands[1]][operands[2]] = operands.size() > 3 ? operands[3] : 0;
                break;
            case kOpConstant:
            case kOpSpecConstant:
            case kOpVariable:
            case kOpSpecConstantTrue:
            case kOpSpecConstantFalse:
                define(op, operands[1], operands[0], operands.subspan(2));
                break;
            case kOpTypeInt:
            case kOpTypeFloat:
            case kOpTypeVector:
            case kOpTypeMatrix:
            case kOpTypeImage:
            case kOpTypeSampler:
            case kOpTypeSampledImage:
            case kOpTypeArray:
            case kOpTypeRuntimeArray:
            case kOpTypeStruct:
            case kOpTypePointer:
                define(op, operands[0], 0, operands.subspan(1));
                break;
            default:
                break;
        }
    }

    void define(std::uint32_t op, std::uint32_t id, std::uint32_t type,
                std::span<const std::uint32_t> operands) {
        Id& entry = ids_[id];
        entry.op = op;
        entry.type = type;
        entry.operands.assign(operands.begin(), operands.end());
    }

    const Id& at(std::uint32_t id) const {
        const auto found = ids_.find(id);
        if (found == ids_.end()) fail("damaged SPIR-V module");
        return found->second;
    }

    void addVariable(const Id& variable) {
        const std::uint32_t storage = variable.operands[0];
        // Variables of the shader's own may have any type.
        if (storage != kPushConstant && storage != kUniformConstant && storage != kUniform &&
            storage != kStorageBuffer) {
            return;
        }
        const Id* type = &at(at(variable.type).operands[1]);  // what the pointer points to
        if (storage == kPushConstant) {
            result_.pushBytes = sizeOf(*type, {});
            return;
        }
        BindingInfo info;
        info.name = variable.name;
        info.binding = variable.get(kBinding);
        info.used = variable.used;
        info.stages = result_.stage;
        if (variable.get(kDescriptorSet) != 0) fail("binding \"" + info.name + "\" is not in set 0");
        if (type->op == kOpTypeArray) {
            info.count = at(type->operands[1]).operands[0];
            type = &at(type->operands[0]);
        } else if (type->op == kOpTypeRuntimeArray) {
            fail("binding \"" + info.name + "\" is an array without length");
        }
        if (info.name.empty()) info.name = type->name;
        if (type->op == kOpTypeStruct) {
            describeBlock(info, variable, *type, storage);
        } else {
            describeImage(info, variable, *type);
        }
        result_.bindings.push_back(std::move(info));
    }

    void describeBlock(BindingInfo& info, const Id& variable, const Id& block, std::uint32_t storage) const {
        if (storage == kUniform) {
            info.type = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
            return;
        }
        info.type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        // `readonly buffer` decorates each member.
        const auto all = [&](Decoration d) {
            if (variable.has(d)) return true;
            for (std::uint32_t i = 0; i < block.operands.size(); ++i) {
                const auto member = block.members.find(i);
                if (member == block.members.end() || !member->second.contains(d)) return false;
            }
            return true;
        };
        info.writes = !all(kNonWritable);
        info.reads = !all(kNonReadable);
    }

    void describeImage(BindingInfo& info, const Id& variable, const Id& type) const {
        const Id* image = &type;
        if (type.op == kOpTypeSampledImage) image = &at(type.operands[0]);
        if (image->op != kOpTypeImage)
            fail("binding \"" + info.name + "\" is of a type that is not supported");
        const std::uint32_t dim = image->operands[1], arrayed = image->operands[3],
                            sampled = image->operands[5];
        switch (dim) {
            case kDim2D:
                info.viewType = arrayed ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
                break;
            case kDimCube:
                info.viewType = arrayed ? VK_IMAGE_VIEW_TYPE_CUBE_ARRAY : VK_IMAGE_VIEW_TYPE_CUBE;
                break;
            case kDim3D:
                info.viewType = VK_IMAGE_VIEW_TYPE_3D;
                break;
            default:
                fail("binding \"" + info.name + "\" has a dimension that is not supported");
        }
        const Id& texel = at(image->operands[0]);
        info.kind = texel.op == kOpTypeFloat ? TexelKind::real
                    : texel.operands[1] == 0 ? TexelKind::unsignedInteger
                                             : TexelKind::signedInteger;
        if (type.op == kOpTypeSampledImage) {
            info.type = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        } else if (sampled == 2) {
            info.type = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
            info.format = storageFormat(image->operands[6]);
            info.reads = !variable.has(kNonReadable);
            info.writes = !variable.has(kNonWritable);
        } else {
            info.type = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;  // `texture2D`, read by texelFetch
        }
    }

    // Bytes of a type in a block with explicit layout; `member` has the matrix stride.
    std::uint32_t sizeOf(const Id& type, const Decorations& member) const {
        switch (type.op) {
            case kOpTypeInt:
            case kOpTypeFloat:
                return type.operands[0] / 8;
            case kOpTypeVector:
                return type.operands[1] * sizeOf(at(type.operands[0]), {});
            case kOpTypeMatrix: {
                const auto stride = member.find(kMatrixStride);
                if (stride == member.end()) fail("a matrix without stride");
                // The last column is not padded to the stride.
                return (type.operands[1] - 1) * stride->second + sizeOf(at(type.operands[0]), {});
            }
            case kOpTypeArray:
                return at(type.operands[1]).operands[0] * type.get(kArrayStride);
            case kOpTypeStruct: {
                std::uint32_t size = 0;
                for (std::uint32_t i = 0; i < type.operands.size(); ++i) {
                    const auto decorations = type.members.find(i);
                    if (decorations == type.members.end()) fail("a block without offsets");
                    const auto offset = decorations->second.find(kOffset);
                    if (offset == decorations->second.end()) fail("a block without offsets");
                    size = std::max(size, offset->second + sizeOf(at(type.operands[i]), decorations->second));
                }
                return size;
            }
            default:
                fail("a push constant of a type that is not supported");
        }
    }

    void resolveLocalSize() {
        if (result_.stage != VK_SHADER_STAGE_COMPUTE_BIT) return;
        for (std::size_t i = 0; i < localSizeConstants_.size(); ++i) {
            const Id& constant = at(localSizeConstants_[i]);
            result_.localSize[i] = constant.operands[0];
            if (constant.has(kSpecId)) result_.localSizeIds[i] = constant.get(kSpecId);
        }
    }

    std::span<const std::uint32_t> words_;
    std::map<std::uint32_t, Id> ids_;
    std::vector<std::uint32_t> localSizeConstants_;
    ShaderReflection result_;
};

}  // namespace

ShaderReflection reflect(std::span<const std::uint32_t> words, const std::string& name) {
    return Parser(words, name).parse();
}

}  // namespace cutis::gpu
