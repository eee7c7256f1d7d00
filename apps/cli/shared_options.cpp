#include "shared_options.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/picture_file.h"
#ifdef FACEPROBE_HAS_SYNTH
#include "one_head.h"
#endif
#ifdef FACEPROBE_HAS_TRAIN
#include "shading_split.h"
#endif

#include <spdlog/fmt/fmt.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace faceprobe::cli {

namespace {

int whole_number(const std::string& text, const std::string& what) {
  int value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size() || text.empty()) {
    throw Error(ExitCode::kUsage, what + " must be a whole number, found '" + text + "'.");
  }
  return value;
}

template <class Choice>
Choice one_of(const std::string& text, const char* option, const char* first, Choice first_choice, const char* second,
              Choice second_choice) {
  if (text == first) return first_choice;
  if (text == second) return second_choice;
  throw Error(ExitCode::kUsage, std::string(option) + " takes " + first + " or " + second + ", found '" + text + "'.");
}

void choose_geometry(const SharedOptions& options, pipeline::EstimateOptions& out) {
  const bool fitted = options.geometry == "3dmm";
  if (fitted == options.head.empty()) {
    throw Error(ExitCode::kUsage, fitted ? "--geometry 3dmm fits a head model; name it with --head PATH."
                                         : "--head is the model that --geometry 3dmm fits; give that too.");
  }
  if (!fitted) {
    if (options.geometry != "net" && options.geometry != "mesh")
      throw Error(ExitCode::kUsage, "--geometry takes net, mesh or 3dmm, found '" + options.geometry + "'.");
    out.normals = options.geometry == "net" ? pipeline::NormalSource::kNet : pipeline::NormalSource::kMesh;
    return;
  }
#ifdef FACEPROBE_HAS_SYNTH
  out.normals = pipeline::NormalSource::kFit;
  out.surface_fit = surface_of_head(options.head, options.threads);
#else
  throw Error(ExitCode::kUsage, "--geometry 3dmm is not in this program: it was built without head models.");
#endif
}

void choose_shading(const SharedOptions& options, pipeline::EstimateOptions& out) {
  out.shading = one_of(options.shading, "--shading", "net", pipeline::ShadingSource::kNet, "regions",
                       pipeline::ShadingSource::kRegions);
#ifdef FACEPROBE_HAS_TRAIN
  if (options.shading_weights.empty()) return;
  if (out.shading != pipeline::ShadingSource::kNet) {
    throw Error(ExitCode::kUsage, "--shading-weights names the network that splits the diffuse layer, --shading " +
                                      options.shading + " splits it without one; leave one of them out.");
  }
  out.shading = pipeline::ShadingSource::kGiven;
  out.shading_split = split_by_weights(options.shading_weights, options.deterministic ? 1 : options.threads);
#endif
}

}  // namespace

void add_inputs(CLI::App& command, SharedOptions& options) {
  command.add_option("PHOTO", options.inputs, "photos, as JPEG, PNG, TIFF, WebP, HEIC, EXR or HDR")
      ->type_name("FILE")
      ->required();
  command.add_option("--max-pixels", options.limits.max_pixels, "largest photo accepted, in pixels")
      ->capture_default_str();
  command.add_option("--max-bytes", options.limits.max_file_bytes, "largest file accepted, in bytes")
      ->capture_default_str();
  command.add_option("--threads", options.threads, "threads; 0 = all processors")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024));
}

void add_face_options(CLI::App& command, SharedOptions& options) {
  command
      .add_option("--separator", options.separator, "highlight separator: net (trained), or tan, yang, shen (classical)")
      ->type_name("{net,tan,yang,shen}")
      ->capture_default_str();
  command.add_option("--weights", options.weights, "weights of the network; default: those that come with the program")
      ->type_name("FILE");
  command
      .add_option("--landmarks", options.landmarks,
                  "5 points of the face (eyes left to right, nose tip, mouth corners) or 68, in pixels; default: they "
                  "are found")
      ->type_name("X1,Y1,...");
  command.add_option("--focal-px", options.focal_px, "focal length in pixels; default: from EXIF, else a 50 mm lens");
  command.add_flag("--deterministic", options.deterministic, "bitwise the same result for any number of threads");
  command
      .add_option("--device", options.device, "what computes; cuda and cuda:N are refused, as this version has neither")
      ->type_name("{auto,cpu}")
      ->capture_default_str();
}

void add_solver_options(CLI::App& command, SharedOptions& options) {
  command.add_option("--solver", options.solver, "what finds the light: transport, or paper (the published scheme)")
      ->type_name("{transport,paper}")
      ->capture_default_str();
  command
      .add_option("--geometry", options.geometry,
                  "where normals come from: net (trained), mesh, or 3dmm (the head model of --head, fitted)")
      ->type_name("{net,mesh,3dmm}")
      ->capture_default_str();
  command
      .add_option("--head", options.head,
                  "head model for --geometry 3dmm: an ICT-FaceKit folder, a Basel file, or an OBJ with 68 landmarks; "
                  "default: none")
      ->type_name("PATH");
  command
      .add_option("--shading", options.shading,
                  "what splits the diffuse layer: net (trained), or regions (one albedo a region)")
      ->type_name("{net,regions}")
      ->capture_default_str();
#ifdef FACEPROBE_HAS_TRAIN
  command
      .add_option("--shading-weights", options.shading_weights,
                  "weights of the paper's Albedo-Shading network, which then splits the diffuse layer in the place of "
                  "--shading and says what colour --solver paper gives to highlights; default: none")
      ->type_name("FILE");
#endif
  command
      .add_option(
          "--prior", options.prior,
          "what light the transport solver starts from: net (trained), or smooth (one lamp and an even surround)")
      ->type_name("{net,smooth}")
      ->capture_default_str();
  command
      .add_option("--compact-light", options.compact_light,
                  "whether the transport solver tries the dominant light as a small disc, such as the sun's, and keeps "
                  "it where that explains the pixels far better: on or off")
      ->type_name("{on,off}")
      ->capture_default_str();
  const lighting::SolveOptions usual;
  command.add_option("--iterations", options.iterations,
                     fmt::format("Richardson-Lucy iterations, 1 to 10000; default: {} from the light that --prior net "
                                 "expects, else {}",
                                 usual.iterations_from_expected, usual.iterations));
  command.add_option("--size", options.size, "size of the environment map in pixels, twice as wide as high")
      ->type_name("WIDTH[xHEIGHT]")
      ->capture_default_str();
  command.add_option("--layer-px", options.layer_px, "long side of the layer pictures, in pixels")->capture_default_str();
}

Eigen::MatrixX2f parse_landmarks(const std::string& text) {
  std::vector<float> values;
  std::stringstream words(text);
  std::string word;
  while (std::getline(words, word, ',')) {
    try {
      std::size_t used = 0;
      values.push_back(std::stof(word, &used));
      if (used != word.size() || !std::isfinite(values.back())) throw std::invalid_argument(word);
    } catch (const std::exception&) {
      throw Error(ExitCode::kUsage, "--landmarks takes numbers separated by commas, found '" + word + "'.");
    }
  }
  if (values.size() != 10 && values.size() != 136) {
    throw Error(ExitCode::kUsage, "--landmarks takes 5 or 68 points, that is 10 or 136 numbers; found " +
                                      std::to_string(values.size()) + ".");
  }
  Eigen::MatrixX2f points(static_cast<Eigen::Index>(values.size() / 2), 2);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    points(i, 0) = values[static_cast<std::size_t>(2 * i)];
    points(i, 1) = values[static_cast<std::size_t>(2 * i + 1)];
  }
  return points;
}

int parse_map_width(const std::string& text) {
  const std::size_t cross = text.find('x');
  const int width = whole_number(text.substr(0, cross), "--size");
  if (cross != std::string::npos && 2LL * whole_number(text.substr(cross + 1), "--size") != width) {
    throw Error(ExitCode::kUsage, "--size " + text + ": an environment map is twice as wide as high.");
  }
  return width;
}

pipeline::EstimateOptions estimate_options(const SharedOptions& options) {
  if (options.device == "cuda" || options.device.rfind("cuda:", 0) == 0) {
    throw Error(ExitCode::kDevice,
                "--device " + options.device +
                    " is not there: this version computes on the processor only. Use --device auto or cpu.");
  }
  if (options.device != "auto" && options.device != "cpu") {
    throw Error(ExitCode::kUsage, "--device takes auto, cpu or cuda[:N], found '" + options.device + "'.");
  }
  if (!options.landmarks.empty() && options.inputs.size() > 1) {
    throw Error(ExitCode::kUsage, "--landmarks describes one face of one photo, but there are " +
                                      std::to_string(options.inputs.size()) + " photos.");
  }
  if (const std::string fault = options.limits.validate(); !fault.empty()) throw Error(ExitCode::kUsage, fault);
  pipeline::EstimateOptions out;
  if (options.separator == "net") {
    out.classical.reset();
    out.weights = options.weights;
  } else {
    out.classical = highlight::separator_from_name(options.separator);
    if (!options.weights.empty())
      throw Error(ExitCode::kUsage, "--weights are the network's; --separator " + options.separator + " takes none.");
  }
  choose_geometry(options, out);
  choose_shading(options, out);
  out.prior =
      one_of(options.prior, "--prior", "net", pipeline::PriorSource::kNet, "smooth", pipeline::PriorSource::kSmooth);
  out.solve.solver = lighting::solver_from_name(options.solver);
  out.solve.compact_light = one_of(options.compact_light, "--compact-light", "on", true, "off", false);
  if (options.iterations) out.solve.iterations = out.solve.iterations_from_expected = *options.iterations;
  out.map_width = parse_map_width(options.size);
  out.layer_px = options.layer_px;
  out.threads = options.threads;
  out.deterministic = options.deterministic;
  out.focal_px = options.focal_px;
  if (!options.landmarks.empty()) out.landmarks_px = parse_landmarks(options.landmarks);
  if (const std::string fault = out.validate(); !fault.empty()) throw Error(ExitCode::kUsage, fault);
  return out;
}

bool is_picture_output(const std::string& output) {
  const std::string extension = CLI::detail::to_lower(std::filesystem::path(output).extension().string());
  for (const char* other : {".jpg", ".jpeg", ".tif", ".tiff", ".webp", ".heic", ".bmp", ".gif"}) {
    if (extension == other)
      throw Error(ExitCode::kUsage, "Pictures are written as .png, .exr or .hdr, found -o " + output +
                                        "; name one of these, or a folder.");
  }
  return io::is_picture_file(output);
}

std::string folder_for(const std::string& output, const SharedOptions& options, std::size_t input) {
  if (options.inputs.size() == 1) return output;
  const auto stem_of = [&](std::size_t i) {
    const std::string stem = std::filesystem::path(options.inputs[i]).stem().string();
    return stem == "." || stem == ".." ? "photo" : stem;  // of "..jpg" and "...jpg", which would lead out of the folder
  };
  // Where another photo has the name, the input's number goes behind it, until no photo has it. "joint" is for the light of all of them.
  const auto taken = [&](const std::string& name) {
    if (name == "joint") return true;
    for (std::size_t other = 0; other < options.inputs.size(); ++other) {
      if (other != input && stem_of(other) == name) return true;
    }
    return false;
  };
  std::string name = stem_of(input);
  while (taken(name)) name += "_" + std::to_string(input + 1);
  return (std::filesystem::path(output) / name).string();
}

}  // namespace faceprobe::cli
