#include "app/frame_files.h"

#include <algorithm>
#include <optional>
#include <string>

namespace cutis::app {
namespace {

struct NumberPlace {
    std::size_t begin = 0, end = 0;  // of "%04d"
    std::size_t digits = 0;          // at least so many, filled with zeros
};

// Nothing unless there is exactly one, of at most nine digits.
std::optional<NumberPlace> numberPlace(const std::string& name) {
    std::optional<NumberPlace> found;
    for (std::size_t i = name.find('%'); i != name.npos; i = name.find('%', i + 1)) {
        const std::size_t end = name.find_first_not_of("0123456789", i + 1);
        if (end == name.npos || name[end] != 'd' || found) return std::nullopt;
        const std::string digits = name.substr(i + 1, end - i - 1);
        if (digits.size() > 2 || (!digits.empty() && (digits[0] != '0' || digits.size() != 2)))
            return std::nullopt;
        found = NumberPlace{i, end + 1, digits.empty() ? 1 : std::size_t(digits[1] - '0')};
    }
    return found;
}

}  // namespace

bool hasFrameNumber(const std::filesystem::path& file) {
    return numberPlace(file.filename().string()).has_value();
}

std::filesystem::path fileOfFrame(const std::filesystem::path& file, int frame) {
    std::string name = file.filename().string(), number = std::to_string(frame);
    const NumberPlace place = numberPlace(name).value();
    if (number.size() < place.digits) number.insert(0, place.digits - number.size(), '0');
    name.replace(place.begin, place.end - place.begin, number);
    std::filesystem::path result = file;
    return result.replace_filename(name);
}

Request requestOfFrame(const Request& request, int frame) {
    Request one = request;
    for (std::filesystem::path& output : one.outputs) output = fileOfFrame(output, frame);
    if (!one.stats.empty()) one.stats = fileOfFrame(one.stats, frame);
    one.time = timeOfFrame(request, frame);
    one.frames.reset();
    return one;
}

double timeOfFrame(const Request& request, int frame) {
    return frame / request.fps.value_or(kDefaultFps);
}

}  // namespace cutis::app
