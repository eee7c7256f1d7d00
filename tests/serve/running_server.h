#pragma once
// A server that answers on a free port, its results in a folder of its own, and what its tests ask it.

#include "serve/server.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>
#include <httplib.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace faceprobe::serve::testing {

using faceprobe::testing::TempFolder;

// Small maps and few steps: what the light is like is tested elsewhere.
ServerOptions quick_options(const std::filesystem::path& folder);

class RunningServer {
 public:
  explicit RunningServer(const std::function<void(ServerOptions&)>& change = {});
  ~RunningServer();
  RunningServer(const RunningServer&) = delete;
  RunningServer& operator=(const RunningServer&) = delete;

  int port() const { return server_->port(); }
  // Where results lie: one folder an estimate.
  const std::filesystem::path& folder() const { return folder_.path(); }
  std::size_t folder_entries() const;
  // Ends it; run() has come back then.
  void stop();

  httplib::Client client() const;
  // What comes back is checked to be an answer at all. `address`: below /api/v1.
  httplib::Response get(const std::string& address) const;
  httplib::Response remove(const std::string& address) const;
  httplib::Response post_json(const std::string& address, const Json& body) const;
  httplib::Response post_photo(const std::string& bytes, const std::string& name = "") const;

  // All states of a job until it has ended, as its events tell them. `address`: the job's.
  std::vector<Json> events(const std::string& address) const;

 private:
  // The states that one stream tells, behind those that are there.
  void listen(const std::string& address, std::vector<Json>& states) const;

  TempFolder folder_;
  std::unique_ptr<Server> server_;
  std::thread thread_;
};

// The sample portrait: 512 x 600 px, one face.
std::filesystem::path sample_photo_file();
std::filesystem::path samples_folder();
std::string bytes_of(const std::filesystem::path& file);
// A PNG of one grey.
std::string blank_picture(int width, int height);

// An address below /api/v1 out of a Location header.
std::string address_in(const httplib::Response& response);
Json json_of(const httplib::Response& response);
// Expects this status and kind of failure, and a sentence that has this part.
void expect_failure(const httplib::Response& response, int status, const std::string& kind, const std::string& part);

// Skipped where set-up has fetched neither models nor photos.
class ServerTest : public ::testing::Test {
 protected:
  void SetUp() override;
};

}  // namespace faceprobe::serve::testing
