#pragma once
// A report of many measurements as one page: tables, plots and pictures in sections, written as one HTML file that needs nothing beside it and
// prints on A4, as JSON, CSV and Markdown. It measures nothing and writes no file: all that goes in and comes out are values and texts. For the
// figures themselves see eval/score_table.h.
//
//   eval::ReportSection sun{.id = "sun", .title = "Where the sun stands", .command = "faceprobe eval relight"};
//   sun.tables.push_back(eval::table_of(scores, "sun_centroid", "Error, degrees", 1, {"net"}));
//   sun.plots.push_back(eval::cumulative_of(scores, "sun_centroid", "Photos within an error", "degrees", {"net"}));
//   sun.pictures.push_back({.title = "Some photos", .picture = sheet});
//   io::write_file_atomically("report.html", eval::report_html({.title = "Report", .sections = {sun}}));
//
// The same input gives the same bytes. Texts are UTF-8; what is not is replaced in JSON. Numbers that are not finite count as missing everywhere.
// All that writes throws std::invalid_argument for a row of a table with more values than there are columns, and for a plot of kind kLines whose x
// are not as many as its values.

#include "faceprobe/core/image.h"
#include "faceprobe/eval/score_table.h"

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::eval {

enum class Better { kLower, kHigher, kNeither };  // which value of a column is the best

// One line a method, one column a figure. In columns that are lower or higher the better the best value is bold, as are those that look the
// same when rounded, unless there is only one. Rows that are bounds are never the best, and do not count for it.
struct ReportTable {
  struct Row {
    std::string name;
    std::vector<std::optional<double>> values = {};  // one a column; the rest are missing, shown as "-"
    std::vector<std::optional<std::pair<double, double>>> intervals = {};  // of the values: low, high
    bool ours = false;                                                     // set off from the others
    std::string note = {};                                                 // small, beside the name
    bool bound = false;  // was told a part of the truth: what could be reached, not a method to compare with

    bool operator==(const Row&) const = default;
  };

  std::string title;
  std::string note = {};             // below the table
  std::string names_are = "method";  // title of the column of names
  std::vector<std::string> columns = {};
  std::vector<Row> rows = {};
  std::vector<int> decimals = {};   // of each column, 0..17; 3 where there is none
  std::vector<Better> better = {};  // of each column; kNeither where there is none

  bool operator==(const ReportTable&) const = default;
};

enum class PlotKind {
  kHistogram,   // one panel a series, bins of one width shared by all
  kCumulative,  // share of the values that are not above x, with a mark at 75 %
  kBars,        // one lying bar a value, from 0
  kLines,       // y over x
};

// What one method has in a plot.
struct ReportSeries {
  std::string name;
  // kHistogram and kCumulative: one a sample. kBars: one, or one for each of the plot's groups. kLines: y.
  std::vector<double> values = {};
  std::vector<double> x = {};                                            // kLines alone: as many as values
  std::vector<std::optional<std::pair<double, double>>> intervals = {};  // kBars and kLines: low and high of each value
  bool ours = false;                                                     // drawn above the others

  bool operator==(const ReportSeries&) const = default;
};

struct ReportPlot {
  std::string title;
  std::string x_label = {};  // of the axis that lies: the unit of the values, but for kLines
  std::string y_label = {};  // kHistogram and kCumulative have one of their own for an empty one; kBars has none
  PlotKind kind = PlotKind::kHistogram;
  std::vector<ReportSeries> series = {};
  std::vector<std::string> groups = {};  // kBars: what its values stand for, skin tones say
  // Where the axis of x ends, in its unit; empty: where the values do. What lies beyond is counted below the plot. Not for kBars.
  std::optional<double> x_low = {}, x_high = {};
  // kCumulative: missing values count as larger than all others, instead of being left out. A method that fails has a curve that ends below 100 %.
  bool missing_are_largest = false;

  bool operator==(const ReportPlot&) const = default;
};

struct ReportPicture {
  std::string title;
  std::string caption = {};
  ByteImage picture = {};  // sRGB, 1, 3 or 4 channels, any size

  bool operator==(const ReportPicture&) const = default;
};

struct ReportSection {
  std::string id;            // for links to it; letters, digits, "-" and "_" are kept
  std::string title;         // its heading
  std::string text = {};     // plain; an empty line begins a paragraph
  std::string notes = {};    // the same, below it: what to know before the figures are compared
  std::string command = {};  // what prints these figures
  std::vector<ReportTable> tables = {};
  std::vector<ReportPlot> plots = {};
  std::vector<ReportPicture> pictures = {};
  std::string missing = {};  // what is not there and why; shown in a box

  bool operator==(const ReportSection&) const = default;
};

struct PaperReport {
  std::string title;
  std::string made_with = {};                                   // version, date, data; an empty line begins a paragraph
  std::vector<std::pair<std::string, std::string>> terms = {};  // a word of the tables, and what it means; at the head
  std::vector<ReportSection> sections = {};

  bool operator==(const PaperReport&) const = default;
};

// The whole page: HTML that is well-formed XML too, style sheet, plots and pictures inside, no scripts. Throws Error(kUsage) for a picture of
// another number of channels.
std::string report_html(const PaperReport& report);
// Tables and the plots' values; of a picture its title, caption and size. Missing values are null. What earlier versions did not write (terms,
// notes of sections, bounds) may be missing when it is read.
std::string report_json(const PaperReport& report);
// The same report but for its pictures, which are empty; numbers to the last digit. Throws Error(kInput) for any other text.
PaperReport report_from_json(const std::string& text);
// Every value of the tables, one a line: section, table, row, column, value, low, high, marks (those of marks_of()); RFC 4180, numbers read back
// exactly.
std::string report_csv(const PaperReport& report);
// Titles, texts, commands and tables, best values bold; sections are "##". Marks stand beside the names.
std::string report_markdown(const PaperReport& report);
// What is told beside a row's name: "ours", "bound" and its note, with commas between; empty where there is nothing.
std::string marks_of(const ReportTable::Row& row);
// What brackets, bold and marks mean, as far as `report` has them; empty for a report without tables.
std::string how_to_read(const PaperReport& report);

// One section with its pictures, to be kept and read again.
std::string section_json(const ReportSection& section);
// The same section to the last digit and pixel, but that numbers which are not finite come back as missing (NaN in plots). Throws
// Error(kInput) for any other text, also of another version of the program.
ReportSection section_from_json(const std::string& text);

// Columns "mean" with its interval, "median" and "n"; one row a method that has the metric. Rows of `scores` without it are left out, those where
// it is NaN are missing, and a method that has them says how many. Then there is a column more, common_column(): means over the samples that all
// methods answered, but for those that answered none; only these compare, and only the best of them is bold. `ours`: names of methods.
ReportTable table_of(const ScoreTable& scores, const std::string& metric, const std::string& title, int decimals = 3,
                     const std::set<std::string>& ours = {}, Better better = Better::kLower);
std::string common_column(std::size_t samples);  // "mean of the 17 that all of this run have"
// Also for the names that earlier versions gave it.
bool is_common_column(const std::string& column);
// The same rows: mean and interval of each label, one column a label, with the number of values beside the label, or by row where methods differ. No value of a label
// is bold where some method has values missing.
ReportTable table_by_group(const ScoreTable& scores, const std::string& metric, const std::string& group,
                           const std::string& title, int decimals = 3, const std::set<std::string>& ours = {},
                           Better better = Better::kLower);
// The values of every method; `unit` is the label of x.
ReportPlot histogram_of(const ScoreTable& scores, const std::string& metric, const std::string& title,
                        const std::string& unit, const std::set<std::string>& ours = {});
// The same values as the share of samples within x.
ReportPlot cumulative_of(const ScoreTable& scores, const std::string& metric, const std::string& title,
                         const std::string& unit, const std::set<std::string>& ours = {});
// One column a metric: means with their intervals, titled by the second of each pair. No value of a column is bold where some method has values
// missing, and such a method says how many at most.
ReportTable table_of_metrics(const ScoreTable& scores, const std::vector<std::pair<std::string, std::string>>& metrics,
                             const std::string& title, int decimals = 3, const std::set<std::string>& ours = {},
                             Better better = Better::kLower);
// Mean and interval of every method, over all rows or for each label of `group`.
ReportPlot bars_of(const ScoreTable& scores, const std::string& metric, const std::string& title,
                   const std::string& unit, const std::set<std::string>& ours = {}, const std::string& group = {});

}  // namespace faceprobe::eval
