// Uses the installed package as somebody else's program would. Compiled without Faceprobe's own flags, so it also shows that
// matrices allocated in the library can be freed here. With a photo as argument it prints where the light in it comes from.

#include <faceprobe/core/angles.h>
#include <faceprobe/core/env_map.h>
#include <faceprobe/core/error.h>
#include <faceprobe/core/sh.h>
#include <faceprobe/io/photo.h>
#include <faceprobe/pipeline/estimate.h>

#include <cmath>
#include <cstdio>

namespace {

bool maps_work() {
  faceprobe::EnvMap map(64, 32);
  map.radiance()(16, 16, 0) = 10;  // a red light at camera right: u = .25, just below the horizon

  const Eigen::Vector3f right = map.sample({1, 0, 0});
  const Eigen::Vector3f left = map.sample({-1, 0, 0});
  if (!(right.x() > 1 && left.x() == 0)) {
    std::printf("the red light is not at camera right: %g there, %g opposite\n", right.x(), left.x());
    return false;
  }
  const Eigen::MatrixX3d coefficients = faceprobe::sh::project(map, 2);
  const double right_lobe = coefficients(3, 0);  // (1, 1) goes with +x
  if (coefficients.rows() != 9 || !(right_lobe > 0) || !std::isfinite(right_lobe)) {
    std::printf("the light has no positive coefficient along +x: %g\n", right_lobe);
    return false;
  }
  return true;
}

bool options_are_checked() {
  faceprobe::pipeline::EstimateOptions options;
  if (!options.validate().empty()) {
    std::printf("the default options do not validate: %s\n", options.validate().c_str());
    return false;
  }
  options.map_width = 3;
  if (options.validate().empty()) {
    std::printf("a map 3 px wide validates\n");
    return false;
  }
  return true;
}

// Loads the installed models and runs the detector.
bool no_face_is_an_error() {
  faceprobe::io::Photo blank;
  blank.linear = faceprobe::Image(160, 120, 3, 0.4F);
  blank.clipped = faceprobe::ByteImage(160, 120, 1);
  const faceprobe::pipeline::Estimator estimator;
  try {
    estimator.estimate(blank);
  } catch (const faceprobe::Error& error) {
    return error.code() == faceprobe::ExitCode::kNoFace;
  }
  std::printf("a blank picture has a face\n");
  return false;
}

void print_lights(const char* photo) {
  const faceprobe::pipeline::Estimate estimate =
      faceprobe::pipeline::Estimator().estimate(faceprobe::io::load_photo(photo));
  for (const faceprobe::lighting::MainLight& light : estimate.largest_face().lights) {
    std::printf("azimuth %+.0f, elevation %+.0f degrees: %.0f %% of the energy\n",
                faceprobe::azimuth_deg(light.direction), faceprobe::elevation_deg(light.direction), 100 * light.share);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (!maps_work() || !options_are_checked() || !no_face_is_an_error()) return 1;
    if (argc > 1) print_lights(argv[1]);
  } catch (const faceprobe::Error& error) {
    std::printf("%s\n", error.what());
    return static_cast<int>(error.code());
  }
  std::printf("installed package works\n");
  return 0;
}
