#pragma once
// Everything that a training run depends on apart from its data, read from a JSON file that is kept with the weights. The same config,
// data and device give the same weights; a run that was cut off goes on bit for bit.
//
//   {"architecture": "unet", "batch": 16, "steps": 20000, "learning_rate": 2e-3}     // what is not named keeps its default
//
//   const train::TrainConfig config = train::train_config_from_json(text);

#include <cstdint>
#include <string>

namespace faceprobe::train {

// Changes of the picture that the answer follows or ignores. Noise, blur, JPEG and tone curves are drawn when samples are rendered.
struct AugmentConfig {
  bool mirror = true;                // left and right change places in half of the samples
  double colour_deviation = 0.08;    // of the logarithm of each channel's gain: the light's colour
  double exposure_deviation = 0.25;  // of the logarithm of the gain of all channels; what passes white is clipped again
  double grey_share = 0.05;          // of samples without colour
  double no_mask_share = 0.15;       // of samples that are given no face mask
  double occluder_share = 0.1;       // of samples that something plain is put before
  double backdrop_share = 0;         // of samples that get a plain backdrop in the place of what is behind the person
  double zoom_share = 0.2;           // of samples that are enlarged or made smaller, and moved
  double close_share = 0;            // of samples cut out so that the face fills them, where its mesh is found
  double cut_share = 0.15;           // of samples with sides cut off, as of a face at the edge of its photo
};

struct LossConfig {
  double encoded = 0.5;     // weight of the error of square roots, which counts dark skin as much as bright
  double gradient = 0.25;   // weight of the error of differences between neighbours
  double rms = 0;           // weight of each picture's root mean square error: what the benchmark measures
  double similarity = 0;    // weight of one minus the structural similarity
  double elsewhere = 0.25;  // weight of a pixel that is not the face's skin, which has 1
  // Of the face network's other outputs (architecture "face").
  double normal = 0.1;   // weight of the normals' error, a chord of the unit sphere
  double spread = 0.02;  // weight of how well the error that is stated fits the one that is made
  double depth = 0.01;   // weight of the depth's error, of 5 cm
  double region = 0.03;  // weight of the regions' cross entropy
  double rare =
      1;  // weight of a pixel of mouth, glasses or object in that, of eyes, lips and brows its root; others have 1
  double shading = 0.1;  // weight of the error of the shading's logarithm
  double colour = 0.1;   // weight of the error of the light's colour, a chord of the unit sphere
  double open = 0.1;     // weight of both errors of the shading that would be there if nothing stood in the light's way
};

struct TrainConfig {
  // "unet": highlights alone. "face": the same with normals, depth, regions and shading beside them. "mscr": the paper's, highlights
  // with its plain L2 loss and no change of the light's colour and exposure. "shi": that of Shi et al. 2017, highlights, albedo and shading with its own
  // loss; the weights above are not for it. "albedo_shading": the paper's of Sec. 4.3, from the diffuse layer, with Narihira et al.'s
  // scale-invariant loss; as mscr else.
  std::string architecture = "unet";
  std::string network = "{}";  // the architecture's own options, JSON
  // Side of the square pictures that the network is given, kept with its weights: it then looks at every face twice, at all of the picture
  // and from near, and is validated on the near view. 0 = pictures as they were rendered.
  int picture_px = 0;
  // "float32", or "bf16": the network's products in bfloat16 while it is trained, on a card alone; weights, losses and what is measured stay
  // in float. Not for shi.
  std::string precision = "float32";
  int batch = 16;  // samples to a step
  std::int64_t steps = 20000;
  double learning_rate = 1e-3;  // AdamW's, at its peak
  double weight_decay = 0.01;   // AdamW's
  std::int64_t warm_up = 300;   // steps until the peak; from there a half cosine down to final_share of it
  double final_share = 0.01;
  double average_decay = 0.998;   // of the running average of the weights, which is what is kept
  double largest_gradient = 1.0;  // norm over all weights
  std::uint64_t seed = 1;
  std::int64_t validate_every = 1000;
  int validation_samples = 128;
  std::int64_t save_every = 250;
  AugmentConfig augment;
  LossConfig loss;

  // Empty when usable, else a sentence that says which value is wrong.
  std::string validate() const;
};

// Throws Error(kUsage): not JSON, a key that does not exist (the sentence names it and those that do), a value of another type, a config
// that does not validate.
TrainConfig train_config_from_json(const std::string& text);
std::string to_json(const TrainConfig& config);

}  // namespace faceprobe::train
