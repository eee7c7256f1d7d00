#include "train/finetune_score.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "train/sheet.h"

#include <algorithm>
#include <array>
#include <functional>

namespace faceprobe::train {
namespace {

constexpr int kScoreRounds = 3;  // groups of photos of a person who is measured
constexpr int kSheetRows = 8;

Image difference(const Image& photo, const Image& layer) {
  Image rest(photo.width(), photo.height(), photo.channels());
  std::ranges::transform(photo.values(), layer.values(), rest.values().begin(), std::minus<>());
  return rest;
}

void divide(FinetuneScore& score, int count) {
  score.residual /= count;
  score.untouched /= count;
  score.energy /= count;
}

}  // namespace

FinetuneScorer::FinetuneScorer(const FinetuneConfig& config, const std::vector<const PersonSet*>& people,
                               const synth::ShardReader* faces, const TrainConfig& faces_config)
    : config_(config), people_(people), options_(person_loss_options(config)) {
  if (faces != nullptr) validator_.emplace(*faces, faces_config, torch::Device(torch::kCPU));
}

FinetuneScore FinetuneScorer::measure(const Model& model) const {
  model.module->eval();
  FinetuneScore out;
  for (const PersonSet* person : people_) {
    const std::optional<FinetuneScore> own = measure_person(model, *person);
    if (!own) continue;
    ++out.people;
    out.residual += own->residual;
    out.untouched += own->untouched;
    out.energy += own->energy;
  }
  if (out.people == 0)
    throw Error(ExitCode::kInput, "No held-out person has photos that show the same skin; give more people.");
  divide(out, out.people);
  model.module->train();
  if (validator_) out.synthetic_rmse = validator_->measure(model).skin;
  return out;
}

// Means over groups of photos; nothing where no group shows the same skin.
std::optional<FinetuneScore> FinetuneScorer::measure_person(const Model& model, const PersonSet& person) const {
  FinetuneScore sum;
  int groups = 0;
  for (int round = 0; round < kScoreRounds; ++round) {
    const std::vector<int> chosen =
        drawn_photos(person, config_.photos, Random({config_.seed, 0x5C03, static_cast<std::uint64_t>(round)}));
    const std::optional<PersonPhotos> group = group_of(person, chosen, options_);
    if (!group) continue;
    const std::vector<Image> layers = layers_of(model, person, chosen);
    std::vector<Image> none;
    for (const Image& layer : layers) none.emplace_back(layer.width(), layer.height(), 3);
    const PersonLoss loss = group->loss(layers);
    sum.residual += loss.residual;
    sum.energy += loss.energy;
    sum.untouched += group->loss(none).residual;
    ++groups;
  }
  if (groups == 0) return std::nullopt;
  divide(sum, groups);
  return sum;
}

ByteImage FinetuneScorer::people_picture(const Model& before, const Model& after) const {
  before.module->eval();
  after.module->eval();
  const auto total = static_cast<int>(people_.size());
  const int rows = std::min(kSheetRows, total);
  std::vector<std::array<ByteImage, 4>> cells;
  int width = 0;
  int height = 0;
  for (int r = 0; r < rows; ++r) {
    const PersonSet& person = *people_[static_cast<std::size_t>(r * total / rows)];
    const Image& photo = person.photos.front()->linear;
    const Image old = layers_of(before, person, {0}).front();
    const Image found = layers_of(after, person, {0}).front();
    cells.push_back(
        {encode_srgb(photo), encode_srgb(old, 2), encode_srgb(found, 2), encode_srgb(difference(photo, found))});
    width = std::max(width, photo.width());
    height = std::max(height, photo.height());
  }
  after.module->train();
  ByteImage sheet(4 * width, rows * height, 3);
  for (std::size_t r = 0; r < cells.size(); ++r) {
    for (std::size_t column = 0; column < cells[r].size(); ++column)
      paste(cells[r][column], static_cast<int>(column) * width, static_cast<int>(r) * height, sheet);
  }
  return sheet;
}

ByteImage FinetuneScorer::faces_picture(const Model& model) const {
  return validator_ ? validator_->picture(model, kSheetRows) : ByteImage();
}

}  // namespace faceprobe::train
