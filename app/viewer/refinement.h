// The mean of ever more pictures of one state, seen by a camera that stands still. No device, no threads.
#pragma once

#include <memory>

#include "renderer/scene/picture.h"

namespace cutis::app {

class Refinement {
  public:
    // What the next picture is to differ in.
    enum class Step {
        pixels,   // where within the pixels it looks
        shadows,  // the samples of its area lights and its sky
        none      // converged
    };
    static constexpr int kPixelPictures = 8;
    static constexpr int kMostShadowPictures = 16;
    // Converged: one more picture moves the mean by less than this, relative to it (L2). A step of 8 bits in
    // mid-grey is 0.005.
    static constexpr double kStill = 0.001;

    // Both over the background. `softShadows`: other samples would light it differently.
    Refinement(std::shared_ptr<const Picture> first, bool softShadows);

    Step next() const;
    // Must be what next() asks for, of the first picture's size; others change nothing.
    void add(const Picture& picture);

    // Pictures that there are of each kind, the first included.
    int pixelPictures() const { return pixels_; }
    int shadowPictures() const { return shadows_; }
    Picture mean() const;

  private:
    std::shared_ptr<const Picture> first_;
    Picture pixelSum_;   // of all that look elsewhere
    Picture shadowSum_;  // of all that are lit by other samples, the camera as in the first
    bool softShadows_;
    int pixels_ = 1, shadows_ = 1;
    double moved_ = 1;  // by the last shadow picture
};

}  // namespace cutis::app
