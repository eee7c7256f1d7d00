// The report's tables as Markdown and as CSV.
#include "eval/csv_text.h"
#include "eval/markdown.h"
#include "eval/report/html.h"
#include "eval/report/table_cells.h"
#include "faceprobe/eval/earlier_rows.h"
#include "faceprobe/eval/paper_report.h"

#include <algorithm>
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
    const std::string marks = marks_of(row);
    out += "| " + markdown_cell(row.name) + (marks.empty() ? "" : " (" + markdown_cell(marks) + ')') + " |";
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
    std::string marks = marks_of(row);
    if (is_earlier(section) && !is_earlier(row)) marks += marks.empty() ? "earlier" : ", earlier";
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
      const auto interval = interval_at(row, column);
      out += csv_cell(section.id) + ',' + csv_cell(table.title) + ',' + csv_cell(row.name) + ',' +
             csv_cell(table.columns[column]) + ',' + exact_or_nothing(value_at(row, column));
      out += interval ? ',' + exact(interval->first) + ',' + exact(interval->second) : ",,";
      out += ',' + csv_cell(marks) + "\r\n";
    }
  }
  return out;
}

template <class Test>
bool any_row(const PaperReport& report, const Test& test) {
  return std::ranges::any_of(report.sections, [&](const ReportSection& section) {
    return std::ranges::any_of(section.tables,
                               [&](const ReportTable& table) { return std::ranges::any_of(table.rows, test); });
  });
}

bool any_column(const PaperReport& report, bool (*test)(const std::string&)) {
  return std::ranges::any_of(report.sections, [&](const ReportSection& section) {
    return std::ranges::any_of(section.tables,
                               [&](const ReportTable& table) { return std::ranges::any_of(table.columns, test); });
  });
}

}  // namespace

std::string marks_of(const ReportTable::Row& row) {
  std::string marks = row.ours ? "ours" : "";
  if (row.bound) marks += marks.empty() ? "bound" : ", bound";
  if (!row.note.empty()) marks += (marks.empty() ? "" : ", ") + row.note;
  return marks;
}

std::string how_to_read(const PaperReport& report) {
  using Row = ReportTable::Row;
  if (!any_row(report, [](const Row&) { return true; })) return {};
  std::string text =
      "How to read the tables: the best value of a column is bold, where a column has a better and a worse. Brackets "
      "hold the 95 % interval of the mean by bootstrap. A - stands for what is missing, n is the number of values.";
  if (any_row(report, [](const Row& row) { return row.ours; }))
    text += " Rows marked \"ours\" are this program as it comes.";
  if (any_row(report, [](const Row& row) { return row.bound; })) {
    text +=
        " Rows marked \"bound\" were told a part of the truth: they show what could be reached, are no methods, and "
        "are never bold.";
  }
  if (any_row(report, [](const Row& row) { return is_earlier(row); })) {
    text += " Rows marked \"earlier\" were measured on the same photos by an earlier version.";
  }
  if (any_column(report, &is_common_column)) {
    text +=
        " Where methods have no answer to some photos, means over what each did answer do not compare; a column more "
        "has the means over those that all rows measured in one run answered, but for rows without any answer. Rows "
        "from an earlier run have none there.";
  }
  return text;
}

std::string report_markdown(const PaperReport& report) {
  std::string out = report.title.empty() ? "" : "# " + one_line(report.title) + "\n\n";
  out += joined_paragraphs(report.made_with) + block(how_to_read(report));
  for (const auto& [term, meaning] : report.terms) out += "- **" + one_line(term) + "**: " + one_line(meaning) + '\n';
  if (!report.terms.empty()) out += '\n';
  for (const ReportSection& section : report.sections) {
    out += "## " + one_line(section.title) + "\n\n" + joined_paragraphs(section.text);
    out += joined_paragraphs(section.notes);
    if (!section.command.empty()) out += code(section.command) + "\n\n";
    if (!section.missing.empty()) out += "> Not here: " + one_line(section.missing) + "\n\n";
    for (const ReportTable& table : section.tables) out += markdown_table(table);
  }
  if (out.ends_with("\n\n")) out.pop_back();
  return out;
}

std::string report_csv(const PaperReport& report) {
  std::string out = "section,table,row,column,value,low,high,marks\r\n";
  for (const ReportSection& section : report.sections) {
    for (const ReportTable& table : section.tables) out += csv_rows(section, table);
  }
  return out;
}

}  // namespace faceprobe::eval
