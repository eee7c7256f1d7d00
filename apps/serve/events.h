#pragma once
// A job's changes as server-sent events, https://html.spec.whatwg.org/multipage/server-sent-events.html

#include "serve/job.h"

#include <httplib.h>

#include <atomic>
#include <memory>

namespace faceprobe::serve {

// `record` is held as long as somebody listens; `job` is a part of it.
void stream_events(httplib::Response& response, std::shared_ptr<const void> record, const Job& job,
                   const std::atomic<bool>& closing);

}  // namespace faceprobe::serve
