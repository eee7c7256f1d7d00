#include "train/checkpoint.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/atomic_file.h"
#include "train/channels_last.h"

namespace faceprobe::train {
namespace {

torch::Tensor bytes_of(const std::string& text) {
  torch::Tensor bytes = torch::zeros({static_cast<std::int64_t>(text.size())}, torch::kByte);
  std::copy(text.begin(), text.end(), bytes.data_ptr<std::uint8_t>());
  return bytes;
}

std::string text_of(const torch::Tensor& bytes) {
  const std::uint8_t* begin = bytes.data_ptr<std::uint8_t>();
  return {begin, begin + bytes.numel()};
}

Error damaged(const std::filesystem::path& path) {
  return {ExitCode::kInput, path.string() + " is damaged; remove it to begin the run anew."};
}

}  // namespace

void save_checkpoint(const std::filesystem::path& path, const Checkpoint& state, Descent& descent,
                     const std::string& run_json) {
  torch::serialize::OutputArchive archive;
  torch::serialize::OutputArchive weights;
  torch::serialize::OutputArchive moments;
  descent.module().save(weights);
  descent.optimizer().save(moments);
  archive.write("weights", weights);
  archive.write("optimizer", moments);
  const std::vector<torch::Tensor>& average = descent.average().values();
  for (std::size_t i = 0; i < average.size(); ++i) archive.write("average." + std::to_string(i), average[i]);
  archive.write("step", torch::full({1}, state.step, torch::kLong));
  for (const auto& [name, table] : state.tables) archive.write(name, table);
  archive.write("run", bytes_of(run_json));
  io::write_file_atomically(path, [&](const std::filesystem::path& temporary) { archive.save_to(temporary.string()); });
}

bool load_checkpoint(const std::filesystem::path& path, Checkpoint& state, Descent& descent,
                     const std::string& run_json) {
  if (!std::filesystem::exists(path)) return false;
  try {
    torch::serialize::InputArchive archive;
    archive.load_from(path.string());
    // A tensor that is read into keeps its type, so each gets one of its own.
    const auto read = [&archive](const std::string& name) {
      torch::Tensor value;
      archive.read(name, value);
      return value;
    };
    if (text_of(read("run")) != run_json) {
      throw Error(ExitCode::kOutput, path.parent_path().string() +
                                         " holds a run of another config or of other data. Choose another folder, or "
                                         "remove this one.");
    }
    torch::serialize::InputArchive weights;
    torch::serialize::InputArchive moments;
    archive.read("weights", weights);
    archive.read("optimizer", moments);
    descent.module().load(weights);
    descent.optimizer().load(moments);
    const torch::NoGradGuard no_grad;
    std::vector<torch::Tensor>& average = descent.average().values();
    for (std::size_t i = 0; i < average.size(); ++i) average[i].copy_(read("average." + std::to_string(i)));
    state.step = read("step").item<std::int64_t>();
    for (auto& [name, table] : state.tables) {
      const torch::Tensor found = read(name);
      if (found.dim() != 2 || found.size(1) != table.size(1)) throw damaged(path);
      table = found;
    }
  } catch (const c10::Error&) {
    throw damaged(path);
  }
  to_channels_last(descent.module());  // a checkpoint from before the weights were so
  return true;
}

}  // namespace faceprobe::train
