#pragma once
// A photo's own face in another light, from its layers: a preview of what a lamp more or less would do.
//
//   const pipeline::FaceEstimate& face = estimate.largest_face();
//   const Eigen::MatrixX3f dimmed = lighting::without_main_lights(face.light.radiance, SphereGrid(16), 1);
//   pipeline::relight(photo.linear, face, dimmed);                    // the photo, its strongest light put out
//
// The diffuse layer is multiplied by what the new light gives each spot over what the old one gave, the highlight layer gets the difference of the
// two lights' lobes; shadows are those of the face on itself, by its horizons. Only the face changes: hair, neck, clothes and room stay as they
// are, so it is for small changes and small looks. Of light that the photo does not tell of, such as the far side of a face in the dark, nothing
// comes.

#include "faceprobe/pipeline/estimate.h"

#include <string>
#include <vector>

namespace faceprobe::pipeline {

struct RelightOptions {
  int shading_px = 96;  // long side at which light is computed; it is carried to the crop smoothly
  float most_gain = 6;  // of the diffuse layer: what is brightened beyond it is noise
  int threads = 0;

  std::string validate() const;
};

// One of a face's main lights, less bright.
struct DimmedLight {
  int light = 1;     // from 1 on, strongest first, as report.json lists them
  double share = 1;  // of it that goes: 1 puts it out
};

// The usual wishes.
struct LightChange {
  EnvMap map{};                    // lights the faces instead, as strong as their own light; empty = their own
  std::vector<DimmedLight> dim{};  // each light once; not with a map. Faces without that light stay as they are
  double turn_deg = 0;             // of the light about the vertical, to the right seen from above the photo
  double exposure = 0;             // stops

  // Empty when usable, else a sentence that says which value is wrong; a change that changes nothing is wrong too.
  std::string validate() const;
  // The same for a photo: lights that none of its faces has cannot be dimmed.
  std::string fault_of(const Estimate& estimate) const;
};
// A face's light so changed, on the cells of its own. `options`: those of the estimate. Throws Error(kInput) for a map without light.
Eigen::MatrixX3f changed_light(const FaceEstimate& face, const LightChange& change, const EstimateOptions& options);

// Changes the face in `photo`, the estimate's picture at its own size, linear, three channels. `radiance`: cells of a SphereGrid x 3, in the
// unit of face.light.radiance, and as many. Throws std::invalid_argument for other channels or cells and for options that do not validate.
void relight(Image& photo, const FaceEstimate& face, const Eigen::MatrixX3f& radiance,
             const RelightOptions& options = {});

}  // namespace faceprobe::pipeline
