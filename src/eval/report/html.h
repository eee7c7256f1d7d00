#pragma once
// Internal: texts into HTML that is well-formed XML as well.

#include <string>
#include <vector>

namespace faceprobe::eval {

// <, >, &, " and ' as entities, for content and attributes alike; control characters, which XML does not have, as U+FFFD.
std::string escaped_html(const std::string& text);
// Blocks between empty lines, without the line breaks around them.
std::vector<std::string> paragraphs_of(const std::string& text);
// "<p>...</p>" for each of them.
std::string html_paragraphs(const std::string& text, const std::string& look = {});
// Letters, digits, "-" and "_" of `wish`, others as "-"; never empty, never the same twice for one `taken`.
std::string unique_id(const std::string& wish, std::vector<std::string>& taken);
// The style sheet of a report: light on paper, light or dark on a screen. No "<" and no "&", so that it may stand in XML.
std::string report_style();

}  // namespace faceprobe::eval
