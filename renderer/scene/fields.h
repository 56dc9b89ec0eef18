// The one table of what can be set: how each quantity is called in files and in panels, its unit, its range
// and what it means. The rig format, `material.extras.skin`, the command line's --help and the viewer's
// panels read it.
#pragma once

#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "renderer/scene/light_samples.h"
#include "renderer/scene/rig.h"

namespace cutis {

struct Field {
    const char* key;    // in files; empty: in none
    const char* label;  // in panels
    const char* unit = "";
    // What files and the command line may give. Where `of` is given the value is no plain number.
    double min = 0, max = 0;
    bool openMin = false;  // min itself is refused
    const char* help = "";
    const char* of = "";  // "text", "true or false", …; empty: a number

    // The control of a panel: what it covers, how its number is printed, how much of it a pixel of dragging
    // is worth (0: a slider; where it is logarithmic, a share of its value), and how many of its units one
    // unit of the file is (degrees for radians).
    double low = 0, high = 0;
    const char* format = "%.2f";
    double step = 0;
    bool logarithmic = false;
    double shownPerUnit = 1;

    // "metres, 0 to 1e+06": what a value may be, for people.
    std::string allowed() const;
};

// Upper bounds keep single precision, in which lights are summed, far from overflow.
namespace fields {

inline constexpr double kDegrees = 180 / std::numbers::pi;
inline constexpr const char* kText = "text";
inline constexpr const char* kSwitch = "true or false";

// A rig
inline constexpr Field kVersion{.key = "cutis_rig", .label = "", .help = "Version of the format", .of = "1"};
inline constexpr Field kRigName{
    .key = "name", .label = "Name", .help = "What the rig is called", .of = kText};
inline constexpr Field kExposure{.key = "exposure",
                                 .label = "Exposure",
                                 .unit = "EV",
                                 .min = -64,
                                 .max = 64,
                                 .help = "Each step doubles what is shown",
                                 .low = -16,
                                 .high = 16,
                                 .format = "%+.2f",
                                 .step = 0.02};
inline constexpr Field kLights{.key = "lights", .label = "Lights", .help = "The lights", .of = "list"};
inline constexpr Field kEnvironment{
    .key = "environment", .label = "Environment", .help = "Light from all around", .of = "object"};

// A light
inline constexpr Field kLightName{
    .key = "name", .label = "Name", .help = "What the light is called", .of = kText};
inline constexpr Field kType{
    .key = "type",
    .label = "Type",
    .help = "rect shines from a rectangle, spot in a cone, point everywhere, directional from far away",
    .of = "directional, point, spot or rect"};
inline constexpr Field kEnabled{
    .key = "enabled", .label = "On", .help = "Whether the light shines", .of = kSwitch};
inline constexpr Field kColor{.key = "color",
                              .label = "Colour",
                              .min = 0,
                              .max = 1e6,
                              .help = "Linear Rec.709, multiplied by the colour of the temperature",
                              .of = "three numbers"};
inline constexpr Field kTemperature{
    .key = "temperature",
    .label = "Temperature",
    .unit = "K",
    .min = kMinTemperature,
    .max = kMaxTemperature,
    .help = "The colour of a black body of luminance 1, which multiplies the colour",
    .low = 1500,
    .high = 15000,
    .format = "%.0f",
    .logarithmic = true};
inline constexpr Field kIntensity{
    .key = "intensity",
    .label = "Intensity",
    .min = 0,
    .max = 1e12,
    .help = "Lux of a directional light, candela of a point or spot, radiance of a rect",
    .low = 0,
    .high = 1e6,
    .format = "%.3g",
    .step = 0.01,
    .logarithmic = true};
inline constexpr Field kInnerCone{.key = "inner_cone_angle",
                                  .label = "Hot spot",
                                  .unit = "rad",
                                  .min = 0,
                                  .max = std::numbers::pi / 2,
                                  .help = "Of a spot: from the axis, where its light begins to fall",
                                  .low = 0,
                                  .high = 89,
                                  .format = "%.1f",
                                  .shownPerUnit = kDegrees};
inline constexpr Field kOuterCone{.key = "outer_cone_angle",
                                  .label = "Cone",
                                  .unit = "rad",
                                  .min = 0,
                                  .max = std::numbers::pi / 2,
                                  .help = "Of a spot: from the axis, where its light ends",
                                  .low = 0.5,
                                  .high = 90,
                                  .format = "%.1f",
                                  .shownPerUnit = kDegrees};
inline constexpr Field kRadius{
    .key = "radius",
    .label = "Radius",
    .unit = "m",
    .min = 0,
    .max = 1e6,
    .help = "Of a point a ball, of a spot a disc across its axis: the larger, the softer its shadows",
    .low = 0,
    .high = 5,
    .format = "%.3f",
    .step = 0.002};
inline constexpr Field kSize{.key = "size",
                             .label = "Size",
                             .unit = "m",
                             .min = 0,
                             .max = 1e6,
                             .help = "Of a rect: width and height; the larger, the softer its shadows",
                             .of = "two numbers",
                             .low = 0.01,
                             .high = 20,
                             .step = 0.005};
inline constexpr Field kSamples{
    .key = "samples",
    .label = "Samples",
    .min = 0,
    .max = kMaxLightSamples,
    .help = "Light samples of an area light: the more, the smoother its shadows; 0: automatic",
    .low = 0,
    .high = 64,
    .format = "%.0f"};
inline constexpr Field kRange{.key = "range",
                              .label = "Range",
                              .unit = "m",
                              .min = 0,
                              .max = 1e6,
                              .help = "Where the light ends, as in KHR_lights_punctual; 0: nowhere",
                              .low = 0,
                              .high = 1000,
                              .step = 0.01};
inline constexpr Field kShadow{
    .key = "shadow", .label = "Shadow", .help = "Whether what is in its way shades it", .of = kSwitch};
inline constexpr Field kPlace{.key = "place",
                              .label = "Round the subject",
                              .help = "Where it is, relative to a head, which it aims at",
                              .of = "object"};
inline constexpr Field kPosition{.key = "position",
                                 .label = "Position",
                                 .unit = "m",
                                 .min = -1e6,
                                 .max = 1e6,
                                 .help = "Where it is in the world",
                                 .of = "three numbers",
                                 .low = -1e4,
                                 .high = 1e4,
                                 .format = "%.3f",
                                 .step = 0.005};
inline constexpr Field kDirection{.key = "direction",
                                  .label = "Aim",
                                  .min = -1e6,
                                  .max = 1e6,
                                  .help = "Where it shines to",
                                  .of = "three numbers"};

// Its place
inline constexpr Field kSubject{.key = "subject",
                                .label = "Subject",
                                .help = "Whose head: a character's name, or * for all together",
                                .of = kText};
inline constexpr Field kAzimuth{.key = "azimuth",
                                .label = "Azimuth",
                                .unit = "\xc2\xb0",
                                .min = -36000,
                                .max = 36000,
                                .help = "0 in front (+Z), growing towards +X, the subject's left",
                                .low = -180,
                                .high = 180,
                                .format = "%.1f"};
inline constexpr Field kElevation{.key = "elevation",
                                  .label = "Elevation",
                                  .unit = "\xc2\xb0",
                                  .min = -90,
                                  .max = 90,
                                  .help = "Above the head's centre, towards +Y",
                                  .low = -90,
                                  .high = 90,
                                  .format = "%.1f"};
inline constexpr Field kDistance{.key = "distance",
                                 .label = "Distance",
                                 .unit = "m",
                                 .min = 0,
                                 .max = 1e6,
                                 .openMin = true,
                                 .help = "From the centre of the head",
                                 .low = 0.05,
                                 .high = 100,
                                 .step = 0.005,
                                 .logarithmic = true};

// The environment
inline constexpr Field kFile{
    .key = "file", .label = "File", .help = "A lat-long image, relative to the rig file", .of = kText};
inline constexpr Field kEnvironmentEnabled{
    .key = "enabled", .label = "On", .help = "Whether the environment shines", .of = kSwitch};
inline constexpr Field kEnvironmentIntensity{.key = "intensity",
                                             .label = "Intensity",
                                             .min = 0,
                                             .max = 1e12,
                                             .help = "Factor on the environment's radiance",
                                             .low = 0,
                                             .high = 1000,
                                             .format = "%.3g",
                                             .step = 0.005,
                                             .logarithmic = true};
inline constexpr Field kRotation{
    .key = "rotation",
    .label = "Rotation",
    .unit = "\xc2\xb0",
    .min = -36000,
    .max = 36000,
    .help = "Turn of the environment about +Y in degrees, counter-clockwise seen from above",
    .low = -180,
    .high = 180,
    .format = "%.0f"};
inline constexpr Field kShadowSamples{
    .key = "shadow_samples",
    .label = "Sharp shadows",
    .min = 0,
    .max = kMaxLightSamples,
    .help = "The environment's brightest parts become so many light samples, which cast sharp shadows",
    .low = 0,
    .high = 64,
    .format = "%.0f"};
inline constexpr Field kSunRemoved{
    .key = "sun_removed",
    .label = "Sun removed",
    .help = "The environment shines without its sun: a light of the rig stands for it",
    .of = kSwitch};

// Skin
inline constexpr double kLargest = 1e9;
inline constexpr Field kProfile{.key = "profile",
                                .label = "Profile",
                                .help = "How far light travels in the skin: a sum of Gaussians",
                                .of = "\"three-layer\" or a list of variances and weights"};
inline constexpr Field kVariance{.key = "variance_mm2",
                                 .label = "Variance",
                                 .unit = "mm\xc2\xb2",
                                 .min = 0,
                                 .max = kLargest,
                                 .openMin = true,
                                 .help = "Of one Gaussian, along one axis: its width is the root of it",
                                 .low = 1e-4,
                                 .high = 1000,
                                 .format = "%.4g",
                                 .step = 0.01,
                                 .logarithmic = true};
inline constexpr Field kWeight{.key = "weight",
                               .label = "Weights",
                               .min = 0,
                               .max = 1,
                               .help = "Share of red, green and blue light that this Gaussian spreads",
                               .of = "three numbers",
                               .low = 0,
                               .high = 1,
                               .format = "%.3f",
                               .step = 0.002};
inline constexpr Field kScale{.key = "scale",
                              .label = "Scale",
                              .min = 0,
                              .max = kLargest,
                              .openMin = true,
                              .help = "Multiplies how far light travels in the skin",
                              .low = 0.01,
                              .high = 100,
                              .format = "%.3g",
                              .step = 0.005,
                              .logarithmic = true};
inline constexpr Field kMix{.key = "mix",
                            .label = "Mix",
                            .min = 0,
                            .max = 1,
                            .help = "0: albedo colours the light as it leaves the skin, 1: as it enters",
                            .low = 0,
                            .high = 1};
inline constexpr Field kRoughness{.key = "roughness",
                                  .label = "Roughness",
                                  .min = 0,
                                  .max = 1,
                                  .openMin = true,
                                  .help = "Of the oily surface: slope of its facets (Beckmann, rms)",
                                  .low = 0.02,
                                  .high = 1};
inline constexpr Field kSpecular{.key = "specular",
                                 .label = "Specular",
                                 .min = 0,
                                 .max = kLargest,
                                 .help = "Scales what the surface reflects",
                                 .low = 0,
                                 .high = 3};
inline constexpr Field kLobeWeight{.key = "lobe_weight",
                                   .label = "Second lobe",
                                   .min = 0,
                                   .max = 1,
                                   .help = "Share of a second, narrower lobe of what the surface reflects",
                                   .low = 0,
                                   .high = 1};
inline constexpr Field kLobeRatio{.key = "lobe_ratio",
                                  .label = "Its roughness",
                                  .min = 0,
                                  .max = 1,
                                  .openMin = true,
                                  .help = "Roughness of the second lobe over that of the first",
                                  .low = 0.05,
                                  .high = 1};
inline constexpr Field kDetail{.key = "detail",
                               .label = "Pores",
                               .min = 0,
                               .max = 100,
                               .help = "Relief of pores that glossy light shows: 1 is that of a cheek, 0 none",
                               .low = 0,
                               .high = 3};
inline constexpr Field kDetailScale{.key = "detail_scale",
                                    .label = "Pore tile",
                                    .unit = "mm",
                                    .min = 0,
                                    .max = kLargest,
                                    .openMin = true,
                                    .help = "Length after which the relief repeats: its pores are a twentieth of it",
                                    .low = 1,
                                    .high = 50,
                                    .format = "%.3g",
                                    .step = 0.02,
                                    .logarithmic = true};
inline constexpr Field kTranslucency{.key = "translucency",
                                     .label = "Translucent",
                                     .help = "Whether light from behind shines through",
                                     .of = kSwitch};
inline constexpr Field kMmPerUnit{.key = "mm_per_unit",
                                  .label = "mm per unit",
                                  .unit = "mm",
                                  .min = 0,
                                  .max = kLargest,
                                  .openMin = true,
                                  .help = "Millimetres in one unit of the scene",
                                  .low = 0.001,
                                  .high = 1e6,
                                  .format = "%.4g",
                                  .step = 0.01,
                                  .logarithmic = true};

}  // namespace fields

// The fields of an object of a file, in the order in which it is written.
struct FieldGroup {
    const char* object;  // "A light"
    std::vector<Field> fields;
};
// Of a rig file, as the format describes itself.
std::vector<FieldGroup> rigFields();
// Of `material.extras.skin`.
std::vector<FieldGroup> skinFields();

}  // namespace cutis
