#include "serve/events.h"

#include "serve/api.h"
#include "serve/running_server.h"

#include <future>
#include <list>
#include <string>
#include <thread>

namespace faceprobe::serve::testing {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;
using EventsOverHttp = ServerTest;

// A server of one job's events and nothing else.
class EventServer {
 public:
  EventServer(int most, milliseconds longest) : streams_(most, longest, closing_) {
    http_.Get("/events",
              [this](const httplib::Request&, httplib::Response& response) { streams_.stream(response, nullptr, job); });
    http_.set_exception_handler([](const httplib::Request&, httplib::Response& response,
                                   const std::exception_ptr& thrown) { answer(response, failure_from(thrown)); });
    port_ = http_.bind_to_any_port("127.0.0.1");
    thread_ = std::thread([this] { http_.listen_after_bind(); });
    while (!http_.is_running()) std::this_thread::yield();
  }
  ~EventServer() {
    closing_ = true;
    http_.stop();
    thread_.join();
  }
  EventServer(const EventServer&) = delete;
  EventServer& operator=(const EventServer&) = delete;

  httplib::Client client() const {
    httplib::Client client("127.0.0.1", port_);
    client.set_read_timeout(seconds(30));
    return client;
  }
  httplib::Response get() const {
    const auto result = client().Get("/events");
    EXPECT_TRUE(result) << httplib::to_string(result.error());
    return result ? *result : httplib::Response();
  }

  Job job;

 private:
  std::atomic<bool> closing_ = false;
  EventStreams streams_;
  httplib::Server http_;
  int port_ = -1;
  std::thread thread_;
};

// Listens on a thread of its own; the stream is open when this has been made.
class Listener {
 public:
  explicit Listener(const EventServer& server)
      : thread_([this, &server] {
          bool first = true;
          server.client().Get("/events", [&](const char* data, std::size_t size) {
            text_.append(data, size);
            if (first) open_.set_value();
            first = false;
            return true;
          });
          if (first) open_.set_value();
        }) {
    open_.get_future().wait();
  }
  // What was told from the beginning to the end.
  std::string told() {
    if (thread_.joinable()) thread_.join();
    return text_;
  }
  ~Listener() { told(); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

 private:
  std::string text_;
  std::promise<void> open_;
  std::thread thread_;  // last: it uses the others
};

TEST(EventStreams, OneTooManyIsBusyUntilAnotherHasEnded) {
  EventServer server(3, seconds(60));
  std::list<Listener> listeners;
  for (int i = 0; i < 3; ++i) listeners.emplace_back(server);
  for (int i = 0; i < 2; ++i) expect_failure(server.get(), 503, "busy", "listen");
  server.job.succeed();
  for (Listener& listener : listeners)
    EXPECT_NE(listener.told().find("\"done\""), std::string::npos) << listener.told();
  // A place is free once the server is through with the answer, a moment after its listener.
  const auto start = steady_clock::now();
  httplib::Response again = server.get();
  while (again.status == 503 && steady_clock::now() - start < seconds(5)) again = server.get();
  EXPECT_EQ(again.status, 200);
  EXPECT_NE(again.body.find("\"done\""), std::string::npos) << again.body;
}

TEST(EventStreams, EachEndsAfterAWhileAndTheNextBeginsWithThePresentState) {
  EventServer server(3, milliseconds(200));
  server.job.progress("Looking", 0.25);
  const auto start = steady_clock::now();
  const httplib::Response first = server.get();
  const auto took = steady_clock::now() - start;
  EXPECT_EQ(first.status, 200);
  EXPECT_GE(took, milliseconds(200));
  EXPECT_LT(took, seconds(10));
  EXPECT_TRUE(first.body.starts_with("retry: ")) << first.body;
  EXPECT_NE(first.body.find("\"Looking\""), std::string::npos) << first.body;
  EXPECT_EQ(first.body.find("\"done\""), std::string::npos) << first.body;
  EXPECT_TRUE(first.body.ends_with("\n\n")) << first.body;  // what is not whole, browsers drop
  server.job.progress("Drawing", 0.5);
  const httplib::Response second = server.get();
  EXPECT_EQ(second.body.find("\"Looking\""), std::string::npos) << second.body;
  EXPECT_NE(second.body.find("\"Drawing\""), std::string::npos) << second.body;
}

TEST(EventStreams, TheStateIsToldHoweverShortAStreamMayBe) {
  EventServer server(1, milliseconds(1));
  EXPECT_NE(server.get().body.find("\"waiting\""), std::string::npos);
}

TEST_F(EventsOverHttp, WhereNobodyElseMayListenTheRestIsServedOn) {
  const RunningServer server([](ServerOptions& options) {
    options.samples = samples_folder();
    options.most_listeners = 1;
  });
  std::string last;
  for (int i = 0; i < 4; ++i) last = address_in(server.post_json("/estimates", {{"sample", "grace_hopper"}}));
  bool first = true;
  const auto result = server.client().Get("/api/v1" + last + "/events", [&](const char*, std::size_t) {
    if (first) {
      expect_failure(server.get(last + "/events"), 503, "busy", "listen");
      EXPECT_EQ(server.get("/info").status, 200);
      EXPECT_EQ(server.get(last).status, 200);
    }
    first = false;
    return true;
  });
  ASSERT_TRUE(result);
  EXPECT_FALSE(first);
}

}  // namespace
}  // namespace faceprobe::serve::testing
