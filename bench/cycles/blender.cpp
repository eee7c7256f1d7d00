#include "cycles/blender.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/picture_file.h"

#include <OpenImageIO/imageio.h>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

namespace faceprobe::bench {

namespace {

std::string quoted(const std::string& word) {
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

template <class Matrix>
void append(std::ofstream& file, const Matrix& matrix) {
  using Scalar = typename Matrix::Scalar;
  const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = matrix;
  file.write(reinterpret_cast<const char*>(rows.data()),
             static_cast<std::streamsize>(static_cast<std::size_t>(rows.size()) * sizeof(Scalar)));
}

// The channels whose names end in `.PASS.R` and so on.
Image pass(const OIIO::ImageSpec& spec, const std::vector<float>& values, const std::string& name,
           const std::string& letters, const std::filesystem::path& path) {
  std::vector<std::size_t> channels;
  for (const char letter : letters) {
    const std::string end = "." + name + "." + letter;
    for (std::size_t c = 0; c < spec.channelnames.size(); ++c) {
      if (spec.channelnames[c].ends_with(end)) channels.push_back(c);
    }
  }
  if (channels.size() != letters.size()) {
    throw Error(ExitCode::kModel, path.string() + " has no pass " + name + "; Blender 3.x writes it.");
  }
  Image out(spec.width, spec.height, static_cast<int>(letters.size()));
  const std::size_t stride = spec.channelnames.size();
  for (std::size_t i = 0; i < out.pixel_count(); ++i) {
    for (std::size_t c = 0; c < channels.size(); ++c)
      out.values()[i * channels.size() + c] = values[i * stride + channels[c]];
  }
  return out;
}

CyclesPicture read_passes(const std::filesystem::path& path) {
  const auto file = OIIO::ImageInput::open(path.string());
  if (!file) throw Error(ExitCode::kModel, "Blender left no picture " + path.string() + "; its log is beside it.");
  const OIIO::ImageSpec spec = file->spec();
  std::vector<float> values(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  if (!file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data())) {
    throw Error(ExitCode::kModel, "Cannot read " + path.string() + ".");
  }
  CyclesPicture picture;
  picture.diffuse = pass(spec, values, "DiffDir", "RGB", path);
  picture.glossy = pass(spec, values, "GlossDir", "RGB", path);
  picture.coverage = pass(spec, values, "Combined", "A", path);
  return picture;
}

}  // namespace

void write_map_for_blender(const std::filesystem::path& path, const EnvMap& map) {
  io::write_picture(path, to_orientation(map, Orientation::kThree).radiance(), {}, false);
}

std::vector<CyclesPicture> render_with_cycles(const CyclesSetup& setup, const std::vector<CyclesRender>& renders) {
  const std::filesystem::path folder = std::filesystem::absolute(setup.folder);
  const std::filesystem::path mesh_file = folder / "mesh.bin";
  const std::filesystem::path report_file = folder / "report.json";
  const std::filesystem::path log_file = folder / "blender.log";
  {
    std::ofstream file(mesh_file, std::ios::binary);
    append(file, setup.mesh_cam.vertices);
    append(file, setup.mesh_cam.normals);
    append(file, setup.mesh_cam.triangles);
    if (!file.flush()) throw Error(ExitCode::kOutput, "Cannot write " + mesh_file.string() + ".");
  }
  nlohmann::json job = {{"mesh", mesh_file.string()},
                        {"vertices", setup.mesh_cam.vertices.rows()},
                        {"triangles", setup.mesh_cam.triangles.rows()},
                        {"width", setup.camera.width_px},
                        {"height", setup.camera.height_px},
                        {"focal_px", setup.camera.focal_px},
                        {"alpha", setup.alpha},
                        {"threads", setup.threads},
                        {"report", report_file.string()},
                        {"renders", nlohmann::json::array()}};
  std::vector<std::filesystem::path> pictures;
  for (const CyclesRender& render : renders) {
    pictures.push_back(folder / ("cycles_" + std::to_string(pictures.size()) + ".exr"));
    job["renders"].push_back({{"map", std::filesystem::absolute(render.map).string()},
                              {"samples", render.samples},
                              {"seed", render.seed},
                              {"light_threshold", render.light_threshold},
                              {"out", pictures.back().string()}});
  }
  const std::filesystem::path job_file = folder / "job.json";
  std::ofstream(job_file) << job.dump(1);
  std::filesystem::remove(report_file);
  const std::string command = quoted(setup.blender) + " --background --factory-startup --python-exit-code 1 --python " +
                              quoted(FACEPROBE_CYCLES_SCRIPT) + " -- " + quoted(job_file.string()) + " > " +
                              quoted(log_file.string()) + " 2>&1";
  if (std::system(command.c_str()) != 0 || !std::filesystem::exists(report_file)) {
    throw Error(ExitCode::kModel, "Blender (" + setup.blender + ") did not finish; see " + log_file.string() +
                                      ". Blender 3.x with Cycles is needed; name it with --blender.");
  }
  std::ifstream report(report_file);
  const std::vector<double> seconds = nlohmann::json::parse(report).at("seconds").get<std::vector<double>>();
  std::vector<CyclesPicture> out;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    out.push_back(read_passes(pictures[i]));
    out.back().seconds = seconds.at(i);
  }
  return out;
}

std::string blender_version(const std::string& blender) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen((quoted(blender) + " --version 2>/dev/null").c_str(), "r"),
                                                   pclose);
  std::array<char, 200> line{};
  if (!pipe || !std::fgets(line.data(), static_cast<int>(line.size()), pipe.get())) return {};
  const std::string text = line.data();
  return text.rfind("Blender ", 0) == 0 ? text.substr(8, text.find_first_of("\r\n") - 8) : std::string();
}

}  // namespace faceprobe::bench
