#include "eval/case_pose.h"

#include "faceprobe/core/error.h"

#include <Eigen/LU>
#include <array>
#include <charconv>
#include <cmath>

namespace faceprobe::eval {
namespace {

constexpr std::array<std::size_t, 5> kNumbersOfLine = {1, 2, 4, 4, 4};
constexpr double kRotationTolerance = 1e-3;  // of the rows' products: files have three digits at least

std::string number_text(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

[[noreturn]] void refuse_pose(const std::string& file, const std::string& what) {
  throw Error(ExitCode::kInput, file + " " + what +
                                    "; it has five lines: focal length; principal point (x y); three rows of four "
                                    "numbers, camera from head. docs/cases.md has one.");
}

// The numbers of a line; nothing where it is a comment or empty.
std::vector<double> numbers_of(std::string_view line, const std::string& file) {
  constexpr std::string_view kBlank = " \t\r";
  std::vector<double> numbers;
  line = line.substr(0, line.find('#'));
  while (true) {
    const std::size_t start = line.find_first_not_of(kBlank);
    if (start == std::string_view::npos) return numbers;
    line.remove_prefix(start);
    const std::string_view word = line.substr(0, line.find_first_of(kBlank));
    const std::string_view digits = word.substr(word.starts_with('+') ? 1 : 0);  // which from_chars does not take
    double value = 0;
    const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (fault != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
      refuse_pose(file, "has '" + std::string(word.substr(0, 40)) + "' where a number is wanted");
    numbers.push_back(value);
    line.remove_prefix(word.size());
  }
}

}  // namespace

std::string pose_text(const CasePose& pose) {
  std::string text = "# focal length, px\n" + number_text(pose.camera.focal_px) +
                     "\n# principal point, px from the top left corner: x y\n" + number_text(pose.camera.centre_x_px) +
                     " " + number_text(pose.camera.centre_y_px) +
                     "\n# camera from head, metres: rotation and translation, row by row\n";
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column)
      text += number_text(pose.camera_from_head.matrix()(row, column)) + (column < 3 ? " " : "\n");
  }
  return text;
}

CasePose pose_from_text(std::string_view text, const std::string& file) {
  std::vector<double> all;
  std::size_t lines = 0;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    const std::vector<double> numbers = numbers_of(text.substr(0, end), file);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (numbers.empty()) continue;
    if (lines == kNumbersOfLine.size()) refuse_pose(file, "goes on in line " + std::to_string(number));
    if (numbers.size() != kNumbersOfLine[lines]) {
      refuse_pose(file, "has " + std::to_string(numbers.size()) + " number(s) in line " + std::to_string(number) +
                            " where " + std::to_string(kNumbersOfLine[lines]) + " belong(s)");
    }
    all.insert(all.end(), numbers.begin(), numbers.end());
    ++lines;
  }
  if (lines < kNumbersOfLine.size()) refuse_pose(file, "has " + std::to_string(lines) + " line(s) of numbers");
  CasePose pose;
  pose.camera = {.focal_px = all[0], .centre_x_px = all[1], .centre_y_px = all[2]};
  for (int i = 0; i < 12; ++i) pose.camera_from_head.matrix()(i / 4, i % 4) = all[static_cast<std::size_t>(3 + i)];
  return pose;
}

std::string pose_problem(const CasePose& pose, const std::string& file) {
  const face::Camera& camera = pose.camera;
  if (!(camera.focal_px > 0) || !std::isfinite(camera.focal_px + camera.centre_x_px + camera.centre_y_px))
    return file + " has a focal length of " + number_text(camera.focal_px) + " px; it must be above 0.";
  const Eigen::Matrix3d rotation = pose.camera_from_head.linear();
  const double off = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(off <= kRotationTolerance) || !(rotation.determinant() > 0)) {
    return file +
           " has a matrix that is no rotation; its rows must be of length 1, at right angles, and not mirrored "
           "(+x right, +y up, +z to the viewer).";
  }
  const double z = pose.camera_from_head.translation().z();
  if (!(z < 0) || !pose.camera_from_head.translation().allFinite())
    return file + " has the head at z = " + number_text(z) + " m; what the camera sees has z below 0.";
  return {};
}

}  // namespace faceprobe::eval
