#include "solve/by_numpy.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/data_files.h"
#include "support/shell_word.h"

#include <sys/wait.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>

namespace faceprobe::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kNoNumpy = 3;      // the script's exit code
constexpr int kNoProgram = 127;  // the shell's
constexpr std::int64_t kMostBytes = std::int64_t{1} << 32;

// A folder that is removed with what is in it.
class WorkFolder {
 public:
  WorkFolder() {
    std::string name = (fs::temp_directory_path() / "faceprobe_solve_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw Error(ExitCode::kOutput, "No folder can be made in " + fs::temp_directory_path().string() +
                                         "; name another place with TMPDIR.");
    path_ = name;
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  ~WorkFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  fs::path operator/(const std::string& name) const { return path_ / name; }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

void write_rows(const fs::path& file, const lighting::RowMatrix& rows) {
  const std::span<const float> values(rows.data(), static_cast<std::size_t>(rows.size()));
  io::write_file_atomically(file, std::as_bytes(values));
}

void write_job(const WorkFolder& folder, const Products& products, int runs) {
  nlohmann::json stages = nlohmann::json::array();
  for (const Products::Stage& stage : products.stages()) {
    write_rows(folder / ("seen." + std::to_string(stages.size())), products.observed(stage));
    stages.push_back({{"rows", stage.rows}, {"iterations", stage.iterations}, {"channels", stage.channels}});
  }
  write_rows(folder / "transport", products.transport);
  const nlohmann::json job = {
      {"cells", products.transport.cols()}, {"rows", products.transport.rows()}, {"runs", runs}, {"stages", stages}};
  io::write_file_atomically(folder / "job.json", job.dump());
}

Eigen::MatrixXd read_light(const fs::path& file, Eigen::Index cells, int channels) {
  const std::vector<std::byte> bytes = io::read_file(file, kMostBytes);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> light(cells, channels);
  if (bytes.size() != static_cast<std::size_t>(light.size()) * sizeof(double))
    throw Error(ExitCode::kUnexpected, file.string() + " is not as long as the light that NumPy was to find.");
  std::memcpy(light.data(), bytes.data(), bytes.size());
  return light;
}

}  // namespace

std::optional<NumpyRuns> by_numpy(const Products& products, const std::string& python, int threads, int runs) {
  const WorkFolder folder;
  write_job(folder, products, runs);
  const std::string number = std::to_string(threads);
  const std::string command = "OPENBLAS_NUM_THREADS=" + number + " OMP_NUM_THREADS=" + number +
                              " MKL_NUM_THREADS=" + number + " " + shell_word(python) + " -B " +
                              shell_word(FACEPROBE_SOLVE_NUMPY) + " " + shell_word(folder.path().string()) + " > " +
                              shell_word((folder / "report.json").string());
  const int status = std::system(command.c_str());
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (code == kNoNumpy || code == kNoProgram) return std::nullopt;
  if (code != 0)
    throw Error(ExitCode::kUnexpected, "solve_numpy.py ended with " + std::to_string(code) + "; what it said is above.");

  const nlohmann::json report = nlohmann::json::parse(io::read_text(folder / "report.json", kMostBytes));
  NumpyRuns out;
  out.version = report.at("version");
  for (const std::string library : report.at("libraries"))
    out.libraries += (out.libraries.empty() ? "" : ", ") + library;
  const std::vector<Products::Stage> stages = products.stages();
  for (const char* kind : {"float32", "float64"}) {
    NumpyRuns::Kind found{.name = kind, .seconds = report.at("seconds").at(kind), .result = {}};
    found.result.seconds = found.seconds.back();
    for (std::size_t s = 0; s < stages.size(); ++s) {
      const fs::path file = folder / ("light." + found.name + "." + std::to_string(s));
      found.result.light.push_back(read_light(file, products.transport.cols(), stages[s].channels));
    }
    out.kinds.push_back(std::move(found));
  }
  return out;
}

}  // namespace faceprobe::bench
