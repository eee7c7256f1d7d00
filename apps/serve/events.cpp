#include "serve/events.h"

#include <string>
#include <utility>

namespace faceprobe::serve {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kPatience{250};  // how soon a closing server, or a time left that has changed, is noticed
constexpr milliseconds kSpacing{50};    // renderers tell of their progress more often than eyes can see

bool write(httplib::DataSink& sink, const std::string& text) { return sink.write(text.data(), text.size()); }

}  // namespace

void stream_events(httplib::Response& response, std::shared_ptr<const void> record, const Job& job,
                   const std::atomic<bool>& closing) {
  response.set_header("Cache-Control", "no-store");
  const auto next = [record = std::move(record), &job, &closing, seen = 0](std::size_t, httplib::DataSink& sink) mutable {
    if (closing) {
      sink.done();
      return true;
    }
    if (seen != 0) std::this_thread::sleep_for(kSpacing);
    const int before = seen;
    const JobState state = job.wait(seen, kPatience);
    // A comment finds out whether anybody listens still.
    if (seen == before && state.phase != JobPhase::kRunning) return write(sink, ":\n\n");
    const std::string data = job_json(state).dump(-1, ' ', false, Json::error_handler_t::replace);
    if (!write(sink, "event: state\ndata: " + data + "\n\n")) return false;
    if (state.ended()) sink.done();
    return true;
  };
  response.set_chunked_content_provider("text/event-stream", next);
}

}  // namespace faceprobe::serve
