#include "serve/guard.h"

#include <algorithm>
#include <array>

namespace faceprobe::serve {

std::string fault_of_caller(const std::string& host, const std::string& origin, int port) {
  static const std::array<std::string, 3> own = {"127.0.0.1", "localhost", "[::1]"};
  constexpr int kPortOfHttp = 80;  // which browsers leave out
  const auto is_own = [&](const std::string& name) {
    return std::ranges::any_of(own, [&](const std::string& plain) {
      return name == plain + ":" + std::to_string(port) || (port == kPortOfHttp && name == plain);
    });
  };
  const std::string address = own[0] + ":" + std::to_string(port);
  if (!is_own(host)) return "This server answers to " + address + " alone, found a request for '" + host + "'.";
  constexpr std::string_view kScheme = "http://";
  if (origin.empty() || (origin.starts_with(kScheme) && is_own(origin.substr(kScheme.size())))) return {};
  return "A page of " + origin + " may not use this server; open http://" + address + "/ instead.";
}

}  // namespace faceprobe::serve
