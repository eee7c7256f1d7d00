#include "serve/guard.h"

#include <algorithm>
#include <array>

namespace faceprobe::serve {

std::string fault_of_caller(const std::string& host, const std::string& origin, int port) {
  std::array<std::string, 3> own = {"127.0.0.1", "localhost", "[::1]"};
  for (std::string& name : own) name += ":" + std::to_string(port);
  const auto is_own = [&](const std::string& name) { return std::ranges::find(own, name) != own.end(); };
  if (!is_own(host)) return "This server answers to " + own[0] + " alone, found a request for '" + host + "'.";
  constexpr std::string_view kScheme = "http://";
  if (origin.empty() || (origin.starts_with(kScheme) && is_own(origin.substr(kScheme.size())))) return {};
  return "A page of " + origin + " may not use this server; open http://" + own[0] + "/ instead.";
}

}  // namespace faceprobe::serve
