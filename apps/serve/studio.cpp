#include "serve/studio.h"

#include "faceprobe/assets/named_model.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/resample.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/pipeline/insertion_files.h"
#include "faceprobe/pipeline/outputs.h"
#include "faceprobe/pipeline/room.h"
#include "serve/describe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

namespace faceprobe::serve {
namespace {

constexpr int kShownPx = 2048;  // longer side of the photo on the page
constexpr int kPreviewPx = 640;
constexpr int kPreviewSamples = 16;

// What comes after a stage that has ended, for people, and how far that is on the whole way (measured on a 12-megapixel portrait).
struct NextStage {
  std::string_view after, what;
  double share;
};
constexpr std::array kStages = {
    NextStage{"find faces", "Measuring the face", 0.4},
    NextStage{"geometry", "Separating highlights", 0.45},
    NextStage{"highlights and normals", "Separating colour from shading", 0.5},
    NextStage{"albedo and shading", "Solving for the light", 0.55},
    NextStage{"light", "Drawing the map", 0.65},
    NextStage{"maps and main lights", "Writing files", 0.7},
    NextStage{"joint light", "Writing files", 0.7},
};

// Runs a task whose failure is the job's. One that nobody wants any more is not begun, and of one that was left midway nothing is shown.
template <class Task>
void run_job(Job& job, const Task& task) {
  try {
    if (!job.stopped()) task();
    if (job.stopped()) throw Refusal(FailureKind::kNotFound, "It was stopped.");
    job.succeed();
  } catch (...) {
    job.fail(failure_from(std::current_exception()));
  }
}

// Of a file whose name is ours: the person at the page knows the photo by another, and our folders are nobody's business.
io::Photo loaded(const EstimateRecord& record, const io::Limits& limits) {
  const std::string file = record.photo_file().string();
  try {
    return io::load_photo(file, limits);
  } catch (const Error& error) {
    std::string sentence = error.what();
    if (const std::size_t at = sentence.find(file); at != std::string::npos)
      sentence.replace(at, file.size(), "'" + record.name + "'");
    throw Error(error.code(), sentence);
  }
}

ByteImage shown(const Image& linear) {
  const Window window = shrunk(linear.width(), linear.height(), kShownPx);
  return encode_srgb(window.scale == 1 ? linear : resampled(linear, window, Outside::kEdge));
}

}  // namespace

struct Studio::Bench {
  explicit Bench(const pipeline::EstimateOptions& options) : estimator(options) {}

  // The photo of a record, which is the last one's more often than not.
  const io::Photo& photo_of(const EstimateRecord& record, const io::Limits& limits) {
    if (!photo || photo_id != record.id) {
      photo.reset();
      photo = loaded(record, limits);
      photo_id = record.id;
    }
    return *photo;
  }

  void estimate(EstimateRecord& record, const io::Limits& limits) {
    record.job.progress("Reading the photo", 0);
    const io::Photo& input = photo_of(record, limits);
    record.job.progress("Looking for faces", 0.2);
    io::write_picture(record.shown_photo(), shown(input.linear));
    record.estimate = estimator.estimate(input, [&](std::string_view ended) {
      const auto* next = std::ranges::find(kStages, ended, &NextStage::after);
      if (next != kStages.end()) record.job.progress(std::string(next->what), next->share);
    });
    pipeline::write_outputs(record.output(), record.estimate, input, estimator.options(), record.name);
    std::optional<pipeline::Room> room;
    if (record.estimate.faces.size() > 1) {
      room = pipeline::find_lamps(record.estimate);
      pipeline::write_room(record.output(), *room, record.estimate, record.name);
    }
    record.files = files_of(record.output());
    record.described = describe(record, input, estimator.options(), room ? &*room : nullptr);
  }

  void insert(InsertionRecord& record, const InsertionRequest& request, const io::Limits& limits) {
    record.job.progress("Preparing", 0);
    Image linear = photo_of(*record.estimate, limits).linear;
    insert::Scene scene = pipeline::scene_for(
        *photo, record.estimate->estimate, assets::model_named(request.object, request.material).model, request.where);
    insert::Options how;
    how.render.threads = estimator.options().threads;
    how.render.progress = [&](float share) {
      record.job.progress("Drawing", static_cast<double>(share));
      return !record.job.stopped();
    };
    if (request.preview) {
      how.render.samples = kPreviewSamples;
      insert::shrink(linear, scene, kPreviewPx);
    }
    const insert::Insertion done = insert::insert_model(linear, scene, how);
    if (done.stopped) return;
    pipeline::write_insertion(record.home.path(), done, scene, record.estimate->name, request.object);
    record.files = files_of(record.home.path());
  }

  pipeline::Estimator estimator;
  std::optional<io::Photo> photo;
  std::string photo_id;
};

Studio::Studio(StudioOptions options)
    : options_(std::move(options)), records_(options_.history_limit),
      bench_(std::make_unique<Bench>(options_.estimate)), worker_(options_.most_waiting) {}

Studio::~Studio() { records_.stop_all(); }

std::shared_ptr<EstimateRecord> Studio::add_photo(const std::string& name,
                                                  const std::function<void(const std::filesystem::path&)>& fill) {
  auto record = std::make_shared<EstimateRecord>(new_id(), name, options_.folder, options_.keep);
  try {
    fill(record->photo_file());
    records_.add(record);
    const bool taken =
        worker_.submit([this, record] { run_job(record->job, [&] { bench_->estimate(*record, options_.limits); }); });
    if (taken) return record;
    records_.remove_estimate(record->id);
    throw Refusal(FailureKind::kBusy, "Too many photos are waiting; try again when some are done.");
  } catch (...) {
    // Not even where results are kept.
    std::error_code ignored;
    std::filesystem::remove_all(record->home.path(), ignored);
    throw;
  }
}

std::shared_ptr<InsertionRecord> Studio::add_insertion(const std::string& estimate, const InsertionRequest& request) {
  const std::shared_ptr<EstimateRecord> of = records_.estimate(estimate);
  const JobPhase phase = of->job.state().phase;
  if (phase == JobPhase::kFailed)
    throw Refusal(FailureKind::kNotReady, "The light of this photo could not be found; send another photo.");
  if (phase != JobPhase::kDone)
    throw Refusal(FailureKind::kNotReady, "The light of this photo is not known yet; wait until its estimate is done.");
  if (const std::string fault = request.where.validate(); !fault.empty()) throw Error(ExitCode::kUsage, fault);
  auto record = std::make_shared<InsertionRecord>(new_id(), of);
  records_.add(record);
  const bool taken = worker_.submit(
      [this, record, request] { run_job(record->job, [&] { bench_->insert(*record, request, options_.limits); }); });
  if (taken) return record;
  records_.remove_insertion(record->id);
  throw Refusal(FailureKind::kBusy, "Too many drawings are waiting; try again when some are done.");
}

}  // namespace faceprobe::serve
