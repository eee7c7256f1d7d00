#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/pipeline/room.h"
#include "pipeline/face_meshes.h"

namespace faceprobe::pipeline {

std::vector<std::filesystem::path> write_room(const std::filesystem::path& folder, const Room& room,
                                              const Estimate& estimate, const std::string& source) {
  auto gltf =
      nlohmann::ordered_json::parse(room_gltf(room, estimate.camera, estimate.photo_width, estimate.photo_height));
  add_face_meshes(gltf, estimate);
  std::vector<std::filesystem::path> files = {folder / "room.png", folder / "room.gltf", folder / "room.json"};
  io::create_folder(folder);
  io::write_picture(files[0], draw_room(room));
  io::write_file_atomically(files[1], gltf.dump(1) + "\n");
  io::write_file_atomically(files[2], room_json(room, source));
  return files;
}

}  // namespace faceprobe::pipeline
