#include "ablation_methods.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/resample.h"
#include "faceprobe/synth/sensor.h"
#include "shared_estimate.h"

#include <algorithm>
#include <memory>

namespace faceprobe::cli {

namespace {

using lighting::Observations;
using pipeline::EstimateOptions;
using SharedPtr = std::shared_ptr<SharedEstimate>;

// Skin of one kind all over the face.
Observations one_skin(Observations o) {
  const float weight = o.weight.sum();
  o.roughness.setConstant(o.roughness.dot(o.weight) / weight);
  o.specular_albedo.setConstant(o.specular_albedo.dot(o.weight) / weight);
  return o;
}

Observations without_horizon(Observations o) {
  o.horizon.resize(0, 0);
  return o;
}

// What recolouring is told by; the paper's solver asks for nothing else of clipped pixels.
Observations nothing_clipped(Observations o) {
  o.clipped.setZero();
  return o;
}

ByteImage of_half_size(const ByteImage& photo) {
  return encode_srgb(resampled(decode_srgb(photo),
                               shrunk(photo.width(), photo.height(), std::max(photo.width(), photo.height()) / 2)));
}

// On a grid of its own, brought back to the others'.
eval::LightMethod coarse(const std::string& name, EstimateOptions options, int nside) {
  const auto to = std::make_shared<SphereGrid>(options.solve.nside);
  options.solve.nside = nside;
  const auto shared = std::make_shared<SharedEstimate>(options);
  const auto from = std::make_shared<SphereGrid>(nside);
  return {name, [shared, from, to](const eval::LightInput& input) {
            const pipeline::FaceEstimate* face = shared->of(input);
            return face == nullptr ? Eigen::MatrixX3f() : grid_from_grid(face->light.radiance, *from, *to);
          }};
}

}  // namespace

std::vector<eval::LightMethod> ablation_methods(const RelightRows& rows) {
  const EstimateOptions base = estimate_options(rows);
  const auto shared = std::make_shared<SharedEstimate>(base);
  std::vector<eval::LightMethod> methods = {whole("as it is", shared)};
  const auto changed = [&](const std::string& name, const auto& change) {
    EstimateOptions options = base;
    change(options);
    methods.push_back(whole(name, std::make_shared<SharedEstimate>(options)));
  };
  changed("no learnt light to start from", [](EstimateOptions& o) { o.prior = pipeline::PriorSource::kSmooth; });
  changed("highlights alone", [](EstimateOptions& o) { o.solve.shading_weight = 0; });
  changed("shading alone", [](EstimateOptions& o) { o.solve.highlight_weight = 0; });
  changed("highlights weighed as much as shading", [](EstimateOptions& o) { o.solve.highlight_weight = 1; });
  for (const int count : {1, 10, 50}) {
    changed(std::to_string(count) + (count == 1 ? " iteration" : " iterations") + " from the learnt light",
            [count](EstimateOptions& o) { o.solve.iterations_from_expected = count; });
  }
  methods.push_back(coarse("768 cells", base, 8));
  // The other way than it is, so that the row stays when the default changes.
  changed(base.solve.compact_light ? "no compact light" : "compact light where the pixels ask for one",
          [](EstimateOptions& o) { o.solve.compact_light = !o.solve.compact_light; });
  changed("shading as it is seen, with the face's own shadows alone",
          [](EstimateOptions& o) { o.solve.use_open_shading = false; });
  changed("normals of the mesh", [](EstimateOptions& o) { o.normals = pipeline::NormalSource::kMesh; });
  changed("one albedo a region", [](EstimateOptions& o) { o.shading = pipeline::ShadingSource::kRegions; });
  changed("layers of Yang's separator", [](EstimateOptions& o) { o.classical = highlight::Separator::kYang; });
  methods.push_back(other_solver("no cast shadows of the face itself", shared, [shared](const Observations& o) {
    return shared->light_of(without_horizon(o)).radiance;
  }));
  methods.push_back(other_solver("one kind of skin for all regions", shared,
                                 [shared](const Observations& o) { return shared->light_of(one_skin(o)).radiance; }));
  changed("no Fresnel term", [](EstimateOptions& o) { o.solve.fresnel = lighting::Fresnel::kConstant; });
  EstimateOptions paper = base;
  paper.solve.solver = lighting::Solver::kPaper;
  const auto by_paper = std::make_shared<SharedEstimate>(paper);
  methods.push_back(whole("paper's solver", by_paper));
  methods.push_back(other_solver("paper's solver, no recolouring", by_paper, [by_paper](const Observations& o) {
    return by_paper->light_of(nothing_clipped(o)).radiance;
  }));
  changed("paper's solver, 10 iterations", [](EstimateOptions& o) {
    o.solve.solver = lighting::Solver::kPaper;
    o.solve.iterations = 10;
  });
  const auto seen = [&](const std::string& name, const std::function<ByteImage(const ByteImage&)>& change) {
    methods.push_back(whole(name, std::make_shared<SharedEstimate>(base, change)));
  };
  for (const int quality : {75, 40, 15}) {
    seen("photo as a JPEG of quality " + std::to_string(quality),
         [quality](const ByteImage& photo) { return synth::jpeg_round_trip(photo, quality, true); });
  }
  seen("photo of half the size", of_half_size);
  seen("photo exposed a stop more", [](const ByteImage& photo) { return encode_srgb(decode_srgb(photo), 2); });
  return methods;
}

}  // namespace faceprobe::cli
