#include "train/checkpoint.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/atomic_file.h"

namespace faceprobe::train {
namespace {

constexpr std::int64_t kRowNumbers = 13;

torch::Tensor packed(const std::vector<TrainRow>& rows) {
  torch::Tensor table = torch::zeros({static_cast<std::int64_t>(rows.size()), kRowNumbers}, torch::kDouble);
  auto to = table.accessor<double, 2>();
  for (std::int64_t i = 0; i < table.size(0); ++i) {
    const TrainRow& row = rows[static_cast<std::size_t>(i)];
    const double numbers[kRowNumbers] = {static_cast<double>(row.step),
                                         row.loss,
                                         row.learning_rate,
                                         row.samples_per_second,
                                         row.validated ? 1.0 : 0.0,
                                         row.validation.skin,
                                         row.validation.whole,
                                         row.validation.black_skin,
                                         row.validation.black_whole,
                                         row.validation.normal_deg,
                                         row.validation.region_share,
                                         row.validation.shading,
                                         row.validation.colour_deg};
    for (std::int64_t k = 0; k < kRowNumbers; ++k) to[i][k] = numbers[k];
  }
  return table;
}

std::vector<TrainRow> unpacked(const torch::Tensor& table) {
  std::vector<TrainRow> rows;
  const auto from = table.accessor<double, 2>();
  for (std::int64_t i = 0; i < table.size(0); ++i) {
    TrainRow row;
    row.step = static_cast<std::int64_t>(from[i][0]);
    row.loss = from[i][1];
    row.learning_rate = from[i][2];
    row.samples_per_second = from[i][3];
    row.validated = from[i][4] != 0;
    row.validation = {from[i][5], from[i][6],  from[i][7],  from[i][8],
                      from[i][9], from[i][10], from[i][11], from[i][12]};
    rows.push_back(row);
  }
  return rows;
}

torch::Tensor bytes_of(const std::string& text) {
  torch::Tensor bytes = torch::zeros({static_cast<std::int64_t>(text.size())}, torch::kByte);
  std::copy(text.begin(), text.end(), bytes.data_ptr<std::uint8_t>());
  return bytes;
}

std::string text_of(const torch::Tensor& bytes) {
  const std::uint8_t* begin = bytes.data_ptr<std::uint8_t>();
  return {begin, begin + bytes.numel()};
}

std::vector<torch::Tensor> averaged_of(const torch::nn::Module& module, Averaged which) {
  std::vector<torch::Tensor> numbers = module.parameters();
  if (which == Averaged::kParameters) return numbers;
  for (const torch::Tensor& buffer : module.buffers()) {
    if (buffer.is_floating_point()) numbers.push_back(buffer);
  }
  return numbers;
}

}  // namespace

WeightAverage::WeightAverage(const torch::nn::Module& module, double decay, Averaged which)
    : decay_(decay), which_(which) {
  for (const torch::Tensor& number : averaged_of(module, which)) values_.push_back(number.detach().clone());
}

void WeightAverage::add(const torch::nn::Module& module, std::int64_t step) {
  const torch::NoGradGuard no_grad;
  const double decay = std::min(decay_, (1.0 + static_cast<double>(step)) / (10.0 + static_cast<double>(step)));
  const std::vector<torch::Tensor> parameters = averaged_of(module, which_);
  for (std::size_t i = 0; i < values_.size(); ++i) values_[i].lerp_(parameters[i].detach(), 1.0 - decay);
}

void WeightAverage::swap(torch::nn::Module& module) {
  const torch::NoGradGuard no_grad;
  std::vector<torch::Tensor> parameters = averaged_of(module, which_);
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const torch::Tensor held = parameters[i].detach().clone();
    parameters[i].copy_(values_[i]);
    values_[i].copy_(held);
  }
}

void save_checkpoint(const std::filesystem::path& path, const Checkpoint& state, torch::nn::Module& module,
                     torch::optim::AdamW& optimizer, WeightAverage& average, const std::string& run_json) {
  torch::serialize::OutputArchive archive;
  torch::serialize::OutputArchive weights;
  torch::serialize::OutputArchive moments;
  module.save(weights);
  optimizer.save(moments);
  archive.write("weights", weights);
  archive.write("optimizer", moments);
  for (std::size_t i = 0; i < average.values().size(); ++i)
    archive.write("average." + std::to_string(i), average.values()[i]);
  archive.write("step", torch::full({1}, state.step, torch::kLong));
  archive.write("rows", packed(state.rows));
  archive.write("run", bytes_of(run_json));
  io::write_file_atomically(path, [&](const std::filesystem::path& temporary) { archive.save_to(temporary.string()); });
}

bool load_checkpoint(const std::filesystem::path& path, Checkpoint& state, torch::nn::Module& module,
                     torch::optim::AdamW& optimizer, WeightAverage& average, const std::string& run_json) {
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
    module.load(weights);
    optimizer.load(moments);
    const torch::NoGradGuard no_grad;
    for (std::size_t i = 0; i < average.values().size(); ++i) {
      average.values()[i].copy_(read("average." + std::to_string(i)));
    }
    state.step = read("step").item<std::int64_t>();
    state.rows = unpacked(read("rows"));
  } catch (const c10::Error&) {
    throw Error(ExitCode::kInput, path.string() + " is damaged; remove it to begin the run anew.");
  }
  return true;
}

}  // namespace faceprobe::train
