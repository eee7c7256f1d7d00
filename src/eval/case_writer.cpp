#include "eval/case_notes.h"
#include "eval/case_pose.h"
#include "faceprobe/eval/case_folder.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/picture_file.h"

#include <stdexcept>

namespace faceprobe::eval {

void write_case(const std::filesystem::path& folder, const Case& one) {
  if (const std::string problem = one.validate(); !problem.empty()) throw std::invalid_argument(problem);
  io::create_folder(folder);
  if (!one.highlight.empty()) io::write_picture(folder / "highlight.exr", one.highlight);
  if (!one.diffuse.empty()) io::write_picture(folder / "diffuse.exr", one.diffuse);
  if (!one.normal_cam.empty()) io::write_picture(folder / "normal.exr", one.normal_cam);
  if (!one.mask.empty()) io::write_picture(folder / "mask.png", one.mask);
  if (one.light) io::write_env_map(folder / "gt.hdr", *one.light);
  if (one.pose) io::write_file_atomically(folder / "pose.txt", pose_text(*one.pose));
  if (const std::string notes = notes_text(one); !notes.empty()) io::write_file_atomically(folder / "case.json", notes);
  // Last: without it a folder is no case.
  io::write_picture(folder / "photo.png", one.photo);
}

}  // namespace faceprobe::eval
