#pragma once
// Photos of people, several of each, made ready for the unsupervised stage (paper, Section 5.1): the face found and cut out at the size the
// network works at, brought into the mesh's square, colours made those of the person's first photo, and unsuitable photos left out by
// measured criteria.
//
//   const std::vector<PersonSet> people = load_people("real/finetune/press13", {});   // one folder a person
//   for (const PersonSet& person : people) std::cout << person.name << ": " << person.photos.size() << '\n';

#include "faceprobe/core/image.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace faceprobe::train {

struct PersonPhoto;  // train/person_loss.h

struct PeopleOptions {
  int crop_px = 128;     // long side of the crops, as the network's training
  int square_px = 96;    // of the square in which photos are compared
  int least_photos = 4;  // people with fewer are left out
  int most_photos = 12;  // of one person
  // Error of the rigid mean face per width of the face, at most: a wide smile or an open mouth has more.
  double max_expression = 0.04;
  // Spread of chromaticity of a photo's light, at most, told by the person's other photos: a window and a lamp have more.
  double max_light_colours = 0.03;
  bool match_colours = true;  // by histogram transfer, as the paper does
  // Each photo is decoded by the response curve its skin tells of (train/radiometric.h), as sRGB where it tells of none.
  bool calibrate = false;
  int threads = 0;

  std::string validate() const;  // empty when usable
};

struct PersonSet {
  std::string name;
  std::vector<std::shared_ptr<const PersonPhoto>> photos;  // shared: a photo is part of many batches
  std::vector<ByteImage> masks;                            // skin in each crop, non-zero = skin
  std::vector<Image> meshes;                               // the mesh's normals in each crop, 0 off it
  ByteImage regions;                                       // of the square
  std::vector<std::string> left_out;                       // "NAME: why"
  int calibrated = 0;                                      // photos whose curve was not sRGB's
};

// Every folder at or below `folder` that holds photos is a person, named by its path from there. Folders that cannot be read throw
// Error(kInput); photos that cannot are left out with the reason. `progress`: a sentence for
// every photo left out and for every person.
std::vector<PersonSet> load_people(const std::filesystem::path& folder, const PeopleOptions& options,
                                   const std::function<void(const std::string&)>& progress = {});

// The same of the people in a folder that `faceprobe synth` wrote: their photos as a camera wrote them, each under another light, and no
// photo of a real person among them. `most_people`: spread evenly over those that there are.
std::vector<PersonSet> load_synthetic_people(const std::filesystem::path& folder, int most_people,
                                             const PeopleOptions& options,
                                             const std::function<void(const std::string&)>& progress = {});

}  // namespace faceprobe::train
