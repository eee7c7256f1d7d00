#pragma once
// `faceprobe serve`: the page and the API of openapi.json on the loopback address.
//
//   serve::Server server(options);                       // loads the models; throws Error(kUsage, kModel)
//   std::printf("http://127.0.0.1:%d/\n", server.port());
//   server.run();                                        // until another thread calls stop()
//
// For one person on one machine: there is no log-in, and estimates are made one after another.

#include "serve/studio.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace faceprobe::serve {

struct ServerOptions {
  StudioOptions studio;
  int port = 8765;                // 0 = any that is free
  std::filesystem::path page;     // folder with index.html; empty = the API alone
  std::filesystem::path samples;  // folder with sample photos; empty = none
  std::int64_t max_upload_bytes = 64LL << 20;
  // Of a job's events: how many may listen at a time, and how long until a listener has to ask again.
  int most_listeners = 12;
  std::chrono::milliseconds longest_stream = std::chrono::seconds(30);

  // Empty when usable, else a sentence that says which value is wrong.
  std::string validate() const;
};

// Why a port could not be opened, by errno's number (0: nobody knows), and what to do.
std::string port_fault(int port, int error);

class Server {
 public:
  explicit Server(ServerOptions options);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  int port() const;
  void run();
  // From another thread; run() ends when what is answered has been.
  void stop();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace faceprobe::serve
