#include "train/batch.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/core/permutation.h"
#include "faceprobe/core/region.h"
#include "train/augment.h"

#include <algorithm>

namespace faceprobe::train {
namespace {

constexpr std::int64_t kLeastAhead = 4;  // batches that lie ready; twice as many as there are workers, if that is more
constexpr int kMostUsualWorkers = 8;     // beside a card: half the processors that there are, and not more

// Where the mesh of faces in photos is too smooth and the highlights lie, errors count most; hair and clothes have no surface to speak of.
Image surface_weight(const ByteImage& region) {
  Image weight(region.width(), region.height(), 1);
  for (std::size_t i = 0; i < region.values().size(); ++i) {
    switch (static_cast<Region>(region.data()[i])) {
      case Region::kNose:
      case Region::kEyelids:
      case Region::kUpperLip:
      case Region::kLips:
      case Region::kJaw: weight.data()[i] = 2; break;
      case Region::kForehead:
      case Region::kCheeks:
      case Region::kChin:
      case Region::kBrows: weight.data()[i] = 1; break;
      case Region::kOther:
      case Region::kEyes: weight.data()[i] = 0.5F; break;
      default: break;
    }
  }
  return weight;
}

// Skin and lips that are lit and not clipped.
ByteImage lit_pixels(const TrainingPicture& picture) {
  constexpr float kDark = 1e-3F;
  ByteImage lit(picture.region.width(), picture.region.height(), 1);
  for (std::size_t i = 0; i < lit.values().size(); ++i) {
    const auto region = static_cast<Region>(picture.region.data()[i]);
    const float* shading = picture.shading.data() + 3 * i;
    const std::uint8_t* clip = picture.clip.data() + 3 * i;
    const bool skin = region >= Region::kForehead && region <= Region::kOther;
    const bool seen = clip[0] + clip[1] + clip[2] == 0;
    lit.data()[i] = skin && seen && std::min({shading[0], shading[1], shading[2]}) > kDark ? 1 : 0;
  }
  return lit;
}

// The pictures of one sample into place `at` of the batch.
void put(const TrainingPicture& picture, std::int64_t at, const Batch& batch) {
  const auto copy = [at](const auto& image, const torch::Tensor& to) {
    // N x H x W x C in memory.
    float* out = to.data_ptr<float>() + at * static_cast<std::int64_t>(image.values().size());
    std::transform(image.values().begin(), image.values().end(), out,
                   [](auto value) { return static_cast<float>(value); });
  };
  copy(picture.linear, batch.linear);
  copy(picture.clip, batch.clip);
  copy(picture.mask, batch.mask);
  copy(picture.highlight, batch.highlight);
  copy(picture.skin, batch.skin);
  if (!picture.has_surface()) return;
  copy(picture.mesh, batch.surface.mesh);
  copy(picture.normal, batch.surface.normal);
  copy(picture.depth_m, batch.surface.depth_m);
  copy(surface_weight(picture.region), batch.surface.weight);
  copy(picture.region, batch.surface.region);
  copy(picture.shading, batch.surface.shading);
  copy(lit_pixels(picture), batch.surface.lit);
  copy(picture.open, batch.surface.open);
}

Batch empty_batch(std::int64_t count, int width, int height, bool surface) {
  // Memory as pictures have it, N x H x W x C; seen as N x C x H x W that is libtorch's channels-last format.
  const auto pictures = [&](int channels) {
    return torch::zeros({count, height, width, channels}, torch::kFloat).permute({0, 3, 1, 2});
  };
  Batch batch{pictures(3), pictures(3), pictures(1), pictures(3), pictures(1), {}};
  if (surface)
    batch.surface = {pictures(3), pictures(3), pictures(1), pictures(1),
                     pictures(1), pictures(3), pictures(1), pictures(3)};
  return batch;
}

template <class Make>
Batch make_batch(std::size_t count, const Make& make) {
  Batch batch;
  for (std::size_t i = 0; i < count; ++i) {
    const TrainingPicture picture = make(i);
    if (i == 0) {
      batch = empty_batch(static_cast<std::int64_t>(count), picture.linear.width(), picture.linear.height(),
                          picture.has_surface());
    }
    put(picture, static_cast<std::int64_t>(i), batch);
  }
  return batch;
}

bool has_shading(const synth::ShardReader& reader) {
  for (int i = 0; i < reader.sample_count(); ++i) {
    if (!reader.place(i).first->has("sample.shading")) return false;
  }
  return true;
}

Batch training_batch(const synth::ShardReader& reader, const TrainConfig& config, std::int64_t step) {
  const std::vector<int> samples = samples_of_step(config.seed, step, config.batch, reader.sample_count());
  return make_batch(samples.size(), [&](std::size_t i) {
    Random random({config.seed, 0xA06, static_cast<std::uint64_t>(step), i});
    return draw_picture(reader, samples[i], config, random);
  });
}

}  // namespace

void require_meshes(const synth::ShardReader& reader, const std::filesystem::path& folder, const TrainConfig& config) {
  if ((config.architecture == "shi" || config.architecture == "albedo_shading") && !has_shading(reader)) {
    throw Error(ExitCode::kInput, "The network \"" + config.architecture +
                                      "\" learns from the shading, which the data in " + folder.string() +
                                      " do not have. Make them again with `faceprobe synth`.");
  }
  if (config.architecture != "face" || reader.has_meshes()) return;
  throw Error(ExitCode::kInput, "The face network is given the mesh that is found in a photo, which the data in " +
                                    folder.string() + " do not have. Run `faceprobe mesh " + folder.string() +
                                    "` first.");
}

Batch plain_batch(const synth::ShardReader& reader, const std::vector<int>& samples, const TrainConfig& config) {
  return make_batch(samples.size(), [&](std::size_t i) { return plain_picture(reader, samples[i], config); });
}

std::vector<int> samples_of_step(std::uint64_t seed, std::int64_t step, int batch, int sample_count) {
  std::vector<int> samples;
  std::vector<int> order;
  std::int64_t round_made = -1;
  for (std::int64_t k = step * batch; k < (step + 1) * batch; ++k) {
    const std::int64_t round = k / sample_count;
    if (round != round_made) {
      order = permutation(sample_count, Random({seed, 0x08D38, static_cast<std::uint64_t>(round)}));
      round_made = round;
    }
    samples.push_back(order[static_cast<std::size_t>(k % sample_count)]);
  }
  return samples;
}

int usual_workers(bool on_card) { return on_card ? std::clamp(default_thread_count() / 2, 1, kMostUsualWorkers) : 1; }

BatchSource::BatchSource(const synth::ShardReader& reader, const TrainConfig& config, std::int64_t first_step,
                         bool repeat, int workers)
    : reader_(reader), config_(config), repeat_(repeat),
      ahead_(std::max<std::int64_t>(kLeastAhead, 2 * static_cast<std::int64_t>(workers))), wanted_(first_step),
      started_(first_step) {
  const int started = repeat ? 1 : std::max(1, workers);
  for (int i = 0; i < started; ++i) workers_.emplace_back([this] { work(); });
}

BatchSource::~BatchSource() {
  const std::scoped_lock lock(mutex_);
  stop_ = true;
  changed_.notify_all();
}

void BatchSource::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stop_ || failure_ || started_ < wanted_ + ahead_; });
    if (stop_ || failure_) return;
    const std::int64_t step = started_++;
    lock.unlock();
    Batch batch;
    std::exception_ptr failure;
    try {
      batch = training_batch(reader_, config_, step);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    if (failure) failure_ = failure;
    ready_[step] = std::move(batch);
    changed_.notify_all();
    if (repeat_) return;
  }
}

Batch BatchSource::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return failure_ || ready_.contains(wanted_); });
  if (failure_) std::rethrow_exception(failure_);
  if (repeat_) return ready_[wanted_];
  Batch batch = std::move(ready_[wanted_]);
  ready_.erase(wanted_++);
  changed_.notify_all();
  return batch;
}

}  // namespace faceprobe::train
