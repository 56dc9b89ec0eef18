// The light mixer: each light's own picture, added up anew whenever a slider moves, without rendering
// anything.
#pragma once

#include <memory>
#include <vector>

#include "app/viewer/document.h"
#include "renderer/scene/picture.h"

namespace cutis::app {

// What one light alone, or the environment alone, makes of the view.
struct Contribution {
    Light light;                      // as it was rendered: on, of any intensity above 0
    EnvironmentSettings environment;  // the same for the last contribution, which is the environment's
    bool ofEnvironment = false;
    std::shared_ptr<const Picture> picture;  // scene-linear; null until it is rendered
};

// The lightings to render for the mixer, in the order of the rig: its lights, each alone and on, then its
// environment if it has one. Lights of intensity or colour 0 are rendered with 1.
std::vector<Contribution> contributionsOf(const Document& document);
// A rig of that contribution alone.
Rig aloneRig(const Document& document, const Contribution& contribution);

// They differ in colour, intensity and name alone.
bool sameShape(const Contribution& a, const Contribution& b);
// Light is additive, so a picture of the rig is the sum of these as long as nothing but their colours,
// intensities and switches differs: whether that is so for these contributions and this document.
bool canMix(const std::vector<Contribution>& contributions, const Document& document);

// How much of the contribution, by channel, is in the picture of the document: 0 when it is off. Solo counts.
glm::dvec3 shareOf(const Contribution& contribution, std::size_t index, const Document& document);

// The sum of all contributions that are there, each times its share. Empty when none is there.
Picture mix(const std::vector<Contribution>& contributions, const Document& document);

}  // namespace cutis::app
