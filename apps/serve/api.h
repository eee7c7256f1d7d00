#pragma once
// The routes of openapi.json, tied to a studio.

#include "serve/events.h"
#include "serve/server.h"

#include <httplib.h>

namespace faceprobe::serve {

// All that is given must outlive the server.
void add_routes(httplib::Server& http, Studio& studio, const ServerOptions& options, EventStreams& events);

void answer(httplib::Response& response, const Json& json, int status = 200);
void answer(httplib::Response& response, const Failure& failure);
Refusal too_large(std::int64_t most_bytes);  // of a photo

}  // namespace faceprobe::serve
