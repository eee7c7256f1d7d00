// How a server begins and ends.

#include "serve/raw_http.h"
#include "serve/running_server.h"
#include "support/expect_error.h"

#include <cerrno>
#include <chrono>
#include <future>
#include <string>
#include <system_error>
#include <thread>

namespace faceprobe::serve::testing {
namespace {

using faceprobe::testing::expect_error;
using std::chrono::steady_clock;
using StopTest = ServerTest;

double seconds_since(steady_clock::time_point start) {
  return std::chrono::duration<double>(steady_clock::now() - start).count();
}

TEST(ServerOptions, EachValueIsChecked) {
  EXPECT_EQ(ServerOptions().validate(), "");
  const auto refused = [](const auto& change) {
    ServerOptions options;
    change(options);
    return !options.validate().empty();
  };
  EXPECT_TRUE(refused([](ServerOptions& o) { o.port = -1; }));
  EXPECT_TRUE(refused([](ServerOptions& o) { o.port = 65536; }));
  EXPECT_TRUE(refused([](ServerOptions& o) { o.max_upload_bytes = 0; }));
  EXPECT_TRUE(refused([](ServerOptions& o) { o.most_listeners = 0; }));
  EXPECT_TRUE(refused([](ServerOptions& o) { o.most_listeners = 24; }));  // as many as there are threads
  EXPECT_TRUE(refused([](ServerOptions& o) { o.longest_stream = std::chrono::milliseconds(0); }));
  EXPECT_TRUE(refused([](ServerOptions& o) { o.studio.history_limit = 0; }));
  EXPECT_TRUE(refused([](ServerOptions& o) { o.studio.estimate.layer_px = 1; }));
  expect_error(ExitCode::kUsage, {"port"}, [] {
    ServerOptions options;
    options.port = 65536;
    const Server server(options);
  });
}

TEST_F(StopTest, APortThatIsTakenIsASentence) {
  const RunningServer first;
  expect_error(ExitCode::kUsage, {"Port " + std::to_string(first.port()) + " is taken", "--port"}, [&] {
    ServerOptions options = quick_options(first.folder());
    options.port = first.port();
    const Server second(options);
  });
  EXPECT_EQ(first.get("/info").status, 200);
}

TEST(PortFault, SaysWhatTheSystemSaid) {
  EXPECT_NE(port_fault(80, EADDRINUSE).find("Port 80 is taken, perhaps by another faceprobe;"), std::string::npos);
  const std::string forbidden = port_fault(80, EACCES);
  EXPECT_EQ(forbidden.find("taken"), std::string::npos) << forbidden;
  EXPECT_NE(forbidden.find(std::generic_category().message(EACCES)), std::string::npos) << forbidden;
  const std::string unknown = port_fault(8765, 0);
  EXPECT_TRUE(unknown.starts_with("Port 8765 could not be opened;")) << unknown;
  for (const int error : {EADDRINUSE, EACCES, 0}) EXPECT_TRUE(port_fault(80, error).ends_with("--port, or 0 for any."));
}

TEST_F(StopTest, APortIsFreeAgainAfterTheEnd) {
  int port = 0;
  {
    const RunningServer first;
    port = first.port();
    first.get("/info");
  }
  const RunningServer second([port](ServerOptions& options) { options.port = port; });
  EXPECT_EQ(second.port(), port);
  EXPECT_EQ(second.get("/info").status, 200);
}

TEST_F(StopTest, OtherMachinesCannotConnect) {
  const RunningServer server;
  // 127.0.0.2 is this machine too, but not the address that is listened on.
  httplib::Client other("127.0.0.2", server.port());
  other.set_connection_timeout(std::chrono::seconds(2));
  EXPECT_EQ(other.Get("/").error(), httplib::Error::Connection);
}

TEST_F(StopTest, EndsTheStreamsThatAreOpen) {
  RunningServer server([](ServerOptions& options) { options.samples = samples_folder(); });
  const Json sample = {{"sample", "grace_hopper"}};
  server.post_json("/estimates", sample);
  const std::string waits = address_in(server.post_json("/estimates", sample));
  std::promise<void> open;
  std::string told;
  std::thread listener([&] {
    server.client().Get("/api/v1" + waits + "/events", [&](const char* data, std::size_t size) {
      if (told.empty()) open.set_value();
      told.append(data, size);
      return true;
    });
    if (told.empty()) open.set_value();
  });
  open.get_future().wait();
  const auto start = steady_clock::now();
  server.stop();
  EXPECT_LT(seconds_since(start), 5);
  listener.join();
  EXPECT_EQ(told.find("\"done\""), std::string::npos) << "it ended by itself: " << told;
}

// Browsers open connections before they need them.
TEST_F(StopTest, DoesNotWaitLongForThoseWhoSayNothing) {
  RunningServer server;
  const Connection silent(server.port());
  server.get("/info");  // connections are taken up in order: the silent one has been
  const auto start = steady_clock::now();
  server.stop();
  EXPECT_LT(seconds_since(start), 3);
}

TEST_F(StopTest, ComesBeforeTheBeginningToo) {
  const TempFolder folder;
  Server server(quick_options(folder.path()));
  server.stop();
  const auto run = std::async(std::launch::async, [&] { server.run(); });
  const bool ended = run.wait_for(std::chrono::seconds(5)) == std::future_status::ready;
  EXPECT_TRUE(ended) << "it runs, and nobody will stop it";
  if (!ended) server.stop();
}

TEST_F(StopTest, MayComeAtAnyTime) {
  for (int i = 0; i < 3; ++i) {
    const TempFolder folder;
    Server server(quick_options(folder.path()));
    const auto run = std::async(std::launch::async, [&] { server.run(); });
    server.stop();
    const bool ended = run.wait_for(std::chrono::seconds(5)) == std::future_status::ready;
    EXPECT_TRUE(ended) << i;
    if (!ended) server.stop();
  }
}

}  // namespace
}  // namespace faceprobe::serve::testing
