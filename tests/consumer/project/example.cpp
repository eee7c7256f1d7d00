#include <faceprobe/faceprobe.h>

#include <cstdio>

using namespace faceprobe;

int main(int argc, char** argv) {
  try {
    const io::Photo photo = io::load_photo(argc > 1 ? argv[1] : "portrait.jpg");
    const pipeline::Estimator estimator;  // loads the models once
    const pipeline::Estimate estimate = estimator.estimate(photo);
    const pipeline::FaceEstimate& face = estimate.largest_face();

    // The light: a map for renderers, the lamps that a person would name, harmonics for a shader.
    io::write_env_map("light.exr", face.environment);
    for (const lighting::MainLight& lamp : face.lights) {
      std::printf("light from %+.0f, %+.0f degrees: %.0f %% of the energy\n", azimuth_deg(lamp.direction),
                  elevation_deg(lamp.direction), 100 * lamp.share);
    }
    const Eigen::Vector3d above = sh::irradiance(face.sh, Eigen::Vector3d::UnitY());
    std::printf("on a table: %.2f %.2f %.2f\n", above.x(), above.y(), above.z());

    // A pot into the photo, in that light.
    const insert::Scene scene = pipeline::scene_for(photo, estimate, render::shape("pot"));
    io::write_picture("with_pot.png", insert::insert_model(photo.linear, scene).picture);

    // The face without its strongest lamp.
    Image dimmed = photo.linear;
    pipeline::relight(dimmed, face, pipeline::changed_light(face, {.dim = {{.light = 1}}}, estimator.options()));
    io::write_picture("dimmed.png", dimmed);
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());  // as of the command: 3 for what is no photo, 4 for one without a face
  }
}
