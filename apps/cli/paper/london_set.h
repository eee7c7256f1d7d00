#pragma once
// The files of the London set: over a hundred adults, each neutral and smiling, under the same three studio lights, which were measured from the
// reflections in their eyes (known to about 5 degrees).

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace faceprobe::cli {

struct LondonPerson {
  std::string id;
  std::filesystem::path neutral, smiling;
  std::string ethnicity;  // as the set's own table has it; empty where it has none
};

struct LondonSet {
  std::vector<Eigen::Vector3d> lights;  // unit, camera frame
  std::vector<LondonPerson> people;
};
// Every n-th of those with both photos. Throws Error(kInput) for a file of lights, or a table of people, that cannot be read.
LondonSet read_london(const std::filesystem::path& folder, int every);

}  // namespace faceprobe::cli
