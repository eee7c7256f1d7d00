#include "serve/server.h"

#include "faceprobe/core/error.h"
#include "serve/api.h"
#include "serve/guard.h"

#include <sys/socket.h>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>
#include <utility>

namespace faceprobe::serve {
namespace {

constexpr int kThreads = 24;
constexpr int kMostListeners = kThreads / 2;  // each holds a thread; the others are for the page and the API
constexpr const char* kHost = "127.0.0.1";
constexpr std::size_t kLongestPath = 1000;  // patterns are matched by recursion, some hundred bytes of stack a character
constexpr const char* kNoPage =
    "<!doctype html><html lang=\"en\"><title>Faceprobe</title><p>The page was not built; the API is at "
    "<a href=\"/api/v1/info\">/api/v1</a>.</p></html>";

void refuse(httplib::Response& response, FailureKind kind, std::string sentence) {
  answer(response, Failure{kind, std::move(sentence)});
}

// What the HTTP library refuses by itself has a status and no words.
void explain(const httplib::Request& request, httplib::Response& response, std::int64_t most_bytes) {
  if (!response.body.empty()) return;
  if (response.status == 413) {
    answer(response, too_large(most_bytes).failure());
  } else if (response.status == 404) {
    refuse(response, FailureKind::kNotFound, "There is nothing at " + request.path + "; see /openapi.json.");
  } else {
    refuse(response, FailureKind::kUsage, "The request could not be read.");
  }
}

Caller caller_of(const httplib::Request& request) {
  return {.host = request.get_header_value("Host"),
          .origin = request.get_header_value("Origin"),
          .fetch_site = request.get_header_value("Sec-Fetch-Site"),
          .fetch_mode = request.get_header_value("Sec-Fetch-Mode"),
          .fetch_dest = request.get_header_value("Sec-Fetch-Dest"),
          .gets_front_page = request.method == "GET" && request.path == "/"};
}

// Of a request whose end only its sender knows. The HTTP library limits what says its length; chunks and what it would unpack it does not.
bool is_endless(const httplib::Request& request) {
  if (request.has_header("Transfer-Encoding") || request.has_header("Content-Encoding")) return true;
  const bool has_content = request.method == "POST" || request.method == "PUT" || request.method == "PATCH";
  return has_content && !request.has_header("Content-Length");
}

}  // namespace

std::string ServerOptions::validate() const {
  if (port < 0 || port > 65535) return "The port must be from 0 to 65535, found " + std::to_string(port) + ".";
  if (max_upload_bytes < 1) return "An upload must be allowed a byte at least.";
  if (most_listeners < 1 || most_listeners > kMostListeners) {
    return "The listeners of events may be 1 to " + std::to_string(kMostListeners) + " at a time, found " +
           std::to_string(most_listeners) + ".";
  }
  if (longest_stream.count() < 1) return "A stream of events must be allowed a millisecond at least.";
  if (studio.history_limit < 1) return "The history must hold one estimate at least.";
  return studio.estimate.validate();
}

std::string port_fault(int port, int error) {
  const std::string start = "Port " + std::to_string(port);
  const std::string advice = "; name another with --port, or 0 for any.";
  if (error == EADDRINUSE) return start + " is taken, perhaps by another faceprobe" + advice;
  const std::string reason = error == 0 ? "" : " (" + std::generic_category().message(error) + ")";
  return start + " could not be opened" + reason + advice;
}

struct Server::Impl {
  explicit Impl(ServerOptions wanted)
      : options(std::move(wanted)), studio(options.studio),
        events(options.most_listeners, options.longest_stream, closing) {
    // Without this two servers share a port, and each gets a part of the requests.
    http.set_socket_options([](socket_t socket) {
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    http.new_task_queue = [] { return new httplib::ThreadPool(static_cast<std::size_t>(kThreads)); };
    http.set_payload_max_length(static_cast<std::size_t>(options.max_upload_bytes));
    http.set_tcp_nodelay(true);
    // One request a connection: what is left of one that was refused before it was read would be taken for the next, and a stranger's page
    // could write that one as it likes, with our own Host and without its Origin.
    http.set_keep_alive_max_count(1);
    http.set_keep_alive_timeout(1);  // browsers open connections before they need them; the end waits for these
    http.set_default_headers({{"Content-Security-Policy", kContentSecurityPolicy},
                              {"Cross-Origin-Opener-Policy", "same-origin"},
                              {"Cross-Origin-Resource-Policy", "same-origin"},
                              {"Referrer-Policy", "no-referrer"},
                              {"X-Content-Type-Options", "nosniff"}});
    http.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      // Packing what goes to the same machine takes longer than sending it, by brotli seconds, and the HTTP library offers no other way to
      // leave it; the request itself is not const.
      const_cast<httplib::Request&>(request).headers.erase("Accept-Encoding");
      const std::string fault = fault_of_caller(caller_of(request), port);
      if (!fault.empty()) {
        refuse(response, FailureKind::kForbidden, fault);
      } else if (is_endless(request)) {
        refuse(response, FailureKind::kUsage,
               "A request must tell its length; send Content-Length, and neither chunks nor a Content-Encoding.");
      } else if (request.path.size() > kLongestPath) {
        refuse(response, FailureKind::kNotFound, "There is nothing at a path as long as this one.");
      } else {
        return httplib::Server::HandlerResponse::Unhandled;
      }
      return httplib::Server::HandlerResponse::Handled;
    });
    http.set_exception_handler([](const httplib::Request&, httplib::Response& response,
                                  const std::exception_ptr& thrown) { answer(response, failure_from(thrown)); });
    http.set_error_handler([this](const httplib::Request& request, httplib::Response& response) {
      explain(request, response, options.max_upload_bytes);
    });
    add_routes(http, studio, options, events);
    add_page();
    errno = 0;  // the HTTP library only says whether it worked; what the system said is still there
    port =
        options.port == 0 ? http.bind_to_any_port(kHost) : (http.bind_to_port(kHost, options.port) ? options.port : -1);
    if (port <= 0) throw Error(ExitCode::kUsage, port_fault(options.port, errno));
  }

  void add_page() {
    if (options.page.empty()) {
      http.Get("/", [](const httplib::Request&, httplib::Response& response) {
        response.set_content(kNoPage, "text/html; charset=utf-8");
      });
      return;
    }
    // Names of assets have a hash of what is in them.
    http.set_mount_point("/assets", options.page / "assets", {{"Cache-Control", "max-age=31536000, immutable"}});
    http.set_mount_point("/", options.page, {{"Cache-Control", "no-cache"}});
  }

  ServerOptions options;
  std::atomic<bool> closing = false, begun = false, ended = false;
  int port = -1;
  Studio studio;
  EventStreams events;
  httplib::Server http;  // last: it answers from the others
};

Server::Server(ServerOptions options) {
  if (const std::string fault = options.validate(); !fault.empty()) throw Error(ExitCode::kUsage, fault);
  impl_ = std::make_unique<Impl>(std::move(options));
}

Server::~Server() = default;

int Server::port() const { return impl_->port; }

void Server::run() {
  impl_->begun = true;
  const bool fine = impl_->closing || impl_->http.listen_after_bind();
  impl_->ended = true;
  if (!fine) throw Error(ExitCode::kUnexpected, "The server stopped listening by itself.");
}

void Server::stop() {
  impl_->closing = true;
  impl_->studio.records().stop_all();
  // The HTTP library forgets that it was to stop when it has not begun yet.
  while (impl_->begun && !impl_->ended && !impl_->http.is_running())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  impl_->http.stop();
}

}  // namespace faceprobe::serve
