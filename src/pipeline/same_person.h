#pragma once
// The skin that several photos have in common, and each photo's shading corrected by it: all of Estimator::same_person() but solving again.

#include "faceprobe/lighting/shared_skin.h"
#include "faceprobe/pipeline/estimate.h"

#include <functional>
#include <vector>

namespace faceprobe::pipeline {

// What the face's albedo says of the skin; nothing where there is no light on it.
std::optional<lighting::SkinReading> skin_reading(const FaceEstimate& face);

// Multiplies the shading by the gains and divides the albedo, the same of the light's colour and the observations. `skin_log_deviation`: of the shared
// skin's colour, the new light_colour_uncertainty_deg where there was one.
void apply_skin_gain(const lighting::SharedSkin::Photo& gain, double skin_log_deviation, const EstimateOptions& options,
                     FaceEstimate& face);

// From observations to the light, as the estimator's options have it but for `solve`. `ask_prior`: as Estimator::light_of().
using SolveAgain = std::function<lighting::Light(const lighting::Observations& observations, bool ask_prior,
                                                 const lighting::SolveOptions& solve)>;

// One face a photo, all of one person: shares skin and highlight gain among those with lit skin, two at least, and finds their lights again. Where
// nothing changes nothing is solved. Sets FaceEstimate::same_person of those.
void share_person(const std::vector<FaceEstimate*>& faces, const EstimateOptions& options, const SolveAgain& solve);

}  // namespace faceprobe::pipeline
