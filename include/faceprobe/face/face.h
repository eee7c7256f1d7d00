#pragma once
// A face found in a photo: where it is in the picture, its dense landmarks, and where the head is in metres.
//
//   FaceFinder finder;                                       // loads the detector and the mesh network once
//   std::vector<Face> faces = finder.find(photo.linear, {focal_px, width / 2.0, height / 2.0});
//
// Not for recognising people: nothing here describes an identity.

#include "faceprobe/core/image.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace faceprobe::face {

// An upright rectangle; x, y is its top left corner.
struct Box {
  float x = 0, y = 0, width = 0, height = 0;  // pixels of the photo

  float area() const { return width * height; }
};

inline constexpr int kMeshVertices = 468;  // MediaPipe's canonical face mesh

// Where a photo's pixels look. Pinhole, square pixels, principal point usually at width / 2, height / 2.
struct Camera {
  double focal_px = 0;
  double centre_x_px = 0, centre_y_px = 0;

  // Unit vector from the scene point seen at (x, y) towards the camera, camera frame (+x right, +y up, +z to the
  // viewer).
  Eigen::Vector3d view_direction(double x_px, double y_px) const;
  // Pixel of a point in the camera frame, metres; z < 0, in front of the camera.
  Eigen::Vector2d project(const Eigen::Vector3d& point_cam_m) const;
};

struct Face {
  Box box;          // of the landmarks
  float score = 0;  // the mesh network's face probability, 0..1 (1 when the landmarks were given)
  // 468 x 3: x, y in pixels of the photo (y down); z in pixels too, relative to the face's mean depth, smaller = nearer
  // to the camera.
  Eigen::MatrixX3f landmarks_px;
  // Takes the canonical mesh (metres, +x subject's left = photo's right, +y up, +z out of the face) into the camera
  // frame.
  Eigen::Isometry3d camera_from_face = Eigen::Isometry3d::Identity();
  Eigen::MatrixX3f vertices_cam_m;  // 468 x 3: the mesh in the camera frame, metres, consistent with landmarks and camera
  double reprojection_rms_px = 0;  // of the rigid canonical mesh; large for strong expressions
  bool rough_landmarks = false;    // made from 5 or 68 given points by a rigid fit of the mean face

  Eigen::Vector3d position_m() const { return camera_from_face.translation(); }  // canonical origin, between the ears
};

// The face with the largest box; the first of several. `faces` must not be empty.
inline const Face& largest_of(const std::vector<Face>& faces) {
  return *std::max_element(faces.begin(), faces.end(),
                           [](const Face& a, const Face& b) { return a.box.area() < b.box.area(); });
}

// min_face_px for synthetic pictures: their sides may be no more than 128 px, and a head that is turned away is as narrow as this in them.
inline constexpr int kSmallFacePx = 30;

struct FinderOptions {
  float min_detection_score = 0.5F;  // of the detector
  float min_mesh_score = 0.5F;       // of the mesh network's face flag
  int min_face_px = 60;              // faces narrower than this are not looked for
  int max_faces = 32;
  int threads = 0;  // 0 = all

  std::string validate() const;  // empty when usable
};

// Loads face_detection_short_range.tflite, face_detection_full_range.tflite, face_landmark.tflite and
// canonical-face-model.obj from the data folder (io/data_files.h). Throws Error(kModel) when one is missing or damaged.
// One finder, one thread at a time.
class FaceFinder {
 public:
  // Throws Error(kUsage) for options that do not validate too.
  explicit FaceFinder(const FinderOptions& options = {});
  ~FaceFinder();
  FaceFinder(FaceFinder&&) noexcept;
  FaceFinder& operator=(FaceFinder&&) noexcept;
  FaceFinder(const FaceFinder&) = delete;
  FaceFinder& operator=(const FaceFinder&) = delete;

  // Faces of a linear photo of 1 or 3 channels, left to right by box centre; empty when there is none. Throws Error(kUsage) for an empty
  // picture, another number of channels, and a focal length that is not above 0.
  std::vector<Face> find(const Image& linear, const Camera& camera) const;
  // The mesh of a face whose five or 68 landmarks (#points x 2, px; 5: eyes left to right in the image, nose tip, mouth
  // corners left to right; 68: the iBUG/Multi-PIE order) the caller knows. Tries the mesh network on the crop they
  // imply, and falls back to a rigid fit of the canonical mesh (`rough_landmarks`). Throws Error(kUsage) as
  // find() does, and for another number of points or points that are not finite; Error(kNoFace) for points that no head fits.
  Face from_landmarks(const Image& linear, const Camera& camera, const Eigen::MatrixX2f& landmarks_px) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace faceprobe::face
