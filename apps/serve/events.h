#pragma once
// A job's changes as server-sent events, https://html.spec.whatwg.org/multipage/server-sent-events.html
//
//   EventStreams events(12, std::chrono::seconds(30), closing);
//   events.stream(response, record, record->job);  // throws Refusal(kBusy)
//
// A stream holds one of the server's threads as long as it is open. So there are only so many at a time, and each ends after a while: the end of
// a stream makes browsers ask again, and every stream begins with the present state, so that nothing is missed and none needs a number.

#include "serve/job.h"

#include <atomic>
#include <chrono>
#include <memory>

namespace httplib {
struct Response;
}

namespace faceprobe::serve {

class EventStreams {
 public:
  // Streams end when `closing` is set, when their job ends, and after `longest`.
  EventStreams(int most, std::chrono::milliseconds longest, const std::atomic<bool>& closing)
      : most_(most), longest_(longest), closing_(closing) {}

  // `record` is held as long as somebody listens; `job` is a part of it. Throws Refusal(kBusy) when too many listen already. Must outlive the
  // responses.
  void stream(httplib::Response& response, std::shared_ptr<const void> record, const Job& job);

 private:
  // One listener's, from its request until its response is gone.
  std::shared_ptr<const void> take_place();

  int most_;
  std::chrono::milliseconds longest_;
  const std::atomic<bool>& closing_;
  std::atomic<int> open_ = 0;
};

}  // namespace faceprobe::serve
