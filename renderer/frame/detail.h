// How fine the atlas and the light maps are made for a picture.
#pragma once

#include <vector>

namespace cutis {

struct FrameContext;

struct Detail {
    std::vector<double> mmPerTexel;  // of the atlas, wanted for each character
    double pixelsAcross = 0;         // largest diagonal of a character, in pixels of the picture
    int lightMapSize = 0;            // texels along each side
    bool anticipated = false;        // by anticipateDetail: it stays as it is
};

// Fills frame.detail from the picture's size, its camera and the characters. For any view, what was chosen for an earlier
// picture stays until it is wrong by more than kDetailSlack: texels that followed every step of the camera would be lit
// anew at each.
void chooseDetail(FrameContext& frame);
inline constexpr double kDetailSlack = 1.6;

// Makes frame.detail as fine as this picture asks, where it is not, and has chooseDetail keep to it.
void anticipateDetail(FrameContext& frame);

// Fills frame.detail.lightMapSize, for that many maps.
void chooseLightMapSize(FrameContext& frame, std::size_t maps);

// Whether some pixel of the picture is narrow enough for pores of the skin that it may show.
bool resolvesPores(const FrameContext& frame);

}  // namespace cutis
