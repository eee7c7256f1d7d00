#pragma once
// Internal: a synthetic photo as the benchmarks see it: what a method is given, and where it is judged.

#include "faceprobe/eval/photo_input.h"
#include "faceprobe/synth/photo_layers.h"
#include "faceprobe/synth/shard.h"

#include <functional>
#include <string>
#include <vector>

namespace faceprobe::eval {

struct SyntheticPhoto {
  synth::Sample sample;
  synth::ViewLayers view;
  synth::PhotoLayers layers;
  ByteImage face;      // mask that the method is given
  Image mesh;          // and the mesh's normals
  ByteImage skin;      // where it is judged: the face's own skin inside that mask
  std::string person;  // whom it shows, or which group (photo_choice.h)

  SyntheticPhoto(const synth::ShardReader& faces, int number);

  PhotoInput input() const;
  // The same without a mask and a mesh.
  PhotoInput whole_input() const;
  double skin_share() const;  // of the crop
  bool enough_skin() const;   // to judge by: 5 %
  // The skin's tone from the true albedo (skin_tone.h).
  std::string tone() const;
  // How far the head is turned from the camera, either way, in degrees: one of turn_names(), or "unknown" where there is no head.
  std::string turn() const;
  // The share of that skin whose pixels were clipped: one of clipped_names(). Wants some skin.
  std::string clipped() const;
  // skin_share(): one of size_names().
  std::string size() const;

 private:
  ByteImage no_mask_;
  Image no_mesh_;
};

// Calls visit(number, photo) for the samples of these numbers (photo_choice.h), but for those that show too little skin.
void visit_photos(const synth::ShardReader& faces, const std::vector<int>& numbers,
                  const std::function<void(int done, int total)>& progress,
                  const std::function<void(int number, const SyntheticPhoto& photo)>& visit);

// Names of the skin tones from light to dark, as tables order them.
std::vector<std::string> tone_names();
// Those of its turns, from the front.
std::vector<std::string> turn_names();
// Shares, from none up.
std::vector<std::string> clipped_names();
std::vector<std::string> size_names();

}  // namespace faceprobe::eval
