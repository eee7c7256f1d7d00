#include "serve/studio.h"

#include "faceprobe/assets/named_model.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/resample.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/pipeline/insertion_files.h"
#include "faceprobe/pipeline/outputs.h"
#include "faceprobe/pipeline/room.h"
#include "serve/describe.h"
#include "serve/estimate_progress.h"
#include "serve/last_photo.h"

#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace faceprobe::serve {
namespace {

constexpr int kShownPx = 2048;  // longer side of the photo on the page
constexpr int kPreviewPx = 640;
constexpr int kPreviewSamples = 16;

// Runs a task whose failure is the job's. One that nobody wants any more is not begun, and of one that was left midway nothing is shown.
template <class Task>
void run_job(Job& job, const Task& task) {
  try {
    refuse_stopped(job);
    task();
    refuse_stopped(job);
    job.succeed();
  } catch (...) {
    job.fail(failure_from(std::current_exception()));
  }
}

ByteImage shown(const Image& linear) {
  const Window window = shrunk(linear.width(), linear.height(), kShownPx);
  return encode_srgb(window.scale == 1 ? linear : resampled(linear, window, Outside::kEdge));
}

}  // namespace

struct Studio::Bench {
  explicit Bench(const StudioOptions& options) : estimator(options.estimate), photos(options.limits) {}

  void estimate(const std::shared_ptr<EstimateRecord>& record) {
    try {
      make_estimate(record);
    } catch (...) {
      photos.forget();  // nothing will be drawn into it
      throw;
    }
  }

  void make_estimate(const std::shared_ptr<EstimateRecord>& shared) {
    EstimateRecord& record = *shared;
    record.job.progress("Reading the photo", 0);
    const std::shared_ptr<const io::Photo> photo = photos.of(shared);
    refuse_stopped(record.job);
    record.job.progress("Looking for faces", 0.2);
    io::write_picture(record.shown_photo(), shown(photo->linear));
    EstimateProgress progress(record.job);
    record.estimate = estimator.estimate(*photo, [&](std::string_view stage) { progress.ended(stage); });
    pipeline::write_outputs(record.output(), record.estimate, *photo, estimator.options(), record.name);
    refuse_stopped(record.job);
    std::optional<pipeline::Room> room;
    if (record.estimate.faces.size() > 1) {
      room = pipeline::find_lamps(record.estimate);
      pipeline::write_room(record.output(), *room, record.estimate, record.name);
    }
    record.files = files_of(record.output());
    record.described = describe(record, *photo, estimator.options(), room ? &*room : nullptr);
    forget_layers(record.estimate);
  }

  void insert(InsertionRecord& record, const InsertionRequest& request) {
    record.job.progress("Preparing", 0);
    const std::shared_ptr<const io::Photo> photo = photos.of(record.estimate);
    Image linear = photo->linear;
    insert::Scene scene = pipeline::scene_for(
        *photo, record.estimate->estimate, assets::model_named(request.object, request.material, request.surface).model,
        request.where);
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
  LastPhoto photos;
};

Studio::Studio(StudioOptions options)
    : options_(std::move(options)), records_(options_.history_limit), bench_(std::make_unique<Bench>(options_)),
      worker_(
          options_.most_waiting, [this] { bench_->photos.forget(); }, options_.photo_kept) {}

Studio::~Studio() { records_.stop_all(); }

bool Studio::keeps_photo() const { return bench_->photos.kept(); }

std::shared_ptr<EstimateRecord> Studio::add_photo(const std::string& name,
                                                  const std::function<void(const std::filesystem::path&)>& fill) {
  auto record = std::make_shared<EstimateRecord>(new_id(), name, options_.folder, options_.keep);
  try {
    fill(record->photo_file());
    records_.add(record);
    const bool taken = worker_.submit([this, record] { run_job(record->job, [&] { bench_->estimate(record); }); });
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
  if (!request.surface.empty())
    assets::model_named(request.object, request.material, request.surface);  // or a sentence
  auto record = std::make_shared<InsertionRecord>(new_id(), of);
  records_.add(record);
  const bool taken =
      worker_.submit([this, record, request] { run_job(record->job, [&] { bench_->insert(*record, request); }); });
  if (taken) return record;
  records_.remove_insertion(record->id);
  throw Refusal(FailureKind::kBusy, "Too many drawings are waiting; try again when some are done.");
}

}  // namespace faceprobe::serve
