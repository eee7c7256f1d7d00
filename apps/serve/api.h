#pragma once
// The routes of openapi.json, tied to a studio.

#include "serve/server.h"

#include <httplib.h>

#include <atomic>

namespace faceprobe::serve {

// Event streams end when `closing` is set.
void add_routes(httplib::Server& http, Studio& studio, const ServerOptions& options, const std::atomic<bool>& closing);

void answer(httplib::Response& response, const Json& json, int status = 200);
void answer(httplib::Response& response, const Failure& failure);
Refusal too_large(std::int64_t most_bytes);  // of a photo

}  // namespace faceprobe::serve
