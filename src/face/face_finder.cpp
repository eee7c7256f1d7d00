#include "face/detector.h"
#include "face/given_landmarks.h"
#include "face/mesh_network.h"
#include "face/pose.h"
#include "face/search_plan.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/face/canonical_mesh.h"
#include "faceprobe/face/face.h"
#include "faceprobe/io/data_files.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace faceprobe::face {
namespace {

constexpr const char* kFullRangeFile = "face_detection_full_range.tflite";
constexpr int kMaxTiles = 32;
// The short-range detector likes air around a face that fills the photo.
constexpr float kShortRangePadding = 1.5F;
// Beside a large face, faces much smaller than it are not worth 30 more looks: they tell little of the light.
constexpr float kCompanionFraction = 0.25F;
// How far the network's landmarks may be from the given ones, as a part of the face's size: more when it is sure of the
// face. Measured on tight crops under a single lamp: 0.11 at most, scores over 0.8; where there is no face, scores
// below 0.02.
constexpr float kMaxDisagreement = 0.12F;
constexpr float kMaxDisagreementWhenSure = 0.2F;
constexpr float kMinScoreWithLandmarks = 0.05F;

Box box_of(const Eigen::MatrixX3f& landmarks_px) {
  const Eigen::RowVector3f low = landmarks_px.colwise().minCoeff();
  const Eigen::RowVector3f size = landmarks_px.colwise().maxCoeff() - low;
  return {low.x(), low.y(), size.x(), size.y()};
}

float shared_area(const Box& a, const Box& b) {
  const float width = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
  const float height = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
  return std::max(width, 0.0F) * std::max(height, 0.0F);
}

// Two readings of one face: boxes that overlap by half, or one box mostly inside the other.
bool same_face(const Face& a, const Face& b) {
  const float both = shared_area(a.box, b.box);
  return both > 0.5F * (a.box.area() + b.box.area() - both) || both > 0.7F * std::min(a.box.area(), b.box.area());
}

void check(const Image& linear, const Camera& camera) {
  if (linear.empty() || (linear.channels() != 3 && linear.channels() != 1)) {
    throw Error(ExitCode::kUsage, "The picture is empty or has " + std::to_string(linear.channels()) +
                                      " channels; faces are looked for in linear pictures of 1 or 3 channels.");
  }
  if (!(camera.focal_px > 0) || !std::isfinite(camera.focal_px)) {
    throw Error(ExitCode::kUsage,
                "The focal length is " + std::to_string(camera.focal_px) + " px; it must be positive.");
  }
}

}  // namespace

std::string FinderOptions::validate() const {
  const auto fraction = [](double value) { return value >= 0 && value <= 1; };
  if (!fraction(min_detection_score) || !fraction(min_mesh_score))
    return "The scores a face must reach lie between 0 and 1.";
  if (min_face_px < 16)
    return "The smallest face is " + std::to_string(min_face_px) + " px wide; it must be at least 16 px.";
  if (max_faces < 1)
    return "The number of faces to look for is " + std::to_string(max_faces) + "; it must be at least 1.";
  if (threads < 0) return "The number of threads is " + std::to_string(threads) + "; it must be 0 (all) or more.";
  return {};
}

struct FaceFinder::Impl {
  explicit Impl(const FinderOptions& wanted)
      : options(wanted), mesh(load_canonical_mesh(io::data_file("canonical-face-model.obj"))),
        short_range(DetectorKind::kShortRange, io::data_file("face_detection_short_range.tflite")),
        full_range(DetectorKind::kFullRange, io::data_file(kFullRangeFile)),
        network(io::data_file("face_landmark.tflite")) {}

  // Pose and metric mesh from landmarks.
  Face complete(const Eigen::MatrixX3f& landmarks_px, float score, const Camera& camera) const {
    Face face;
    face.box = box_of(landmarks_px);
    face.score = score;
    face.landmarks_px = landmarks_px;
    face.camera_from_face = fit_pose(landmarks_px, mesh, camera);
    face.vertices_cam_m = posed_mesh(landmarks_px, face.camera_from_face, mesh, camera);
    face.reprojection_rms_px = reprojection_rms_px(
        mesh.vertices_m.cast<double>(), landmarks_px.leftCols<2>().cast<double>(), camera, face.camera_from_face);
    return face;
  }

  // The detectors take a face that stands on its head for one that does not; the network is then less sure than it
  // could be.
  MeshReading read_upright(const Sampler& photo, SquareRegion square) {
    constexpr float kSure = 0.9999F;
    MeshReading reading = network.read_refined(photo, square);
    if (reading.score > kSure) return reading;
    square.angle += std::numbers::pi_v<float>;
    MeshReading other = network.read_refined(photo, square);
    if (!other.landmarks_px.allFinite()) return reading;
    other = network.read_refined(photo, mesh_region(other.landmarks_px));  // the angle was a guess
    return other.score > reading.score ? other : reading;
  }

  // Looks at many squares on several threads, each with a detector of its own.
  std::vector<Detection> look_at(const std::vector<SquareRegion>& squares, const Sampler& photo) const {
    std::vector<std::vector<Detection>> seen(squares.size());
    parallel_for(static_cast<int>(squares.size()), options.threads, [&](int first, int last) {
      if (first == last) return;
      Detector detector(DetectorKind::kFullRange, io::data_file(kFullRangeFile));
      for (int i = first; i < last; ++i) {
        const auto at = static_cast<std::size_t>(i);
        seen[at] = detector.detect(photo, squares[at], options.min_detection_score);
      }
    });
    std::vector<Detection> all;
    for (const std::vector<Detection>& part : seen) all.insert(all.end(), part.begin(), part.end());
    return all;
  }

  // Runs the mesh network on what the detectors saw and keeps what it agrees with.
  void verify(std::vector<Detection> detections, const Sampler& photo, const Camera& camera, std::vector<Face>& faces) {
    detections = merge_overlapping(std::move(detections), kMergeOverlap);
    if (detections.size() > 2 * static_cast<std::size_t>(options.max_faces)) {
      detections.resize(2 * static_cast<std::size_t>(options.max_faces));
    }
    for (const Detection& detection : detections) {
      const MeshReading reading = read_upright(photo, mesh_region(detection));
      if (!(reading.score >= options.min_mesh_score) || !reading.landmarks_px.allFinite()) continue;
      const Box box = box_of(reading.landmarks_px);
      if (std::max(box.width, box.height) < static_cast<float>(options.min_face_px)) continue;
      Face face;
      try {
        face = complete(reading.landmarks_px, reading.score, camera);
      } catch (const Error&) {
        continue;  // landmarks that fit no face are no face
      }
      const auto known = std::ranges::find_if(faces, [&](const Face& other) { return same_face(face, other); });
      if (known == faces.end()) {
        faces.push_back(std::move(face));
      } else if (face.box.area() > 1.5F * known->box.area()) {
        *known = std::move(face);  // a part of a face looked like one
      }
    }
  }

  std::vector<Face> search(const Sampler& photo, const Camera& camera) {
    const int width = photo.width();
    const int height = photo.height();
    std::vector<Face> faces;
    std::vector<Detection> seen;
    const auto look = [&](Detector& detector, const SquareRegion& square) {
      std::ranges::copy(detector.detect(photo, square, options.min_detection_score), std::back_inserter(seen));
    };
    const auto verify_seen = [&] {
      verify(std::move(seen), photo, camera, faces);
      seen.clear();
    };

    look(short_range, whole_square(width, height, kShortRangePadding));
    look(full_range, whole_square(width, height, 1));
    verify_seen();

    float smallest = static_cast<float>(options.min_face_px);
    for (const Face& face : faces) smallest = std::max(smallest, kCompanionFraction * face.box.width);
    seen = look_at(plan_tiles(width, height, smallest, kMaxTiles), photo);
    verify_seen();

    // Nothing yet: a face larger than the photo, or one that lies on its side.
    if (faces.empty()) {
      look(short_range, whole_square(width, height, 2.5F));
      look(full_range, whole_square(width, height, 2));
      verify_seen();
    }
    for (const int degrees : {45, -45, 90, -90, 180}) {
      if (!faces.empty()) break;
      SquareRegion turned = whole_square(width, height, kShortRangePadding);
      turned.angle = static_cast<float>(degrees * std::numbers::pi / 180);
      look(short_range, turned);
      look(full_range, turned);
      verify_seen();
    }
    return faces;
  }

  FinderOptions options;
  CanonicalMesh mesh;
  Detector short_range;
  Detector full_range;
  MeshNetwork network;
};

FaceFinder::FaceFinder(const FinderOptions& options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  impl_ = std::make_unique<Impl>(options);
}

FaceFinder::~FaceFinder() = default;
FaceFinder::FaceFinder(FaceFinder&&) noexcept = default;
FaceFinder& FaceFinder::operator=(FaceFinder&&) noexcept = default;

std::vector<Face> FaceFinder::find(const Image& linear, const Camera& camera) const {
  check(linear, camera);
  Sampler photo(linear);
  photo.expose();
  std::vector<Face> faces = impl_->search(photo, camera);
  const auto area = [](const Face& face) { return face.box.area(); };
  if (faces.size() > static_cast<std::size_t>(impl_->options.max_faces)) {
    std::ranges::stable_sort(faces, std::greater<>{}, area);
    faces.resize(static_cast<std::size_t>(impl_->options.max_faces));
  }
  std::ranges::stable_sort(faces, {}, [](const Face& face) { return face.box.x + 0.5F * face.box.width; });
  return faces;
}

Face FaceFinder::from_landmarks(const Image& linear, const Camera& camera, const Eigen::MatrixX2f& landmarks_px) const {
  check(linear, camera);
  Face rough = rough_face(landmarks_px, impl_->mesh, camera);
  rough.box = box_of(rough.landmarks_px);

  Sampler photo(linear);
  const SquareRegion square = mesh_region(rough.landmarks_px);
  photo.expose(square);
  const MeshReading first = impl_->network.read(photo, square);
  if (!first.landmarks_px.allFinite()) return rough;
  const MeshReading second = impl_->network.read(photo, mesh_region(first.landmarks_px));
  const float first_error = disagreement(first.landmarks_px, landmarks_px);
  const float second_error = second.landmarks_px.allFinite() ? disagreement(second.landmarks_px, landmarks_px) : 1.0F;
  const MeshReading& best = second_error <= first_error ? second : first;
  const bool sure = best.score >= impl_->options.min_mesh_score;
  if (best.score < kMinScoreWithLandmarks) return rough;
  if (std::min(first_error, second_error) > (sure ? kMaxDisagreementWhenSure : kMaxDisagreement)) return rough;
  try {
    return impl_->complete(best.landmarks_px, 1, camera);
  } catch (const Error&) {
    return rough;
  }
}

}  // namespace faceprobe::face
