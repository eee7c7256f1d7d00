#include "faceprobe/pipeline/outputs.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/core/version.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/pipeline/overview.h"
#include "faceprobe/pipeline/scene_files.h"
#include "pipeline/canvas.h"

#include <atomic>
#include <functional>
#include <future>
#include <utility>

namespace faceprobe::pipeline {

namespace {

using Path = std::filesystem::path;

// What is to be written, in order. Encoding and waiting for the disk overlap when the jobs run side by side.
class Writer {
 public:
  Writer(const OutputOptions& output, io::Attributes attributes)
      : output_(output), attributes_(std::move(attributes)) {}

  void job(const Path& path, std::function<void()> write) {
    written_.push_back(path);
    jobs_.push_back(std::move(write));
  }
  void picture(const Path& path, const Image& image) {
    job(path, [this, path, &image] { io::write_picture(path, image, attributes_); });
  }
  void drawing(const Path& path, std::function<ByteImage()> draw) {
    job(path, [this, path, draw = std::move(draw)] { io::write_picture(path, draw(), attributes_); });
  }
  // .exr as it is; .png with a gain that makes dim layers visible.
  void layer(const Path& folder, const std::string& name, const Image& image, bool exposed) {
    picture(folder / (name + ".exr"), image);
    drawing(folder / (name + ".png"),
            [&image, exposed] { return encode_srgb(image, exposed ? display_gain(image) : 1.0F); });
  }
  void text(const Path& path, std::function<std::string()> write) {
    job(path, [path, write = std::move(write)] { io::write_file_atomically(path, write()); });
  }
  // The map, and scenes of other tools that stand on the map without its main light.
  void maps(const Path& folder, const LightResult& light, const EstimateOptions& options) {
    for (const char* extension : {".exr", ".hdr", ".png"}) {
      const Path path = folder / (std::string("environment") + extension);
      job(path, [this, path, &light] { io::write_env_map(path, light.environment, output_.orientation, attributes_); });
    }
    const Path path = folder / "confidence.exr";
    job(path, [this, path, &light] { io::write_picture(path, single_channel(light.confidence), attributes_); });
    const std::string rest_file = "environment_rest.exr";
    // By the first of the jobs that wants it.
    const std::shared_future<EnvMap> rest =
        std::async(std::launch::deferred, [&light, &options] { return rest_of_environment(light, options); }).share();
    job(folder / rest_file, [this, at = folder / rest_file, rest] {
      io::Attributes attributes = attributes_;
      attributes["faceprobe:map_columns"] = orientation_name(Orientation::kOpenExr);
      io::write_env_map(at, rest.get(), Orientation::kOpenExr, attributes);
    });
    text(folder / "light.usda", [&light, rest_file] { return usd_scene(light, rest_file); });
    text(folder / "light.gltf", [&light, rest] { return gltf_scene(light, rest.get()); });
    text(folder / "blender.py", [&light, rest_file] { return blender_script(light, rest_file); });
  }
  void run(int threads) {
    // A job or two more than processors: writing is partly waiting.
    const int workers = 2 * (threads > 0 ? threads : default_thread_count());
    std::atomic<std::size_t> next{0};
    parallel_for(workers, workers, [&](int, int) {
      for (std::size_t i = next++; i < jobs_.size(); i = next++) jobs_[i]();
    });
  }
  std::vector<Path> written() && { return std::move(written_); }

 private:
  Image single_channel(const EnvMap& map) const {
    const EnvMap turned = to_orientation(map, output_.orientation);
    Image single(turned.width(), turned.height(), 1);
    for (int y = 0; y < single.height(); ++y) {
      for (int x = 0; x < single.width(); ++x) single(x, y) = turned.radiance()(x, y, 0);
    }
    return single;
  }

  const OutputOptions& output_;
  io::Attributes attributes_;
  std::vector<Path> written_;
  std::vector<std::function<void()>> jobs_;
};

void add_face(const Path& folder, const Estimate& estimate, const io::Photo& photo, std::size_t index,
              const EstimateOptions& options, const OutputOptions& output, Writer& writer) {
  const FaceEstimate& face = estimate.faces[index];
  io::create_folder(folder);
  if (output.overview) {
    writer.drawing(folder / "overview.png",
                   [&estimate, &photo, index] { return draw_overview(estimate, photo, index, 1); });
  }
  writer.maps(folder, face, options);
  if (!output.layers) return;
  writer.layer(folder, "highlight", face.layers.highlight, false);
  writer.layer(folder, "diffuse", face.layers.diffuse, false);
  writer.layer(folder, "albedo", face.albedo, false);
  writer.layer(folder, "shading", face.shading, true);
  writer.picture(folder / "normals.exr", face.geometry.normal_cam);
  writer.drawing(folder / "normals.png", [&face] { return normals_picture(face.geometry); });
  writer.drawing(folder / "regions.png", [&face] { return regions_picture(face.geometry); });
}

}  // namespace

std::string orientation_name(Orientation orientation) {
  switch (orientation) {
    case Orientation::kThree: return "three.js, Blender: rolled by a quarter of the width";
    case Orientation::kDebevec: return "Debevec: rolled by half the width";
    default: return "OpenEXR: centre = +z";
  }
}

Orientation orientation_from_name(const std::string& name, const std::string& what) {
  if (name == "openexr") return Orientation::kOpenExr;
  if (name == "three" || name == "blender") return Orientation::kThree;
  if (name == "debevec") return Orientation::kDebevec;
  throw Error(ExitCode::kUsage, what + " takes openexr, three, blender or debevec, found '" + name + "'.");
}

std::map<std::string, std::string> provenance(const EstimateOptions& options) {
  return {{"faceprobe:version", std::string(kVersion)},
          {"faceprobe:frame", "camera: +x right, +y up, +z to the viewer"},
          {"faceprobe:separator", options.separator_name()},
          {"faceprobe:solver", std::string(lighting::solver_name(options.solve.solver))}};
}

std::map<std::string, std::string> provenance(const io::Photo& photo, const EstimateOptions& options) {
  std::map<std::string, std::string> attributes = provenance(options);
  attributes["faceprobe:input_sha256"] = photo.sha256;
  return attributes;
}

std::vector<Path> write_light(const Path& folder, const LightResult& light, const EstimateOptions& options,
                              const OutputOptions& output) {
  io::Attributes attributes = provenance(options);
  attributes["faceprobe:map_columns"] = orientation_name(output.orientation);
  Writer writer(output, std::move(attributes));
  io::create_folder(folder);
  writer.maps(folder, light, options);
  writer.run(options.threads);
  return std::move(writer).written();
}

std::vector<Path> write_joint(const Path& folder, const LightResult& light, const std::vector<JointPhoto>& photos,
                              const EstimateOptions& options, const OutputOptions& output) {
  std::vector<Path> written = write_light(folder, light, options, output);
  written.push_back(folder / "report.json");
  io::write_file_atomically(written.back(), joint_report_json(light, photos, options));
  return written;
}

std::vector<Path> write_outputs(const Path& folder, const Estimate& estimate, const io::Photo& photo,
                                const EstimateOptions& options, const std::string& source, const OutputOptions& output) {
  io::Attributes attributes = provenance(photo, options);
  attributes["faceprobe:map_columns"] = orientation_name(output.orientation);
  Writer writer(output, std::move(attributes));
  io::create_folder(folder);
  if (estimate.faces.size() == 1) {
    add_face(folder, estimate, photo, 0, options, output, writer);
  } else {
    for (std::size_t i = 0; i < estimate.faces.size(); ++i) {
      add_face(folder / face_folder(i), estimate, photo, i, options, output, writer);
    }
    if (estimate.joint) {
      io::create_folder(folder / "joint");
      writer.maps(folder / "joint", *estimate.joint, options);
    }
    writer.maps(folder, estimate.largest_face(), options);
    if (output.overview) {
      writer.drawing(folder / "overview.png", [&] { return draw_overview(estimate, photo, estimate.largest, 1); });
    }
  }
  writer.run(options.threads);
  // Last: a new report stands for complete results.
  const Path report = folder / "report.json";
  io::write_file_atomically(report, report_json(estimate, photo, options, source));
  std::vector<Path> written = std::move(writer).written();
  written.push_back(report);
  return written;
}

}  // namespace faceprobe::pipeline
