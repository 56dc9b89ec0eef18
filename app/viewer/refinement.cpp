#include "app/viewer/refinement.h"

#include <cmath>
#include <utility>

namespace cutis::app {
namespace {

void addTo(Picture& sum, const Picture& picture) {
    for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += picture.values[i];
}

// By how much one more picture moves the mean of n-1 others, whose sum it is not yet part of.
double movedBy(const Picture& picture, const Picture& sum, int n) {
    double change = 0, whole = 0;
    for (std::size_t i = 0; i < sum.values.size(); ++i) {
        const double mean = double(sum.values[i]) / (n - 1);
        change += std::pow((picture.values[i] - mean) / n, 2);
        whole += mean * mean;
    }
    return whole > 0 ? std::sqrt(change / whole) : 0;
}

}  // namespace

Refinement::Refinement(std::shared_ptr<const Picture> first, bool softShadows)
    : first_(std::move(first)), pixelSum_(*first_), softShadows_(softShadows) {
    if (softShadows_) shadowSum_ = *first_;
}

Refinement::Step Refinement::next() const {
    if (pixels_ < kPixelPictures) return Step::pixels;
    if (!softShadows_ || shadows_ >= kMostShadowPictures || moved_ < kStill) return Step::none;
    return Step::shadows;
}

void Refinement::add(const Picture& picture) {
    if (picture.values.size() != pixelSum_.values.size()) return;
    switch (next()) {
        case Step::pixels:
            addTo(pixelSum_, picture);
            ++pixels_;
            break;
        case Step::shadows:
            ++shadows_;
            moved_ = movedBy(picture, shadowSum_, shadows_);
            addTo(shadowSum_, picture);
            break;
        case Step::none:
            break;
    }
}

// What other samples of the lights change is the same wherever within the pixels one looks.
Picture Refinement::mean() const {
    Picture result = pixelSum_;
    const float share = 1.0f / static_cast<float>(pixels_);
    for (float& value : result.values) value *= share;
    if (shadows_ == 1) return result;
    const float shadowShare = 1.0f / static_cast<float>(shadows_);
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        const float better = result.values[i] + shadowSum_.values[i] * shadowShare - first_->values[i];
        result.values[i] = better > 0 ? better : 0;
    }
    return result;
}

}  // namespace cutis::app
