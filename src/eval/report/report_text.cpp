// The report's tables as Markdown and as CSV.
#include "eval/csv_text.h"
#include "eval/markdown.h"
#include "eval/report/html.h"
#include "eval/report/table_cells.h"
#include "faceprobe/eval/paper_report.h"

#include <optional>
#include <string>

namespace faceprobe::eval {
namespace {

std::string block(const std::string& text) { return text.empty() ? "" : text + "\n\n"; }

std::string joined_paragraphs(const std::string& text) {
  std::string out;
  for (const std::string& paragraph : paragraphs_of(text)) out += block(paragraph);
  return out;
}

std::string one_line(std::string text) {
  for (char& c : text) c = c == '\n' || c == '\r' ? ' ' : c;
  return text;
}

// A text that has a backtick itself needs two around it.
std::string code(const std::string& text) {
  const std::string fence = text.find('`') == std::string::npos ? "`" : "``";
  return fence + one_line(text) + fence;
}

std::string markdown_table(const ReportTable& table) {
  std::string out = table.title.empty() ? "" : "### " + one_line(table.title) + "\n\n";
  if (table.rows.empty()) return out + "This table has no rows.\n\n" + joined_paragraphs(table.note);
  std::vector<std::string> titles = {table.names_are};
  titles.insert(titles.end(), table.columns.begin(), table.columns.end());
  out += markdown_head(titles);
  const std::vector<std::vector<TableCell>> cells = table_cells(table);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const ReportTable::Row& row = table.rows[i];
    out += "| " + markdown_cell(row.name) + (row.note.empty() ? "" : " (" + markdown_cell(row.note) + ')') + " |";
    for (const TableCell& cell : cells[i]) {
      out += ' ' + (cell.best ? "**" + cell.value + "**" : cell.value);
      out += (cell.interval.empty() ? "" : ' ' + cell.interval) + " |";
    }
    out += '\n';
  }
  return out + '\n' + joined_paragraphs(table.note);
}

std::string exact_or_nothing(const std::optional<double>& value) { return value ? exact(*value) : std::string(); }

std::string csv_rows(const ReportSection& section, const ReportTable& table) {
  table_cells(table);  // refuses what does not fit
  std::string out;
  for (const ReportTable::Row& row : table.rows) {
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
      const auto interval = interval_at(row, column);
      out += csv_cell(section.id) + ',' + csv_cell(table.title) + ',' + csv_cell(row.name) + ',' +
             csv_cell(table.columns[column]) + ',' + exact_or_nothing(value_at(row, column));
      out += interval ? ',' + exact(interval->first) + ',' + exact(interval->second) : ",,";
      out += "\r\n";
    }
  }
  return out;
}

}  // namespace

std::string report_markdown(const PaperReport& report) {
  std::string out = report.title.empty() ? "" : "# " + one_line(report.title) + "\n\n";
  out += joined_paragraphs(report.made_with);
  for (const ReportSection& section : report.sections) {
    out += "## " + one_line(section.title) + "\n\n" + joined_paragraphs(section.text);
    if (!section.command.empty()) out += code(section.command) + "\n\n";
    if (!section.missing.empty()) out += "> Not here: " + one_line(section.missing) + "\n\n";
    for (const ReportTable& table : section.tables) out += markdown_table(table);
  }
  if (out.ends_with("\n\n")) out.pop_back();
  return out;
}

std::string report_csv(const PaperReport& report) {
  std::string out = "section,table,row,column,value,low,high\r\n";
  for (const ReportSection& section : report.sections) {
    for (const ReportTable& table : section.tables) out += csv_rows(section, table);
  }
  return out;
}

}  // namespace faceprobe::eval
