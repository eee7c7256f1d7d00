// The page's own files, and what every answer says to browsers.

#include "serve/guard.h"
#include "serve/raw_http.h"
#include "serve/running_server.h"

#include <fstream>
#include <string>
#include <vector>

namespace faceprobe::serve::testing {
namespace {

// A page of one document and one script.
class PageTest : public ServerTest {
 protected:
  void SetUp() override {
    ServerTest::SetUp();
    std::filesystem::create_directories(folder_ / "assets");
    std::ofstream(folder_ / "index.html") << "<!doctype html><p>page";
    std::ofstream(folder_ / "openapi.json") << "{}";
    std::ofstream(folder_ / "assets/x.js") << "'script'";
  }
  std::function<void(ServerOptions&)> with_page() const {
    return [this](ServerOptions& options) {
      options.page = folder_.path();
      options.max_upload_bytes = 1000;
    };
  }

  TempFolder folder_;
};

httplib::Response got(const RunningServer& server, const std::string& target) {
  const auto result = server.client().Get(target);
  EXPECT_TRUE(result) << target;
  return result ? *result : httplib::Response();
}

TEST_F(PageTest, IsServedWithWhatMayBeKept) {
  const RunningServer server(with_page());
  for (const std::string target : {"/", "/index.html"}) {
    const httplib::Response page = got(server, target);
    EXPECT_EQ(page.status, 200);
    EXPECT_EQ(page.body, "<!doctype html><p>page");
    EXPECT_TRUE(page.get_header_value("Content-Type").starts_with("text/html"));
    EXPECT_EQ(page.get_header_value("Cache-Control"), "no-cache");
    EXPECT_EQ(page.get_header_value_count("Cache-Control"), 1U);
  }
  const httplib::Response script = got(server, "/assets/x.js");
  EXPECT_EQ(script.body, "'script'");
  EXPECT_NE(script.get_header_value("Content-Type").find("javascript"), std::string::npos);
  EXPECT_EQ(script.get_header_value("Cache-Control"), "max-age=31536000, immutable");
  EXPECT_EQ(got(server, "/openapi.json").get_header_value("Content-Type"), "application/json");
}

TEST_F(PageTest, WhatIsNotThereIsAFailureInJson) {
  const RunningServer server(with_page());
  expect_failure(got(server, "/assets/y.js"), 404, "not_found", "/assets/y.js");
  expect_failure(got(server, "/elsewhere"), 404, "not_found", "openapi.json");
}

TEST_F(PageTest, WithoutOneTheServerSaysSo) {
  const RunningServer server;
  const httplib::Response page = got(server, "/");
  EXPECT_EQ(page.status, 200);
  EXPECT_TRUE(page.get_header_value("Content-Type").starts_with("text/html"));
  EXPECT_NE(page.body.find("not built"), std::string::npos);
  EXPECT_EQ(server.get("/info").status, 200);
}

TEST_F(PageTest, NothingIsPackedOnItsWayToTheSameMachine) {
  const RunningServer server(with_page());
  for (const std::string target : {"/assets/x.js", "/api/v1/objects/pot"}) {
    const auto answer = server.client().Get(target, httplib::Headers{{"Accept-Encoding", "br, gzip, deflate"}});
    ASSERT_TRUE(answer) << target;
    EXPECT_EQ(answer->status, 200);
    EXPECT_FALSE(answer->has_header("Content-Encoding"))
        << target << ": " << answer->get_header_value("Content-Encoding");
  }
}

TEST_F(PageTest, AnswersOfTheApiAreNotKept) {
  const RunningServer server(with_page());
  for (const std::string address : {"/info", "/estimates", "/objects/cube", "/estimates/0123456789abcdef"})
    EXPECT_EQ(server.get(address).get_header_value("Cache-Control"), "no-store") << address;
}

TEST_F(PageTest, EveryAnswerSaysWhatBrowsersMayDo) {
  const RunningServer server(with_page());
  auto client = server.client();
  const std::string failed = address_in(server.post_photo("words"));
  std::vector<httplib::Response> answers;
  for (const std::string target : {"/", "/assets/x.js", "/nothing", "/api/v1/info", "/api/v1/objects/cube"})
    answers.push_back(got(server, target));
  for (const std::string& address : {failed, failed + "/events", failed + "/photo", failed + "/archive.zip"})
    answers.push_back(server.get(address));
  for (const auto& result :
       {client.Get("/", {{"Host", "evil.example"}}), client.Head("/api/v1/info"), client.Options("/api/v1/info"),
        client.Post("/api/v1/estimates", std::string(2000, 'x'), "image/png"), client.Delete("/api/v1" + failed)}) {
    ASSERT_TRUE(result);
    answers.push_back(*result);
  }
  for (const httplib::Response& answer : answers) {
    const std::string what = std::to_string(answer.status) + ' ' + answer.body.substr(0, 80);
    EXPECT_EQ(answer.get_header_value("Content-Security-Policy"), kContentSecurityPolicy) << what;
    EXPECT_EQ(answer.get_header_value("X-Content-Type-Options"), "nosniff") << what;
    EXPECT_EQ(answer.get_header_value("Cross-Origin-Resource-Policy"), "same-origin") << what;
    EXPECT_EQ(answer.get_header_value("Cross-Origin-Opener-Policy"), "same-origin") << what;
    EXPECT_EQ(answer.get_header_value("Referrer-Policy"), "no-referrer") << what;
  }
  const std::string unreadable = answer_to(server.port(), "nonsense\r\n\r\n");
  EXPECT_NE(unreadable.find("Content-Security-Policy: "), std::string::npos) << unreadable;
  EXPECT_NE(unreadable.find("X-Content-Type-Options: nosniff"), std::string::npos) << unreadable;
}

}  // namespace
}  // namespace faceprobe::serve::testing
