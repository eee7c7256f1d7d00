#pragma once
// The lamps of a room from the faces of one photo (paper Sec. 4.4): where the main lights of several faces meet, lighting/triangulate.h.
//
//   const pipeline::Estimate estimate = estimator.estimate(photo);
//   const pipeline::Room room = pipeline::find_lamps(estimate);      // throws Error(kNoFace) for fewer than two faces
//   io::write_picture("room.png", pipeline::draw_room(room));
//
// Places are as good as the faces' own: a head is taken to be of average size and the focal length to be right, and all distances grow with an
// error of either.

#include "faceprobe/lighting/triangulate.h"
#include "faceprobe/pipeline/estimate.h"

#include <filesystem>
#include <string>
#include <vector>

namespace faceprobe::pipeline {

struct RoomOptions {
  lighting::TriangulateOptions triangulate;
  double least_position_error_m = 0.05;
  double relative_position_error = 0.06;  // of a face's distance: the spread of head sizes

  std::string validate() const;
};

struct Room {
  std::vector<lighting::FaceLights> faces;  // as in the estimate
  std::vector<lighting::Lamp> lamps;
};

// Throws Error(kNoFace) for fewer than two faces, Error(kUsage) for options that do not validate.
Room find_lamps(const Estimate& estimate, const RoomOptions& options = {});

// One JSON object, schema "faceprobe-room/1": frame, faces and lamps with their errors. `source`: what the user called the photo.
std::string room_json(const Room& room, const std::string& source);
// glTF 2.0, text, without buffers: the camera, a node a face, and the lamps as KHR_lights_punctual; metres, +y up, errors as extras.
std::string room_gltf(const Room& room, const face::Camera& camera, int photo_width, int photo_height);
// From above and from the side, as in the paper's figure: camera, faces, rays, lamps and one standard deviation about them. sRGB.
ByteImage draw_room(const Room& room);
// All three as room.json, room.gltf and room.png of the folder, which is made where it is not there; returns them in order. In room.gltf the
// faces' nodes have their meshes. Throws Error(kOutput), Error(kModel) without the mesh's file.
std::vector<std::filesystem::path> write_room(const std::filesystem::path& folder, const Room& room,
                                              const Estimate& estimate, const std::string& source);

}  // namespace faceprobe::pipeline
