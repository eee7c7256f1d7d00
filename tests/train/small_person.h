#pragma once
// A person in three small photos, with the true highlights.

#include "faceprobe/face/region.h"
#include "faceprobe/io/data_files.h"
#include "train/person_loss.h"

#include <cmath>
#include <vector>

namespace faceprobe::train::testing {

inline constexpr int kSquare = 40;
inline constexpr int kCrop = 56;

struct Person {
  std::vector<PersonPhoto> photos;
  ByteImage regions;
  std::vector<Image> highlights;  // the true ones
};

// One face's colours under three lights of different strength, from slightly different places, with a white highlight in another place
// each time. The colours are smooth, so that sampling does not change them much.
inline Person make_person(float redness = 0.6F) {
  const face::CanonicalMesh mesh = face::load_canonical_mesh(io::data_file("canonical-face-model.obj"));
  const FaceTemplate square = face_template(mesh, kSquare);
  Person person;
  person.regions = template_regions(square, face::triangle_regions(mesh));
  const Eigen::MatrixX3f centred = mesh.vertices_m.rowwise() - mesh.vertices_m.colwise().mean();
  for (int k = 0; k < 3; ++k) {
    WarpLandmarks landmarks{260.0F * centred.leftCols<2>(), -260.0F * centred.col(2)};
    landmarks.photo_px.col(0).array() += 28.0F + 1.5F * static_cast<float>(k);
    landmarks.photo_px.col(1) = 28.0F - landmarks.photo_px.col(1).array();
    PersonPhoto photo;
    photo.linear = Image(kCrop, kCrop, 3);
    photo.warp = face_warp(square, landmarks, {kCrop, kCrop});
    Image highlight(kCrop, kCrop, 3);
    for (int y = 0; y < kCrop; ++y) {
      for (int x = 0; x < kCrop; ++x) {
        const float face_x = static_cast<float>(x) - 1.5F * static_cast<float>(k);
        const float shade = 0.3F + 0.004F * static_cast<float>(k) * static_cast<float>(x);
        const float red = redness + 0.003F * face_x;
        const float green = 0.4F + 0.002F * static_cast<float>(y);
        const float dx = static_cast<float>(x - 22 - 6 * k);
        const float dy = static_cast<float>(y - 20);
        const float shine = 0.15F * std::exp(-(dx * dx + dy * dy) / 30.0F);
        const float diffuse[3] = {shade * red, shade * green, shade * 0.3F};
        for (int c = 0; c < 3; ++c) {
          highlight(x, y, c) = shine;
          photo.linear(x, y, c) = diffuse[c] + shine;
        }
      }
    }
    person.photos.push_back(std::move(photo));
    person.highlights.push_back(std::move(highlight));
  }
  return person;
}

}  // namespace faceprobe::train::testing
