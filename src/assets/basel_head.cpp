#include "assets/array.h"
#include "assets/basel.h"
#include "assets/finish_head.h"
#include "faceprobe/assets/heads.h"
#include "faceprobe/synth/skin_regions.h"

namespace faceprobe::assets {

synth::HeadModel load_basel_head(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension != ".mat" && extension != ".h5") {
    refuse_input(quoted(path) + " is neither a .mat file (Basel Face Model 2009) nor an .h5 file (2017, 2019).");
  }
  synth::HeadModel model = extension == ".mat" ? read_basel_2009(path) : read_basel_h5(path);
  make_all_skin(model);
  turn_outwards(model);
  if (model.landmarks.empty()) read_landmarks_beside(path, model);
  move_origin_between_eyes(model);
  model.vertex_region = synth::regions_from_landmarks(model);
  require_valid(model, quoted(path));
  return model;
}

}  // namespace faceprobe::assets
