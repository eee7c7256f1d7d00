#include "serve/guard.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace faceprobe::serve {
namespace {

// As browsers tell it. Other ports of this machine are the same site, and strangers all the same.
bool is_from_elsewhere(const Caller& caller) {
  if (caller.fetch_site.empty() || caller.fetch_site == "same-origin" || caller.fetch_site == "none") return false;
  const bool follows_a_link = caller.fetch_mode == "navigate" && caller.fetch_dest == "document";
  return !(follows_a_link && caller.gets_front_page);
}

}  // namespace

std::string fault_of_caller(const Caller& caller, int port) {
  static const std::array<std::string, 3> own = {"127.0.0.1", "localhost", "[::1]"};
  constexpr int kPortOfHttp = 80;  // which browsers leave out
  const auto is_own = [&](const std::string& name) {
    return std::ranges::any_of(own, [&](const std::string& plain) {
      return name == plain + ":" + std::to_string(port) || (port == kPortOfHttp && name == plain);
    });
  };
  const std::string address = own[0] + ":" + std::to_string(port);
  if (!is_own(caller.host))
    return "This server answers to " + address + " alone, found a request for '" + caller.host + "'.";
  constexpr std::string_view kScheme = "http://";
  const std::string& origin = caller.origin;
  if (!origin.empty() && !(origin.starts_with(kScheme) && is_own(origin.substr(kScheme.size()))))
    return "A page of " + origin + " may not use this server; open http://" + address + "/ instead.";
  if (is_from_elsewhere(caller)) return "Another page may not use this server; open http://" + address + "/ instead.";
  return {};
}

}  // namespace faceprobe::serve
