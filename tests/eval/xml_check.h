#pragma once
// Whether a text is well-formed XML, as far as pages need it: tags that nest and close, quoted attributes that come once, entities that XML has.

#include <cctype>
#include <set>
#include <string>
#include <vector>

namespace faceprobe::eval::testing {

class XmlCheck {
 public:
  // Empty when it is, else what is wrong and the text from there on.
  static std::string problem(const std::string& text) { return XmlCheck(text).run(); }

 private:
  explicit XmlCheck(const std::string& text) : text_(text) {}

  std::string run() {
    if (text_.rfind("<!DOCTYPE html>", 0) == 0) at_ = text_.find('>') + 1;
    while (at_ < text_.size()) {
      const std::string found = text_[at_] == '<' ? tag() : content();
      if (!found.empty()) return found + ": " + text_.substr(at_, 60);
    }
    if (!open_.empty()) return "never closed: " + open_.back();
    return roots_ == 1 ? "" : "there are " + std::to_string(roots_) + " roots";
  }

  std::string content() {
    const char c = text_[at_];
    if (open_.empty() && std::isspace(static_cast<unsigned char>(c)) == 0) return "text outside of all elements";
    return character();
  }

  std::string character() {
    const char c = text_[at_];
    if (static_cast<unsigned char>(c) < ' ' && c != '\n' && c != '\t' && c != '\r') return "a control character";
    if (c == '&') {
      static const std::set<std::string> kKnown = {"amp", "lt", "gt", "quot", "apos", "#39"};
      const std::size_t end = text_.find(';', at_);
      if (end == std::string::npos || !kKnown.contains(text_.substr(at_ + 1, end - at_ - 1)))
        return "an unknown entity";
      at_ = end;
    }
    ++at_;
    return {};
  }

  std::string name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '-'))
      ++at_;
    return text_.substr(begin, at_ - begin);
  }

  void skip_spaces() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }

  std::string tag() {
    ++at_;
    if (text_[at_] == '/') {
      ++at_;
      const std::string closed = name();
      if (open_.empty() || open_.back() != closed || text_[at_] != '>') return "a tag that closes nothing";
      open_.pop_back();
      ++at_;
      return {};
    }
    const std::string opened = name();
    if (opened.empty()) return "a < without a name";
    if (open_.empty()) ++roots_;
    if (const std::string found = attributes(); !found.empty()) return found;
    if (text_[at_] == '/') {
      ++at_;
    } else {
      open_.push_back(opened);
    }
    if (text_[at_] != '>') return "a tag without its end";
    ++at_;
    return {};
  }

  std::string attributes() {
    std::set<std::string> names;
    for (skip_spaces(); at_ < text_.size() && text_[at_] != '>' && text_[at_] != '/'; skip_spaces()) {
      const std::string attribute = name();
      if (attribute.empty() || !names.insert(attribute).second) return "an attribute without a name, or twice";
      if (text_.compare(at_, 2, "=\"") != 0) return "an attribute without a quoted value";
      at_ += 2;
      while (at_ < text_.size() && text_[at_] != '"') {
        if (text_[at_] == '<') return "a < in an attribute";
        if (const std::string found = character(); !found.empty()) return found;
      }
      ++at_;
    }
    return at_ < text_.size() ? "" : "a tag without its end";
  }

  const std::string& text_;
  std::size_t at_ = 0;
  std::vector<std::string> open_;
  int roots_ = 0;
};

}  // namespace faceprobe::eval::testing
