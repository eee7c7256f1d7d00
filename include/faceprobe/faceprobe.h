#pragma once
// All of Faceprobe for a program that turns photos of faces into light and uses that light. It finds the faces in a photo, takes apart what
// their skin mirrors and what it scatters, and solves for the light that did it: an HDR environment map, spherical harmonics, and the few lamps
// that a person would name. In that light it draws things into the photo, and it shows the faces in another.
//
// Not for video, not for recognising people, and not for absolute light: 1 is the photo's white. A program that needs one part includes that
// part's header, which compiles in a fraction of the time; synthetic faces, training and benchmarks have headers of their own.
//
// A program as a whole, to be linked with faceprobe::pipeline (and with faceprobe::assets_model where assets::model_named is to read files):
//
//   #include <faceprobe/faceprobe.h>
//
//   #include <cstdio>
//
//   using namespace faceprobe;
//
//   int main(int argc, char** argv) {
//     try {
//       const io::Photo photo = io::load_photo(argc > 1 ? argv[1] : "portrait.jpg");
//       const pipeline::Estimator estimator;  // loads the models once
//       const pipeline::Estimate estimate = estimator.estimate(photo);
//       const pipeline::FaceEstimate& face = estimate.largest_face();
//
//       // The light: a map for renderers, the lamps that a person would name, harmonics for a shader.
//       io::write_env_map("light.exr", face.environment);
//       for (const lighting::MainLight& lamp : face.lights) {
//         std::printf("light from %+.0f, %+.0f degrees: %.0f %% of the energy\n", azimuth_deg(lamp.direction),
//                     elevation_deg(lamp.direction), 100 * lamp.share);
//       }
//       const Eigen::Vector3d above = sh::irradiance(face.sh, Eigen::Vector3d::UnitY());
//       std::printf("on a table: %.2f %.2f %.2f\n", above.x(), above.y(), above.z());
//
//       // A pot into the photo, in that light.
//       const insert::Scene scene = pipeline::scene_for(photo, estimate, render::shape("pot"));
//       io::write_picture("with_pot.png", insert::insert_model(photo.linear, scene).picture);
//
//       // The face without its strongest lamp.
//       Image dimmed = photo.linear;
//       pipeline::relight(dimmed, face, pipeline::changed_light(face, {.dim = {{.light = 1}}}, estimator.options()));
//       io::write_picture("dimmed.png", dimmed);
//     } catch (const Error& error) {
//       std::fprintf(stderr, "%s\n", error.what());
//       return static_cast<int>(error.code());  // as of the command: 3 for what is no photo, 4 for one without a face
//     }
//   }

#include "faceprobe/assets/named_model.h"
#include "faceprobe/core/angles.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/sh.h"
#include "faceprobe/core/version.h"
#include "faceprobe/insert/insert.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/pipeline/estimate.h"
#include "faceprobe/pipeline/insertion.h"
#include "faceprobe/pipeline/insertion_files.h"
#include "faceprobe/pipeline/outputs.h"
#include "faceprobe/pipeline/relight.h"
#include "faceprobe/pipeline/report.h"
#include "faceprobe/pipeline/room.h"
#include "faceprobe/render/shapes.h"
