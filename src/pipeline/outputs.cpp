#include "faceprobe/pipeline/outputs.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/version.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/pipeline/overview.h"
#include "faceprobe/pipeline/report.h"
#include "pipeline/canvas.h"

namespace faceprobe::pipeline {

namespace {

using Path = std::filesystem::path;

struct Writer {
  const OutputOptions& output;
  const io::Attributes& attributes;
  std::vector<Path>& written;

  template <class Picture>
  void picture(const Path& path, const Picture& image) {
    io::write_picture(path, image, attributes);
    written.push_back(path);
  }
  // .exr as it is; .png with a gain that makes dim layers visible.
  void layer(const Path& folder, const std::string& name, const Image& image, float png_gain = 1.0F) {
    picture(folder / (name + ".exr"), image);
    picture(folder / (name + ".png"), encode_srgb(image, png_gain));
  }
  void maps(const Path& folder, const LightResult& light) {
    for (const char* extension : {".exr", ".hdr", ".png"}) {
      const Path path = folder / (std::string("environment") + extension);
      io::write_env_map(path, light.environment, output.orientation, attributes);
      written.push_back(path);
    }
    const EnvMap confidence = to_orientation(light.confidence, output.orientation);
    Image single(confidence.width(), confidence.height(), 1);
    for (int y = 0; y < single.height(); ++y) {
      for (int x = 0; x < single.width(); ++x) single(x, y) = confidence.radiance()(x, y, 0);
    }
    picture(folder / "confidence.exr", single);
  }
};

void write_face(const Path& folder, const Estimate& estimate, const io::Photo& photo, std::size_t index, int threads, Writer& writer) {
  const FaceEstimate& face = estimate.faces[index];
  io::create_folder(folder);
  writer.maps(folder, face);
  if (writer.output.layers) {
    writer.layer(folder, "highlight", face.layers.highlight);
    writer.layer(folder, "diffuse", face.layers.diffuse);
    writer.layer(folder, "albedo", face.albedo);
    writer.layer(folder, "shading", face.shading, display_gain(face.shading));
    writer.picture(folder / "normals.exr", face.geometry.normal_cam);
    writer.picture(folder / "normals.png", normals_picture(face.geometry));
    writer.picture(folder / "regions.png", regions_picture(face.geometry));
  }
  if (writer.output.overview) writer.picture(folder / "overview.png", draw_overview(estimate, photo, index, threads));
}

}  // namespace

std::map<std::string, std::string> provenance(const io::Photo& photo, const EstimateOptions& options) {
  return {{"faceprobe:version", std::string(kVersion)},
          {"faceprobe:frame", "camera: +x right, +y up, +z to the viewer"},
          {"faceprobe:separator", std::string(highlight::separator_name(options.separator))},
          {"faceprobe:solver", std::string(lighting::solver_name(options.solve.solver))},
          {"faceprobe:input_sha256", photo.sha256}};
}

std::vector<Path> write_outputs(const Path& folder, const Estimate& estimate, const io::Photo& photo,
                                const EstimateOptions& options, const std::string& source, const OutputOptions& output) {
  std::vector<Path> written;
  const io::Attributes attributes = provenance(photo, options);
  Writer writer{output, attributes, written};
  io::create_folder(folder);
  if (estimate.faces.size() == 1) {
    write_face(folder, estimate, photo, 0, options.threads, writer);
  } else {
    for (std::size_t i = 0; i < estimate.faces.size(); ++i) {
      write_face(folder / ("face_" + std::to_string(i + 1)), estimate, photo, i, options.threads, writer);
    }
    if (estimate.joint) {
      io::create_folder(folder / "joint");
      writer.maps(folder / "joint", *estimate.joint);
    }
    writer.maps(folder, estimate.faces[estimate.largest]);
    if (output.overview) writer.picture(folder / "overview.png", draw_overview(estimate, photo, estimate.largest, options.threads));
  }
  const Path report = folder / "report.json";
  io::write_file_atomically(report, report_json(estimate, photo, options, source));
  written.push_back(report);
  return written;
}

}  // namespace faceprobe::pipeline
