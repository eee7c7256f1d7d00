#include "serve/events.h"

#include <httplib.h>

#include <string>
#include <thread>
#include <utility>

namespace faceprobe::serve {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kPatience{250};  // how soon a closing server, or a time left that has changed, is noticed
constexpr milliseconds kSpacing{50};    // renderers tell of their progress more often than eyes can see
constexpr const char* kAskAgain = "retry: 1000\n";  // milliseconds after the end of a stream

bool write(httplib::DataSink& sink, const std::string& text) { return sink.write(text.data(), text.size()); }

}  // namespace

std::shared_ptr<const void> EventStreams::take_place() {
  if (++open_ > most_) {
    --open_;
    throw Refusal(FailureKind::kBusy, "As many listen to events as this server bears; ask for the job itself instead.");
  }
  return {this, [this](const void*) { --open_; }};
}

void EventStreams::stream(httplib::Response& response, std::shared_ptr<const void> record, const Job& job) {
  const auto next = [this, place = take_place(), record = std::move(record), &job, seen = 0,
                     end = steady_clock::now() + longest_](std::size_t, httplib::DataSink& sink) mutable {
    const bool first = seen == 0;
    if (closing_ || (!first && steady_clock::now() >= end)) {
      sink.done();
      return true;
    }
    if (!first) std::this_thread::sleep_for(kSpacing);
    const int before = seen;
    const JobState state = job.wait(seen, kPatience);
    // A comment finds out whether anybody listens still.
    if (seen == before && state.phase != JobPhase::kRunning) return write(sink, ":\n\n");
    const std::string data = job_json(state).dump(-1, ' ', false, Json::error_handler_t::replace);
    if (!write(sink, (first ? kAskAgain : "") + ("event: state\ndata: " + data + "\n\n"))) return false;
    if (state.ended()) sink.done();
    return true;
  };
  response.set_header("Cache-Control", "no-store");
  response.set_chunked_content_provider("text/event-stream", next);
}

}  // namespace faceprobe::serve
