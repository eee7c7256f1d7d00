#include "eval/report/html.h"

#include <algorithm>

namespace faceprobe::eval {

std::string escaped_html(const std::string& text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '&': out += "&amp;"; break;
      case '"': out += "&quot;"; break;
      case '\'': out += "&#39;"; break;
      case '\n':
      case '\t': out += c; break;
      default:
        if (static_cast<unsigned char>(c) < ' ') {
          out += "\uFFFD";
        } else {
          out += c;
        }
    }
  }
  return out;
}

std::vector<std::string> paragraphs_of(const std::string& text) {
  std::vector<std::string> out(1);
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) end = text.size();
    std::string line = text.substr(begin, end - begin);
    if (line.ends_with('\r')) line.pop_back();
    begin = end + 1;
    if (line.find_first_not_of(" \t") == std::string::npos) {
      if (!out.back().empty()) out.emplace_back();
    } else {
      if (!out.back().empty()) out.back() += '\n';
      out.back() += line;
    }
  }
  if (out.back().empty()) out.pop_back();
  return out;
}

std::string html_paragraphs(const std::string& text, const std::string& look) {
  std::string out;
  for (const std::string& paragraph : paragraphs_of(text)) {
    out += (look.empty() ? "<p>" : "<p class=\"" + look + "\">") + escaped_html(paragraph) + "</p>\n";
  }
  return out;
}

std::string unique_id(const std::string& wish, std::vector<std::string>& taken) {
  std::string base;
  for (const char c : wish) {
    const bool kept = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    base += kept ? c : '-';
  }
  // An XML name begins with a letter.
  const bool letter = !base.empty() && ((base[0] >= 'a' && base[0] <= 'z') || (base[0] >= 'A' && base[0] <= 'Z'));
  if (!letter) base = "section" + (base.empty() ? base : '-' + base);
  std::string id = base;
  for (int n = 2; std::find(taken.begin(), taken.end(), id) != taken.end(); ++n) id = base + '-' + std::to_string(n);
  taken.push_back(id);
  return id;
}

}  // namespace faceprobe::eval
