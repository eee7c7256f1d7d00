#pragma once
// Bytes to a port of this machine and what comes back, for requests that no HTTP library sends.

#include <string>

namespace faceprobe::serve::testing {

// A connection that is open until this goes.
class Connection {
 public:
  explicit Connection(int port);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void send(const std::string& bytes);
  // What comes next; empty when the other side has closed, or nothing has come for long.
  std::string read_some();
  // All that comes until then.
  std::string read_all();

 private:
  int socket_ = -1;
};

// What a server answers to these bytes.
std::string answer_to(int port, const std::string& bytes);
// The head of a request of this server's own, without its last empty line: "GET /x HTTP/1.1", Host, and that the connection is to be closed.
std::string request_head(const std::string& method, const std::string& target, int port);
// How many answers these bytes are.
int count_answers(const std::string& bytes);
// Of the first answer; 0 when it is none.
int status_in(const std::string& bytes);

}  // namespace faceprobe::serve::testing
