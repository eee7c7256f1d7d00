// The report as one page of HTML.
#include "faceprobe/eval/paper_report.h"

#include "eval/report/html.h"
#include "eval/report/svg_plot.h"
#include "eval/report/table_cells.h"
#include "faceprobe/io/picture_file.h"

namespace faceprobe::eval {
namespace {

std::string element(const std::string& name, const std::string& text) {
  return '<' + name + '>' + escaped_html(text) + "</" + name + '>';
}

std::string arrow(Better better) {
  switch (better) {
    case Better::kLower: return "\u00a0<abbr title=\"lower is better\">\u2193</abbr>";
    case Better::kHigher: return "\u00a0<abbr title=\"higher is better\">\u2191</abbr>";
    default: return {};
  }
}

// Intervals have a column of their own, so that values stand one below the other.
std::vector<bool> interval_columns(const std::vector<std::vector<TableCell>>& cells, std::size_t columns) {
  std::vector<bool> out(columns, false);
  for (const std::vector<TableCell>& row : cells) {
    for (std::size_t i = 0; i < columns; ++i) out[i] = out[i] || !row[i].interval.empty();
  }
  return out;
}

std::string html_cell(const TableCell& cell, bool has_interval) {
  const std::string value = cell.best ? "<strong>" + cell.value + "</strong>" : cell.value;
  if (!has_interval) return "<td>" + value + "</td>";
  return "<td class=\"of\">" + value + "</td><td class=\"range\">" + cell.interval + "</td>";
}

std::string html_table(const ReportTable& table) {
  const std::vector<std::vector<TableCell>> cells = table_cells(table);
  const std::vector<bool> intervals = interval_columns(cells, table.columns.size());
  std::string out = "<div class=\"wide\"><table>\n<caption>" + escaped_html(table.title) +
                    "</caption>\n<thead><tr><th scope=\"col\">" + escaped_html(table.names_are) + "</th>";
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    out += intervals[i] ? "<th scope=\"col\" colspan=\"2\">" : "<th scope=\"col\">";
    out += escaped_html(table.columns[i]) + arrow(better_of(table, i)) + "</th>";
  }
  out += "</tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const ReportTable::Row& row = table.rows[i];
    out += (row.ours ? "<tr class=\"ours\"><th scope=\"row\">" : "<tr><th scope=\"row\">") + escaped_html(row.name);
    if (const std::string marks = marks_of(row); !marks.empty()) out += ' ' + element("small", marks);
    out += "</th>";
    for (std::size_t column = 0; column < cells[i].size(); ++column) {
      out += html_cell(cells[i][column], intervals[column]);
    }
    out += "</tr>\n";
  }
  out += "</tbody></table></div>\n";
  if (table.rows.empty()) out += "<p class=\"note\">This table has no rows.</p>\n";
  return out + html_paragraphs(table.note, "note");
}

std::string html_plot(const ReportPlot& plot, const std::string& id) {
  return "<figure class=\"plot\">\n" + element("figcaption", plot.title) + '\n' + svg_plot(plot, id) +
         html_paragraphs(plot_note(plot), "note") + "</figure>\n";
}

std::string html_picture(const ReportPicture& picture) {
  std::string out = "<figure class=\"picture\">\n" + element("figcaption", picture.title) + '\n';
  if (picture.picture.empty()) {
    out += "<p class=\"note\">There is no picture.</p>\n";
  } else {
    out += "<img alt=\"" + escaped_html(picture.title) + "\" width=\"" + std::to_string(picture.picture.width()) +
           "\" height=\"" + std::to_string(picture.picture.height()) + "\" src=\"" + io::png_data_uri(picture.picture) +
           "\"/>\n";
  }
  return out + html_paragraphs(picture.caption, "note") + "</figure>\n";
}

bool is_empty(const ReportSection& section) {
  return section.tables.empty() && section.plots.empty() && section.pictures.empty();
}

std::string html_section(const ReportSection& section, const std::string& id, std::vector<std::string>& ids) {
  std::string out = "<section id=\"" + id + "\">\n" + element("h2", section.title) + '\n';
  out += html_paragraphs(section.text) + html_paragraphs(section.notes);
  if (!section.command.empty()) out += "<p class=\"command\">Made by " + element("code", section.command) + "</p>\n";
  if (!section.missing.empty()) {
    out += "<p class=\"missing\"><strong>Not here:</strong> " + escaped_html(section.missing) + "</p>\n";
  } else if (is_empty(section)) {
    out += "<p class=\"note\">This section has no tables, plots or pictures.</p>\n";
  }
  for (const ReportTable& table : section.tables) out += html_table(table);
  for (const ReportPlot& plot : section.plots) out += html_plot(plot, unique_id(id + "-plot", ids));
  for (const ReportPicture& picture : section.pictures) out += html_picture(picture);
  return out + "</section>\n";
}

std::string contents(const PaperReport& report, const std::vector<std::string>& ids) {
  if (report.sections.empty()) return "<p class=\"note\">This report has no sections.</p>\n";
  std::string out = "<nav aria-label=\"Contents\">\n<ol>\n";
  for (std::size_t i = 0; i < report.sections.size(); ++i) {
    const ReportSection& section = report.sections[i];
    out += "<li><a href=\"#" + ids[i] + "\">" + escaped_html(section.title.empty() ? ids[i] : section.title) + "</a>";
    if (!section.missing.empty()) out += is_empty(section) ? " (not here)" : " (in part)";
    out += "</li>\n";
  }
  return out + "</ol>\n</nav>\n";
}

// How the tables are read, and the words in them.
std::string html_head(const PaperReport& report) {
  std::string out;
  if (std::string text = how_to_read(report); !text.empty()) {
    text += " An arrow at a column says whether lower (\u2193) or higher (\u2191) is better.";
    out += html_paragraphs(text, "read");
  }
  if (report.terms.empty()) return out;
  out += "<dl class=\"read\">\n";
  for (const auto& [term, meaning] : report.terms) out += element("dt", term) + element("dd", meaning) + '\n';
  return out + "</dl>\n";
}

}  // namespace

std::string report_html(const PaperReport& report) {
  std::vector<std::string> ids;
  for (const ReportSection& section : report.sections) unique_id(section.id, ids);
  const std::vector<std::string> section_ids = ids;
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">\n<head>\n<meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n" +
      element("title", report.title) + "\n<style>" + report_style() + "</style>\n</head>\n<body>\n<header>\n" +
      element("h1", report.title) + '\n' + html_paragraphs(report.made_with) + contents(report, section_ids) +
      html_head(report) + "</header>\n<main>\n";
  for (std::size_t i = 0; i < report.sections.size(); ++i) out += html_section(report.sections[i], section_ids[i], ids);
  return out + "</main>\n</body>\n</html>\n";
}

}  // namespace faceprobe::eval
