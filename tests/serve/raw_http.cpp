#include "serve/raw_http.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>

namespace faceprobe::serve::testing {

Connection::Connection(int port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    ::close(socket_);
    throw std::runtime_error("nobody listens on port " + std::to_string(port));
  }
}

Connection::~Connection() { ::close(socket_); }

void Connection::send(const std::string& bytes) {
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t now = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (now <= 0) return;  // a server may have had enough; its answer is what counts
    sent += static_cast<std::size_t>(now);
  }
}

std::string Connection::read_some() {
  constexpr int kPatienceMs = 10'000;
  std::array<char, 4096> part{};
  pollfd ready{.fd = socket_, .events = POLLIN, .revents = 0};
  if (::poll(&ready, 1, kPatienceMs) <= 0) return {};
  const ssize_t now = ::recv(socket_, part.data(), part.size(), 0);
  return now <= 0 ? std::string() : std::string(part.data(), static_cast<std::size_t>(now));
}

std::string Connection::read_all() {
  std::string all;
  for (std::string part = read_some(); !part.empty(); part = read_some()) all += part;
  return all;
}

std::string answer_to(int port, const std::string& bytes) {
  Connection connection(port);
  connection.send(bytes);
  return connection.read_all();
}

std::string request_head(const std::string& method, const std::string& target, int port) {
  return method + " " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\nConnection: close\r\n";
}

int count_answers(const std::string& bytes) {
  int count = 0;
  for (std::size_t at = bytes.find("HTTP/1.1 "); at != std::string::npos; at = bytes.find("HTTP/1.1 ", at + 1)) ++count;
  return count;
}

int status_in(const std::string& bytes) {
  return bytes.starts_with("HTTP/1.1 ") ? std::atoi(bytes.c_str() + std::string("HTTP/1.1 ").size()) : 0;
}

}  // namespace faceprobe::serve::testing
