#pragma once
// Finetunes the surface that a network "face" sees (normals, shading, albedo) on photos of people, without labels. What it says of a photo
// has to hang together: its shading must be the irradiance of some light on its normals, and photos of one person must share their albedo.
// Guards keep it from the ways of agreeing with itself by saying nothing, and every step also trains on synthetic faces.
//
//   train::FinetuneSurfaceRun run;
//   run.people = train::load_people("real/finetune", {.match_colours = false});   // one folder a person
//   run.start = "models/face.safetensors";  run.synthetic = "faces/train";  run.folder = "runs/surface";
//   const train::FinetuneSurfaceReport report = train::finetune_surface(run, {});
//
// For highlights see finetune.h: this leaves the highlight layer as it is, but for what shared weights do to it. Weights inherit the
// terms of the photos they have seen.

#include "faceprobe/train/people.h"
#include "faceprobe/train/train.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace faceprobe::train {

// What a photo's layers are held to, and how far from the network's before finetuning they may go.
struct RerenderOptions {
  // Of the light's spherical harmonics. Order 2 leaves 9 % of the irradiance of a lone lamp at the side unexplained, order 4 5 %, and wrong
  // normals show as clearly against either.
  int order = 4;
  // Of the light, on its radiance coefficients; the shading has mean 1. It binds the harmonics that shading hardly shows. A face tells only of
  // the half of the sphere that it looks at, so that without it the fit is not unique.
  double ridge = 1e-5;
  double albedo_weight = 0.5;      // of the difference of a person's albedos, against that of shading and light
  double guard_weight = 1;         // of each guard
  double normal_slack_deg = 6;     // from the first network's normals, free of cost
  double contrast_slack = 0.2;     // of the shading's contrast, free of cost either way
  double confidence_slack = 0.25;  // of the mean confidence, that may be lost free of cost
  double curl_slack = 0.25;        // of the normals' mean curl, that may be added free of cost

  std::string validate() const;  // empty when usable, else a sentence that says which value is wrong
};

struct FinetuneSurfaceConfig {
  std::int64_t steps = 300;
  int photos = 4;               // of one person in a step, and of one light
  int synthetic_batch = 8;      // synthetic faces in a step; 0 = none
  double learning_rate = 5e-5;  // at the start; a half cosine down to a hundredth of it
  double weight = 1;            // of the loss on photos against that on synthetic faces
  RerenderOptions rerender;
  double largest_gradient = 1.0;  // norm over all weights
  double held_out_share = 0.25;   // of the people, to measure on
  std::uint64_t seed = 1;

  std::string validate() const;  // as above
};

struct FinetuneSurfaceRun {
  FinetuneSurfaceConfig config;
  // Their photos with the colours that they have: a photo's light is part of what is looked for.
  std::vector<PersonSet> people;
  // Each a set of photos of anybody under the same lights and camera, such as a studio's; may be empty. One light must explain all of them.
  std::vector<PersonSet> lights;
  std::filesystem::path start;       // weights of architecture "face"
  std::filesystem::path synthetic;   // with meshes; not read without synthetic_batch
  std::filesystem::path validation;  // synthetic faces to measure on, with meshes; empty = none
  std::filesystem::path folder;      // gets weights.safetensors and log.csv
  int threads = 0;
};

// Means over people who were held out; each number first the mean over that person's photos.
struct SurfaceScore {
  int people = 0;
  // Mean |irradiance of the best light - shading| / (shading + .1), of a shading whose mean is 1. Each pixel of skin counts alike here,
  // whatever confidence the network states.
  double residual = 0;
  double albedo = 0;             // mean difference from the person's mean albedo, relative
  double contrast = 0;           // standard deviation of the logarithm of the shading
  double confidence = 0;         // 0 to 1
  double normal_change_deg = 0;  // mean angle from the first network's normals
};

struct SurfaceRow {
  std::int64_t step = 0;
  double residual = 0,
         albedo = 0;  // means since the last row, of what was trained on; residual with the stated confidence as weight
  double lights = 0;  // residual of photos under one light
  double guards = 0;  // sum of them, before their weight
  double synthetic_loss = 0;  // of the synthetic faces, without unit
};

struct FinetuneSurfaceReport {
  SurfaceScore before, after;
  bool validated = false;
  Validation dev_before, dev_after;  // on the synthetic faces of `validation`
  std::vector<SurfaceRow> rows;
  std::filesystem::path weights;
  bool finished = false;
};

struct FinetuneSurfaceHooks {
  std::function<void(const SurfaceRow&, std::int64_t steps)> progress;  // at each row; of how many steps
  std::function<bool()> stop;                                           // asked at each step; true ends the run
};

// Throws Error: kInput (weights of another architecture than "face", too few people, none of the held-out photos shows skin), kUsage,
// kModel, kOutput, kUnexpected (the loss is no number).
FinetuneSurfaceReport finetune_surface(const FinetuneSurfaceRun& run, const FinetuneSurfaceHooks& hooks);

}  // namespace faceprobe::train
