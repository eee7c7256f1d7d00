// Strangers' pages in the same browser, and requests that no client sends by mistake.

#include "serve/raw_http.h"
#include "serve/running_server.h"

#include <fstream>
#include <string>
#include <vector>

namespace faceprobe::serve::testing {
namespace {

using HostileTest = ServerTest;

using Texts = std::vector<std::string>;

const std::string kId = "0123456789abcdef";

TEST_F(HostileTest, ForeignHostsAreForbiddenEverything) {
  const TempFolder page;
  std::ofstream(page / "index.html") << "page";
  const RunningServer server([&](ServerOptions& options) { options.page = page.path(); });
  for (const std::string target : {"/", "/index.html", "/api/v1/info", "/api/v1/estimates", "/nothing"}) {
    for (const std::string& host : Texts{"evil.example", "evil.example:" + std::to_string(server.port()), "127.0.0.1"}) {
      const auto result = server.client().Get(target, {{"Host", host}});
      ASSERT_TRUE(result);
      expect_failure(*result, 403, "forbidden", "'" + host + "'");
    }
    const std::string without = answer_to(server.port(), "GET " + target + " HTTP/1.1\r\nConnection: close\r\n\r\n");
    EXPECT_EQ(status_in(without), 403) << without;
  }
}

TEST_F(HostileTest, ForeignOriginsAreForbiddenEverything) {
  const RunningServer server;
  const std::string own = "http://127.0.0.1:" + std::to_string(server.port());
  for (const std::string& origin : Texts{"http://evil.example", "null", own + "0", own + ".evil.example"}) {
    const httplib::Headers headers = {{"Origin", origin}};
    auto client = server.client();
    for (const auto& result :
         {client.Get("/api/v1/info", headers), client.Get("/", headers),
          client.Post("/api/v1/estimates", headers, "bytes", "image/png"),
          client.Delete("/api/v1/estimates/" + kId, headers), client.Options("/api/v1/info", headers)}) {
      ASSERT_TRUE(result);
      expect_failure(*result, 403, "forbidden", origin);
      EXPECT_FALSE(result->has_header("Access-Control-Allow-Origin"));
    }
  }
  EXPECT_EQ(json_of(server.get("/estimates")), Json::array());
  const auto result = server.client().Get("/api/v1/info", {{"Origin", own}});
  ASSERT_TRUE(result);
  EXPECT_EQ(result->status, 200);
}

// A picture or a link of another page comes without an Origin; browsers tell where it is from all the same.
TEST_F(HostileTest, OtherPagesGetNothingButTheFrontPageByALink) {
  const RunningServer server;
  const auto status = [&](const std::string& target, const std::string& site, const std::string& mode,
                          const std::string& dest) {
    const auto result =
        server.client().Get(target, {{"Sec-Fetch-Site", site}, {"Sec-Fetch-Mode", mode}, {"Sec-Fetch-Dest", dest}});
    EXPECT_TRUE(result) << target;
    if (!result) return 0;
    if (result->status != 200) expect_failure(*result, 403, "forbidden", "Another page");
    return result->status;
  };
  for (const std::string site : {"cross-site", "same-site"}) {
    EXPECT_EQ(status("/api/v1/info", site, "no-cors", "image"), 403) << site;
    EXPECT_EQ(status("/api/v1/info", site, "navigate", "document"), 403) << site;
    EXPECT_EQ(status("/", site, "no-cors", "image"), 403) << site;
    EXPECT_EQ(status("/", site, "navigate", "iframe"), 403) << site;
    EXPECT_EQ(status("/", site, "navigate", "document"), 200) << site;
    EXPECT_EQ(status("/?x=y", site, "navigate", "document"), 200) << site;
  }
  EXPECT_EQ(status("/api/v1/info", "same-origin", "cors", "empty"), 200);
  EXPECT_EQ(status("/api/v1/info", "none", "navigate", "document"), 200);
  auto client = server.client();
  const auto posted = client.Post("/api/v1/estimates", {{"Sec-Fetch-Site", "cross-site"}}, "bytes", "image/png");
  ASSERT_TRUE(posted);
  expect_failure(*posted, 403, "forbidden", "Another page");
  EXPECT_EQ(json_of(server.get("/estimates")), Json::array());
}

// A form of a stranger's page sends what it likes as the body of a request that is refused. Taken for the next request it would come from
// nowhere, to our own name.
TEST_F(HostileTest, TheBodyOfARefusedRequestIsNoRequest) {
  const RunningServer server;
  const std::string own = "127.0.0.1:" + std::to_string(server.port());
  const std::string hidden = "POST /api/v1/estimates HTTP/1.1\r\nHost: " + own +
                             "\r\nContent-Type: image/png\r\nContent-Length: 5\r\n\r\nbytes";
  const std::string length = "Content-Length: " + std::to_string(hidden.size()) + "\r\n\r\n";
  for (const std::string& head :
       Texts{"POST /api/v1/estimates HTTP/1.1\r\nHost: " + own +
                 "\r\nOrigin: http://evil.example\r\nContent-Type: text/plain\r\n",
             "POST /api/v1/estimates HTTP/1.1\r\nHost: evil.example\r\nContent-Type: text/plain\r\n",
             "DELETE /api/v1/estimates/" + kId + " HTTP/1.1\r\nHost: " + own + "\r\nOrigin: null\r\n",
             "GET /api/v1/info HTTP/1.1\r\nHost: " + own + "\r\n"}) {
    Connection connection(server.port());
    connection.send(head + length);
    std::string answers = connection.read_some();  // the refusal comes before the body has left
    connection.send(hidden);
    answers += connection.read_all();
    EXPECT_EQ(count_answers(answers), 1) << answers;
  }
  EXPECT_EQ(json_of(server.get("/estimates")), Json::array());
}

TEST_F(HostileTest, NoPathLeadsOutOfThePage) {
  const TempFolder folder;
  std::filesystem::create_directories(folder / "page/assets");
  std::ofstream(folder / "page/index.html") << "page";
  std::ofstream(folder / "page/assets/x.js") << "script";
  std::ofstream(folder / "secret.txt") << "TOP SECRET";
  const RunningServer server([&](ServerOptions& options) { options.page = folder / "page"; });
  const std::string absolute = (folder / "secret.txt").string();
  for (const std::string& target :
       Texts{"/../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt", "/%2e%2e%2fsecret.txt",
             "/assets/../../secret.txt", "/assets/%2e%2e/%2e%2e/secret.txt", "/assets/..%2f..%2fsecret.txt",
             "/assets../secret.txt", "/assets%2f..%2f..%2fsecret.txt", "/./../secret.txt", "//../secret.txt",
             "/..\\secret.txt", "/%252e%252e/secret.txt", "/../secret.txt%00.html", absolute, "/" + absolute}) {
    const std::string answer = answer_to(server.port(), request_head("GET", target, server.port()) + "\r\n");
    EXPECT_EQ(answer.find("SECRET"), std::string::npos) << target;
    EXPECT_EQ(status_in(answer), 404) << target << ": " << answer;
  }
}

TEST_F(HostileTest, StrangeRequestsAreAnsweredAndDoNotEndTheServer) {
  const RunningServer server;
  const auto sent = [&](const std::string& bytes) { return status_in(answer_to(server.port(), bytes)); };
  const auto get = [&](const std::string& target, const std::string& headers = "") {
    return sent(request_head("GET", target, server.port()) + headers + "\r\n");
  };
  EXPECT_EQ(sent("\r\n"), 400);
  EXPECT_EQ(sent("GET\r\n\r\n"), 400);
  EXPECT_EQ(sent("BREW /pot HTTP/1.1\r\n\r\n"), 400);
  EXPECT_EQ(sent("GET / HTTP/9.9\r\n\r\n"), 400);
  EXPECT_EQ(sent(std::string("\x16\x03\x01\x02\x00\x01\r\n\r\n", 10)), 400);  // how TLS begins
  EXPECT_EQ(get("/api/v1/" + std::string(20'000, 'x')) / 100, 4);
  // Patterns are matched by recursion, which long paths must not exhaust.
  for (const std::size_t length : {800U, 8000U}) {
    EXPECT_EQ(get("/api/v1/estimates/" + kId + "/files/" + std::string(length, 'x')), 404);
    EXPECT_EQ(get("/api/v1/objects/" + std::string(length, 'x')), 404);
  }
  std::string ranges = "0-";
  while (ranges.size() < 8000) ranges += ",0-";
  EXPECT_NE(get("/api/v1/info", "Range: bytes=" + ranges + "\r\n"), 0);
  EXPECT_EQ(get("/api/v1/info", "Range: bytes=0-" + std::string(1000, '9') + "\r\n") / 100, 4);
  EXPECT_EQ(get("/api/v1/info", "Range: bytes=9999999-\r\n"), 416);
  EXPECT_EQ(get("/api/v1/info", "Range: bytes=0-3, 2-5, -1\r\n"), 206);
  EXPECT_EQ(get("/api/v1/info", "Cookie: " + std::string(7000, 'x') + "\r\n"), 200);
  EXPECT_EQ(get("/api/v1/estimates/%00" + kId.substr(1)), 404);
  EXPECT_EQ(server.get("/info").status, 200);
}

}  // namespace
}  // namespace faceprobe::serve::testing
