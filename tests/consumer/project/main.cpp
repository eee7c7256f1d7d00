// Uses the installed package as somebody else's program would. Compiled without Faceprobe's own flags, so it also shows that
// matrices allocated in the library can be freed here.

#include <faceprobe/core/env_map.h>
#include <faceprobe/core/sh.h>

#include <cmath>
#include <cstdio>

int main() {
  faceprobe::EnvMap map(64, 32);
  map.radiance()(16, 16, 0) = 10;  // a red light at camera right: u = .25, just below the horizon

  const Eigen::Vector3f right = map.sample({1, 0, 0});
  const Eigen::Vector3f left = map.sample({-1, 0, 0});
  if (!(right.x() > 1 && left.x() == 0)) {
    std::printf("the red light is not at camera right: %g there, %g opposite\n", right.x(), left.x());
    return 1;
  }
  const Eigen::MatrixX3d coefficients = faceprobe::sh::project(map, 2);
  const double right_lobe = coefficients(3, 0);  // (1, 1) goes with +x
  if (coefficients.rows() != 9 || !(right_lobe > 0) || !std::isfinite(right_lobe)) {
    std::printf("the light has no positive coefficient along +x: %g\n", right_lobe);
    return 1;
  }
  std::printf("installed package works\n");
  return 0;
}
