#include "renderer/scene/camera.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "renderer/core/error.h"
#include "renderer/core/suggest.h"
#include "renderer/scene/characters.h"

namespace cutis {
namespace {

constexpr double kLongLens = 0.35;  // radians: about 70 mm on a full frame, a portrait lens
constexpr double kMargin = 0.06;    // of the picture's width and height, left free at each side

// How far head and shoulders reach around the head, in heights of the head.
constexpr double kShoulders = 1.0;  // to either side of its centre
constexpr double kChest = 0.55;     // below the chin
constexpr double kHair = 0.4;       // above the crown

Bounds intersection(const Bounds& a, const Bounds& b) {
    Bounds both;
    both.min = glm::max(a.min, b.min);
    both.max = glm::min(a.max, b.max);
    return both;
}

Bounds headAndShoulders(const Scene& scene, const Character& character) {
    const Bounds head = headBounds(scene, character.name);
    const double height = head.size().y;
    const glm::dvec3 centre = head.centre();
    Bounds around;
    around.min = centre - glm::dvec3(kShoulders * height);
    around.max = centre + glm::dvec3(kShoulders * height);
    around.min.y = head.min.y - kChest * height;
    around.max.y = head.max.y + kHair * height;
    Bounds subject = intersection(around, character.bounds);
    subject.extend(head);
    return subject;
}

void addCorners(std::vector<glm::dvec3>& points, const Bounds& bounds) {
    for (int corner = 0; corner < 8; ++corner) {
        points.push_back({corner & 1 ? bounds.max.x : bounds.min.x, corner & 2 ? bounds.max.y : bounds.min.y,
                          corner & 4 ? bounds.max.z : bounds.min.z});
    }
}

Bounds subjectlessBounds(const Scene& scene) {
    Bounds bounds = scene.bounds;
    if (!bounds.empty()) return bounds;
    bounds.extend(glm::dvec3(-0.5));
    bounds.extend(glm::dvec3(0.5));
    return bounds;
}

// The nearest camera of the given orientation that holds all points inside its margin. In the camera's axes a
// point p is inside the right plane when p.x - c.x ≤ t (c.z - p.z), so c.x + t c.z ≥ max(p.x + t p.z) =:
// right, and likewise for the other planes: c.z is the larger of (right + left) / 2t and (top + bottom) / 2t,
// and c.x, c.y centre what is left.
Camera frame(const std::vector<glm::dvec3>& points, const glm::dmat3& axes, double aspect) {
    const double tanY = std::tan(kLongLens / 2) * (1 - 2 * kMargin), tanX = tanY * aspect;
    constexpr double kLowest = std::numeric_limits<double>::lowest();
    double right = kLowest, left = kLowest, top = kLowest, bottom = kLowest, front = kLowest, back = -kLowest;
    for (const glm::dvec3& point : points) {
        const glm::dvec3 p = glm::transpose(axes) * point;
        right = std::max(right, p.x + tanX * p.z);
        left = std::max(left, -p.x + tanX * p.z);
        top = std::max(top, p.y + tanY * p.z);
        bottom = std::max(bottom, -p.y + tanY * p.z);
        front = std::max(front, p.z);
        back = std::min(back, p.z);
    }
    const double fitting = std::max((right + left) / (2 * tanX), (top + bottom) / (2 * tanY));
    // A single point or a flat subject seen edge-on would put the camera into it.
    const double z = std::max(fitting, front + std::max(1e-3, 0.05 * (front - back)));
    const glm::dvec3 eye = axes * glm::dvec3((right - left) / 2, (top - bottom) / 2, z);
    Camera camera;
    camera.name = "auto";
    camera.yfov = kLongLens;
    camera.aspect = aspect;
    camera.world = glm::dmat4(axes);
    camera.world[3] = glm::dvec4(eye, 1);
    camera.znear = 0.05 * (z - front);
    return camera;
}

// Columns are the axes of a level camera that looks from these angles, in degrees: right, up, backwards.
glm::dmat3 levelAxes(double azimuth, double elevation) {
    const double az = glm::radians(azimuth), el = glm::radians(elevation);
    const glm::dvec3 z(std::sin(az) * std::cos(el), std::sin(el), std::cos(az) * std::cos(el));
    const glm::dvec3 x(std::cos(az), 0, -std::sin(az));  // level, and defined straight above too
    return {x, glm::cross(z, x), z};
}

Camera autoCamera(const Scene& scene, double azimuth, double elevation, double aspect) {
    std::vector<glm::dvec3> points;
    for (const Character& character : scene.characters)
        addCorners(points, headAndShoulders(scene, character));
    if (points.empty()) addCorners(points, subjectlessBounds(scene));
    return frame(points, levelAxes(azimuth, elevation), aspect);
}

double parseNumber(std::string_view text, const std::string& selector,
                   const std::string& form = "must be auto:AZ,EL, two numbers in degrees") {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
        throw Error("cannot use camera '" + selector + "'", form);
    }
    return value;
}

Camera parseAuto(const Scene& scene, const std::string& selector, double aspect) {
    if (selector == "auto") return autoCamera(scene, 0, 0, aspect);
    const std::string_view angles = std::string_view(selector).substr(5);
    const std::size_t comma = angles.find(',');
    const double azimuth = parseNumber(angles.substr(0, comma), selector);
    const double elevation = comma == angles.npos ? 0 : parseNumber(angles.substr(comma + 1), selector);
    if (std::abs(elevation) > 90) {
        throw Error("cannot use camera '" + selector + "'", "the elevation must be from -90 to 90");
    }
    return autoCamera(scene, azimuth, elevation, aspect);
}

Camera parseOrbit(const std::string& selector, double aspect) {
    const std::string form = "must be orbit:X,Y,Z,AZ,EL,DISTANCE,FOV, seven numbers";
    std::array<double, 7> v{};
    std::string_view rest = std::string_view(selector).substr(std::string_view("orbit:").size());
    for (std::size_t i = 0; i < v.size(); ++i) {
        const std::size_t comma = rest.find(',');
        if ((comma == rest.npos) != (i + 1 == v.size()))
            throw Error("cannot use camera '" + selector + "'", form);
        v[i] = parseNumber(rest.substr(0, comma), selector, form);
        rest.remove_prefix(comma == rest.npos ? rest.size() : comma + 1);
    }
    if (std::abs(v[4]) > 90 || !(v[5] > 0) || !(v[6] > 0 && v[6] < 180)) {
        throw Error("cannot use camera '" + selector + "'",
                    "the elevation must be from -90 to 90, the distance above 0, the field of view between 0 and 180");
    }
    return orbitCamera({v[0], v[1], v[2]}, v[3], v[4], v[5], glm::radians(v[6]), aspect);
}

const Camera& findCamera(const Scene& scene, const std::string& selector) {
    const auto named = std::ranges::find(scene.cameras, selector, &Camera::name);
    if (named != scene.cameras.end()) return *named;
    std::size_t index = 0;
    const char* last = selector.data() + selector.size();
    const auto [end, error] = std::from_chars(selector.data(), last, index);
    if (error == std::errc() && end == last && index < scene.cameras.size()) return scene.cameras[index];
    std::vector<std::string> names;
    std::string list;
    for (const Camera& known : scene.cameras) {
        names.push_back(known.name);
        list += "'" + known.name + "', ";
    }
    throw Error("no camera '" + selector + "'" + didYouMean(selector, names),
                "there are " + list + "auto and auto:AZ,EL", scene.file.string());
}

}  // namespace

Camera orbitCamera(const glm::dvec3& target, double azimuth, double elevation, double distance, double yfov,
                   double aspect) {
    const glm::dmat3 axes = levelAxes(azimuth, elevation);
    Camera camera;
    camera.name = "orbit";
    camera.yfov = yfov;
    camera.aspect = aspect;
    camera.world = glm::dmat4(axes);
    camera.world[3] = glm::dvec4(target + distance * axes[2], 1);
    camera.znear = 0.01 * distance;
    return camera;
}

Camera cameraFor(const Scene& scene, const std::string& selector, double aspect) {
    const bool isAuto = selector == "auto" || selector.starts_with("auto:");
    if (isAuto) return parseAuto(scene, selector, aspect);
    if (selector.starts_with("orbit:")) return parseOrbit(selector, aspect);
    if (selector.empty() && scene.cameras.empty()) return autoCamera(scene, 0, 0, aspect);
    Camera camera = selector.empty() ? scene.cameras[0] : findCamera(scene, selector);
    camera.aspect = aspect;
    if (camera.orthographic) camera.xmag = camera.ymag * aspect;
    return camera;
}

}  // namespace cutis
