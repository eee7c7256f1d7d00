#include "faceprobe/eval/earlier_rows.h"

#include "faceprobe/eval/paired_column.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace faceprobe::eval {
namespace {

constexpr const char* kNote = "earlier";
// Of a value. The same faces, made and measured on another processor, differ by 1.5e-5 at most in 17 tables; other faces by tenths.
constexpr double kSame = 1e-4;
constexpr std::string_view kSentence = "These figures are an earlier version's.";  // ends the text of a whole section

template <class Items, class Key>
auto find_by(Items& items, Key key, const std::string& wanted) {
  return std::ranges::find_if(items, [&](const auto& item) { return item.*key == wanted; });
}

bool same_value(const std::optional<double>& a, const std::optional<double>& b) {
  if (!a || !b) return !a && !b;
  return std::abs(*a - *b) <= kSame * std::max(std::abs(*a), std::abs(*b));
}

// Each column's place in `earlier`, or nothing. Differences to ours are those to another version of ours there.
std::vector<std::optional<std::size_t>> places_in(const ReportTable& table, const ReportTable& earlier) {
  std::vector<std::optional<std::size_t>> places;
  for (const std::string& column : table.columns) {
    // Such means and differences are over what the rows of one run answered, and hold for no other's.
    const auto found = is_common_column(column) || column == kDifferenceColumn
                           ? earlier.columns.end()
                           : std::ranges::find(earlier.columns, column);
    places.push_back(found == earlier.columns.end()
                         ? std::nullopt
                         : std::optional(static_cast<std::size_t>(found - earlier.columns.begin())));
  }
  return places;
}

ReportTable::Row in_columns(const ReportTable::Row& row, const std::vector<std::optional<std::size_t>>& places) {
  ReportTable::Row out{.name = row.name, .ours = row.ours, .note = row.note, .bound = row.bound};
  for (const std::optional<std::size_t>& place : places) {
    out.values.push_back(place && *place < row.values.size() ? row.values[*place] : std::nullopt);
    out.intervals.push_back(place && *place < row.intervals.size() ? row.intervals[*place] : std::nullopt);
  }
  return out;
}

// Whether some row that says anything is the same in both.
bool same_photos(const ReportTable& table, const ReportTable& earlier,
                 const std::vector<std::optional<std::size_t>>& places) {
  return std::ranges::any_of(table.rows, [&](const ReportTable::Row& row) {
    const auto before = find_by(earlier.rows, &ReportTable::Row::name, row.name);
    if (before == earlier.rows.end()) return false;
    const ReportTable::Row other = in_columns(*before, places);
    bool says_something = false;
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (!places[k]) continue;
      const std::optional<double> value = k < row.values.size() ? row.values[k] : std::nullopt;
      if (!same_value(value, other.values[k])) return false;
      says_something = says_something || (value && *value != 0);
    }
    return says_something;
  });
}

void add_rows(ReportTable& table, const ReportTable& earlier, std::set<std::string>& taken) {
  const std::vector<std::optional<std::size_t>> places = places_in(table, earlier);
  if (!same_photos(table, earlier, places)) return;
  for (const ReportTable::Row& row : earlier.rows) {
    if (find_by(table.rows, &ReportTable::Row::name, row.name) != table.rows.end()) continue;
    ReportTable::Row added = in_columns(row, places);
    if (!is_earlier(added)) added.note += added.note.empty() ? kNote : std::string(", ") + kNote;
    // Means over fewer photos are not the best of a column, as in table_of().
    if (added.note.find("missing") != std::string::npos) table.better.assign(table.columns.size(), Better::kNeither);
    taken.insert(added.name);
    table.rows.push_back(std::move(added));
  }
}

// Whether a table of `section` still lacks a row that its earlier one has.
bool still_missing(const std::string& name, const ReportSection& section, const ReportSection& earlier) {
  return std::ranges::any_of(section.tables, [&](const ReportTable& table) {
    const auto old = find_by(earlier.tables, &ReportTable::title, table.title);
    return old != earlier.tables.end() && find_by(old->rows, &ReportTable::Row::name, name) != old->rows.end() &&
           find_by(table.rows, &ReportTable::Row::name, name) == table.rows.end();
  });
}

// The sentence "No row of NAME: ...".
void forget_missing(const std::string& name, std::string& missing) {
  const std::size_t begin = missing.find("No row of " + name + ":");
  if (begin == std::string::npos) return;
  const std::size_t end = missing.find(". ", begin);
  missing.erase(begin, end == std::string::npos ? end : end + 2 - begin);
  while (!missing.empty() && missing.back() == ' ') missing.pop_back();
}

std::string listed(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : "; ") + name;
  return text;
}

}  // namespace

bool is_earlier(const ReportTable::Row& row) { return std::string_view(row.note).ends_with(kNote); }

bool is_earlier(const ReportSection& section) { return std::string_view(section.text).ends_with(kSentence); }

std::set<std::string> add_earlier_rows(PaperReport& report, const PaperReport& earlier) {
  std::set<std::string> all;
  for (ReportSection& section : report.sections) {
    const auto before = find_by(earlier.sections, &ReportSection::id, section.id);
    if (before == earlier.sections.end()) continue;
    std::set<std::string> taken;
    for (ReportTable& table : section.tables) {
      const auto old = find_by(before->tables, &ReportTable::title, table.title);
      if (old != before->tables.end()) add_rows(table, *old, taken);
    }
    if (taken.empty()) continue;
    for (const std::string& name : taken) {
      if (!still_missing(name, section, *before)) forget_missing(name, section.missing);
    }
    section.text +=
        "\n\nRows marked as earlier were measured on the same photos by an earlier version: " + listed(taken) + ".";
    all.insert(taken.begin(), taken.end());
  }
  return all;
}

std::vector<std::string> add_earlier_sections(PaperReport& report, const PaperReport& earlier) {
  std::vector<std::string> added;
  std::vector<ReportSection> ordered;
  for (const ReportSection& before : earlier.sections) {
    const auto now = find_by(report.sections, &ReportSection::id, before.id);
    if (now != report.sections.end()) {
      ordered.push_back(std::move(*now));
      report.sections.erase(now);
      continue;
    }
    ordered.push_back(before);
    std::string& text = ordered.back().text;
    if (!is_earlier(before)) text.append(text.empty() ? "" : "\n\n").append(kSentence);
    added.push_back(before.title);
  }
  std::move(report.sections.begin(), report.sections.end(), std::back_inserter(ordered));
  report.sections = std::move(ordered);
  return added;
}

}  // namespace faceprobe::eval
