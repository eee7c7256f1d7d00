#pragma once
// Who may ask. The server listens on the loopback address alone, but any page in the user's browser can send requests there: names that were
// bent to 127.0.0.1 come with their own Host (DNS rebinding), scripts and forms of other pages with their own Origin, and what comes without
// one, such as a picture of another page, with a Sec-Fetch-Site.

#include <string>

namespace faceprobe::serve {

// The headers' values, empty where there are none: programs send no Sec-Fetch.
struct Caller {
  std::string host{}, origin{};
  std::string fetch_site{}, fetch_mode{}, fetch_dest{};
  bool gets_front_page = false;  // GET of "/", which other pages may link to
};

// Empty when the request may be answered, else a sentence.
std::string fault_of_caller(const Caller& caller, int port);

// For every answer: what a page of this server may load, and who may look at it.
inline constexpr const char* kContentSecurityPolicy =
    "default-src 'self'; img-src 'self' blob: data:; worker-src 'self' blob:; media-src 'self' blob: mediastream:; "
    "object-src 'none'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'";

}  // namespace faceprobe::serve
