#pragma once
// Who may ask. The server listens on the loopback address alone, but any page in the user's browser can send requests there: names that were
// bent to 127.0.0.1 come with their own Host (DNS rebinding), scripts and forms of other pages with their own Origin.

#include <string>

namespace faceprobe::serve {

// Empty when the request may be answered, else a sentence. `host`, `origin`: the headers' values, empty where there are none.
std::string fault_of_caller(const std::string& host, const std::string& origin, int port);

// For every answer: what a page of this server may load, and who may look at it.
inline constexpr const char* kContentSecurityPolicy =
    "default-src 'self'; img-src 'self' blob: data:; worker-src 'self' blob:; media-src 'self' blob: mediastream:; "
    "object-src 'none'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'";

}  // namespace faceprobe::serve
