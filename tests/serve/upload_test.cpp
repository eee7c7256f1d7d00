// What comes in as a photo, and what becomes of that which is none.

#include "serve/contract.h"
#include "serve/raw_http.h"
#include "serve/running_server.h"

namespace faceprobe::serve::testing {
namespace {

using UploadTest = ServerTest;
constexpr int kMostBytes = 2000;

void small_uploads(ServerOptions& options) { options.max_upload_bytes = kMostBytes; }

// An estimate that has failed; its address.
std::string failed_estimate(const RunningServer& server, const std::string& bytes) {
  const std::string address = address_in(server.post_photo(bytes));
  EXPECT_EQ(server.events(address).back()["state"], "failed");
  return address;
}

TEST_F(UploadTest, TooLargeIsASentenceAndLeavesNothing) {
  const RunningServer server(small_uploads);
  const httplib::Response response = server.post_photo(std::string(kMostBytes + 1, 'x'));
  expect_failure(response, 413, "too_large", "MB");
  EXPECT_EQ(Contract().faults({"POST", "/estimates"}, 413, "application/json", response.body),
            std::vector<std::string>());
  EXPECT_EQ(server.folder_entries(), 0U);
  EXPECT_EQ(json_of(server.get("/estimates")), Json::array());
  EXPECT_EQ(server.post_photo(std::string(kMostBytes, 'x')).status, 202);
}

// Neither has a length that could be judged beforehand.
TEST_F(UploadTest, ChunksAndPackedBytesDoNotGetPastTheLimit) {
  const RunningServer server(small_uploads);
  const std::string head =
      request_head("POST", "/api/v1/estimates", server.port()) + "Content-Type: application/octet-stream\r\n";
  std::string chunks;
  for (int i = 0; i < 100; ++i) chunks += "3e8\r\n" + std::string(1000, 'x') + "\r\n";
  const std::string chunked =
      answer_to(server.port(), head + "Transfer-Encoding: chunked\r\n\r\n" + chunks + "0\r\n\r\n");
  EXPECT_EQ(status_in(chunked) / 100, 4) << chunked;
  for (const std::string address : {"/estimates", "/nothing"}) {
    httplib::Client client = server.client();
    client.set_compress(true);  // to a thousandth
    const auto result = client.Post("/api/v1" + address, std::string(1'000'000, 'x'), "image/png");
    ASSERT_TRUE(result);
    EXPECT_EQ(result->status / 100, 4) << result->body;
  }
  const std::string endless = answer_to(server.port(), head + "\r\n" + std::string(kMostBytes + 1, 'x'));
  EXPECT_EQ(status_in(endless) / 100, 4) << endless;
  EXPECT_EQ(server.folder_entries(), 0U);
}

TEST_F(UploadTest, NothingIsNoPhoto) {
  const RunningServer server;
  expect_failure(server.post_photo(""), 400, "usage", "holds no photo");
  EXPECT_EQ(server.folder_entries(), 0U);
}

TEST_F(UploadTest, OneThatBreaksOffLeavesNothing) {
  const RunningServer server([](ServerOptions& options) { options.studio.keep = true; });
  const std::string head =
      request_head("POST", "/api/v1/estimates", server.port()) + "Content-Type: application/octet-stream\r\n";
  {
    Connection connection(server.port());
    connection.send(head + "Content-Length: 1000\r\n\r\nhalf of it");
  }
  // Connections are answered by several threads: the folder comes and goes when its own one gets round to it.
  for (int i = 0; i < 2000 && (i < 100 || server.folder_entries() > 0); ++i) server.get("/info");
  EXPECT_EQ(json_of(server.get("/estimates")), Json::array());
  EXPECT_EQ(server.folder_entries(), 0U);
}

TEST_F(UploadTest, OtherTypesAreRefused) {
  const RunningServer server;
  for (const std::string type :
       {"text/plain", "application/x-www-form-urlencoded", "multipart/form-data; boundary=x", ""}) {
    const auto result = server.client().Post("/api/v1/estimates", "bytes", type);
    ASSERT_TRUE(result) << type;
    EXPECT_EQ(result->status, 415) << type << result->body;
    EXPECT_NE(result->body.find("application/octet-stream"), std::string::npos) << result->body;
  }
  for (const std::string type : {"image/png", "Application/Octet-Stream", "application/octet-stream; x=y"}) {
    const auto result = server.client().Post("/api/v1/estimates", "bytes", type);
    ASSERT_TRUE(result) << type;
    EXPECT_EQ(result->status, 202) << type << result->body;
  }
}

TEST_F(UploadTest, ATextIsAJobThatFailsInWords) {
  const RunningServer server;
  const httplib::Response accepted = server.post_photo("These are words.", "words.jpg");
  EXPECT_EQ(accepted.status, 202);
  const std::string address = address_in(accepted);
  EXPECT_EQ(address, "/estimates/" + json_of(accepted)["id"].get<std::string>());
  const Json last = server.events(address).back();
  EXPECT_EQ(last["state"], "failed");
  EXPECT_EQ(last["error"]["kind"], "input");
  const std::string sentence = last["error"]["message"];
  EXPECT_NE(sentence.find("JPEG, PNG"), std::string::npos) << sentence;
  EXPECT_EQ(sentence.find(server.folder()), std::string::npos)
      << "names of this machine's folders are nobody's business";
  const Json estimate = json_of(server.get(address));
  EXPECT_EQ(estimate["name"], "words.jpg");
  EXPECT_EQ(estimate["job"]["error"], last["error"]);
  EXPECT_EQ(Contract().faults_of(estimate, Contract().schema("Estimate"), "it"), std::vector<std::string>());
}

TEST_F(UploadTest, WhatHasFailedHasNoFiles) {
  const RunningServer server;
  const std::string address = failed_estimate(server, "words");
  expect_failure(server.get(address + "/photo"), 404, "not_found", "photo");
  expect_failure(server.get(address + "/files/report.json"), 404, "not_found", "not done");
  expect_failure(server.get(address + "/archive.zip"), 404, "not_found", "not done");
  expect_failure(server.post_json(address + "/insertions", {{"object", "cube"}}), 409, "not_ready", "light");
  EXPECT_EQ(server.remove(address).status, 204);
  expect_failure(server.get(address), 404, "not_found", "removed");
}

TEST_F(UploadTest, APictureWithoutAFaceSaysSo) {
  const RunningServer server;
  const std::string address = address_in(server.post_photo(blank_picture(160, 120)));
  const Json last = server.events(address).back();
  EXPECT_EQ(last["error"]["kind"], "no_face");
  EXPECT_NE(last["error"]["message"].get<std::string>().find("160 x 120"), std::string::npos) << last;
  // It could be read, so it can be shown.
  const httplib::Response shown = server.get(address + "/photo");
  EXPECT_EQ(shown.get_header_value("Content-Type"), "image/png");
  EXPECT_TRUE(shown.body.starts_with("\x89PNG"));
}

TEST_F(UploadTest, NamesAreShownAndNoPaths) {
  const RunningServer server;
  const std::string name = "../../../etc/pass\nwd <b>&\"'";
  const Json accepted = json_of(server.post_photo("words", name));
  EXPECT_EQ(accepted["name"], "../../../etc/pass wd <b>&\"'");
  EXPECT_EQ(json_of(server.get("/estimates"))[0]["name"], accepted["name"]);
  EXPECT_EQ(json_of(server.post_photo("words"))["name"], "photo");
  EXPECT_EQ(json_of(server.post_photo("words", "a\xFF"))["name"], "a\uFFFD");
}

TEST_F(UploadTest, SamplesAreThoseThatAreThere) {
  const RunningServer without;
  EXPECT_EQ(json_of(without.get("/info"))["samples"], Json::array());
  expect_failure(without.get("/samples/grace_hopper"), 404, "not_found", "grace_hopper");
  expect_failure(without.post_json("/estimates", {{"sample", "grace_hopper"}}), 404, "not_found", "grace_hopper");
  EXPECT_EQ(without.folder_entries(), 0U);

  const TempFolder folder;
  std::filesystem::copy_file(sample_photo_file(), folder / "grace_hopper.jpg");
  std::filesystem::copy_file(sample_photo_file(), folder / "secret.jpg");
  const RunningServer server([&](ServerOptions& options) { options.samples = folder.path(); });
  const Json info = json_of(server.get("/info"));
  ASSERT_EQ(info["samples"].size(), 1U);
  EXPECT_EQ(info["samples"][0]["name"], "grace_hopper");
  const httplib::Response sample = server.get("/samples/grace_hopper");
  EXPECT_EQ(sample.get_header_value("Content-Type"), "image/jpeg");
  EXPECT_EQ(sample.body, bytes_of(sample_photo_file()));
  for (const std::string name :
       {"astronaut", "secret", "secret.jpg", "../grace_hopper", "grace_hopper.jpg", "/etc/passwd"}) {
    expect_failure(server.post_json("/estimates", {{"sample", name}}), 404, "not_found", "'" + name + "'");
  }
  expect_failure(server.get("/samples/secret"), 404, "not_found", "secret");
}

TEST_F(UploadTest, RequestsInJsonAreLimitedAndChecked) {
  const RunningServer server;
  const std::string id = "0123456789abcdef";
  for (const std::string& address : {std::string("/estimates"), "/estimates/" + id + "/insertions"}) {
    expect_failure(server.post_json(address, {{"sample", std::string(70'000, 'x')}}), 413, "too_large", "65536");
    expect_failure(server.post_json(address, Json::array()), 400, "usage", "JSON object");
    expect_failure(server.post_json(address, {{"objects", 1}}), 400, "usage", "object");
    const auto nested = server.client().Post("/api/v1" + address, std::string(60'000, '['), "application/json");
    ASSERT_TRUE(nested);
    expect_failure(*nested, 400, "usage", "JSON object");
  }
  const auto plain =
      server.client().Post("/api/v1/estimates/" + id + "/insertions", "{\"object\": \"cube\"}", "text/plain");
  ASSERT_TRUE(plain);
  expect_failure(*plain, 415, "wrong_type", "application/json");
}

TEST_F(UploadTest, TheOldestMakesRoomAndItsFolderGoes) {
  const RunningServer server([](ServerOptions& options) { options.studio.history_limit = 1; });
  const std::string first = failed_estimate(server, "words");
  const std::string second = failed_estimate(server, "other words");
  expect_failure(server.get(first), 404, "not_found", "made room");
  EXPECT_EQ(json_of(server.get("/estimates")).size(), 1U);
  EXPECT_EQ(server.get(second).status, 200);
  // The worker lets go of what it has done when it takes up the next, or shortly after it is done.
  for (int i = 0; i < 1000 && server.folder_entries() > 1; ++i) server.get("/info");
  EXPECT_EQ(server.folder_entries(), 1U);
}

TEST_F(UploadTest, WhenTooManyWaitOneMoreIsRefused) {
  const RunningServer server([](ServerOptions& options) {
    options.studio.most_waiting = 0;
    options.studio.keep = true;
  });
  const httplib::Response response = server.post_photo("words");
  expect_failure(response, 503, "busy", "waiting");
  EXPECT_EQ(json_of(server.get("/estimates")), Json::array());
  EXPECT_EQ(server.folder_entries(), 0U) << "nothing is kept of what was never worked on";
}

TEST_F(UploadTest, WhatIsToBeKeptIs) {
  const TempFolder folder;
  {
    const RunningServer server([&](ServerOptions& options) {
      options.studio.folder = folder.path();
      options.studio.keep = true;
    });
    const std::string address = failed_estimate(server, blank_picture(160, 120));
    EXPECT_EQ(server.remove(address).status, 204);
  }
  EXPECT_FALSE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace faceprobe::serve::testing
