// Two pictures of one view beside each other, or one light after another against all of them: figures,
// difference maps and a page. What `cutis compare` writes and what the viewer's panel shows.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/measure/metrics.h"
#include "renderer/scene/picture.h"

namespace cutis {

// A picture of the comparison: scene-linear, with the exposure at which it is shown [EV].
struct ComparedPicture {
    std::string name;
    Picture picture;
    double exposure = 0;
};

// How a picture differs from the one that it is compared with.
struct Difference {
    ErrorFigures figures;   // over pixels that either covers
    double flip = 0;        // mean perceived difference as shown
    double lightRatio = 0;  // sum of its light over that of the other
    Picture map;            // |a - b| over the mean of b, one channel
    Picture flipMap;        // one channel, in [0, 1]
};

// What is white in pictures of the two maps: a difference as large as the mean light, a perceived one of a half.
inline constexpr double kWholeDifference = 1, kWholeFlip = 0.5;

// Throws std::invalid_argument when sizes differ.
Difference differenceOf(const ComparedPicture& picture, const ComparedPicture& base);

// Writes into `folder`, which must exist: NAME.exr and NAME.png for each picture, NAME-difference.png and
// NAME-flip.png for all but the first, compare.json and compare.csv with the figures against the first, and
// index.html, which opens from disk: a wipe between any two pictures, maps and figures. Throws Error.
void writeComparison(const std::filesystem::path& folder, const std::string& title,
                     const std::vector<ComparedPicture>& pictures);

}  // namespace cutis
