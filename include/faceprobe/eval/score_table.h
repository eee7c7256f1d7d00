#pragma once
// The figures of an evaluation: one row for each method and picture, from which come the means, intervals and tables of a
// report. It computes no metric (see eval/image_metrics.h) and writes no file: the texts are strings.
//
//   eval::ScoreTable table;
//   table.add({.method = "yang", .sample = "0001", .groups = {{"skin", "tan"}}, .metrics = {{"rmse", 7.8}, {"ssim", .91}}});
//   ...
//   std::cout << table.markdown("rmse") << table.markdown_by_group("rmse", "skin");
//   const eval::Summary yang = table.summary("rmse", {.method = "yang", .group = "skin", .label = "tan"});

#include "faceprobe/eval/statistics.h"

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::eval {

struct ScoreRow {
  std::string method;
  std::string sample;
  std::map<std::string, std::string> groups = {};  // kind of group -> this sample's label: {"skin", "tan"}
  std::map<std::string, double> metrics = {};      // name -> value; NaN where the method failed
  // Whom the sample shows, by any name: intervals draw people, not samples (statistics.h). Empty: somebody whom no other sample shows.
  std::string person = {};
};

// Which rows to look at. An empty method or group stands for all.
struct Selection {
  std::string method = {};
  std::string group = {};
  std::string label = {};  // of `group`
};

class ScoreTable {
 public:
  // `bootstrap` is for every interval of the table.
  explicit ScoreTable(const Bootstrap& bootstrap = {}) : bootstrap_(bootstrap) {}

  // Throws std::invalid_argument when the method or the sample has no name, the pair is there already, or a group and a
  // metric would share a column's name ("method", "sample" and "person" are taken).
  void add(ScoreRow row);
  // The order in which tables show the labels of a group; labels it does not name follow by name.
  void order_labels(const std::string& group, std::vector<std::string> labels);

  // Texts then tell each method's difference to this one too; one that has no rows is ignored, and so is an empty name.
  void compare_with(std::string method) { reference_ = std::move(method); }

  const std::vector<ScoreRow>& rows() const { return rows_; }
  std::vector<std::string> methods() const;  // in the order they came
  const std::set<std::string>& groups() const { return groups_; }
  const std::set<std::string>& metrics() const { return metrics_; }
  std::vector<std::string> labels(const std::string& group) const;  // those that occur, in the order of the tables

  // One value for each selected row, in order; NaN where the row has none of this metric.
  std::vector<double> values(const std::string& metric, const Selection& selection = {}) const;
  // The same without the rows that have none of this metric.
  std::vector<double> known_values(const std::string& metric, const Selection& selection = {}) const;
  // Whose each of these values is; where the row does not say, the sample's name.
  std::vector<std::string> known_persons(const std::string& metric, const Selection& selection = {}) const;
  // Of the known values: where a row has none of this metric nothing is missing. The interval draws people.
  Summary summary(const std::string& metric, const Selection& selection = {}) const;
  // Of the differences, sample by sample, of the known values to those of the method `than`: positive where the selected rows have more. A sample that
  // one of the two did not answer is missing. Two methods err on the same hard samples, so this interval, which draws people as well, tells them
  // apart where their own intervals overlap. Throws std::invalid_argument for a selection without a method.
  Summary difference(const std::string& metric, const std::string& than, const Selection& selection) const;
  Histogram histogram(const std::string& metric, const Selection& selection, double low, double high, int bins) const;

  // One line a row: method, sample, person, groups, metrics; RFC 4180; missing values are empty, numbers read back exactly.
  std::string csv() const;
  // {"bootstrap": {...}, "rows": [...], "summaries": [...]}: a summary for each metric and method, over all rows and for
  // each label; missing values are null. After compare_with() those of other methods have "minus": the difference with its interval. Bytes that are not UTF-8 are replaced.
  std::string json() const;
  // Tables for a report: one line a method. Missing values are told beside the count, and people where they are fewer. After
  // compare_with() there is a column of differences.
  std::string markdown(const std::string& metric, int decimals = 3) const;
  // Mean and interval of each label, one column a label.
  std::string markdown_by_group(const std::string& metric, const std::string& group, int decimals = 3) const;

 private:
  // Whether texts tell differences.
  bool compares() const;

  Bootstrap bootstrap_;
  std::string reference_;
  std::vector<ScoreRow> rows_;
  std::set<std::pair<std::string, std::string>> known_;  // method, sample
  std::set<std::string> groups_;
  std::set<std::string> metrics_;
  std::map<std::string, std::vector<std::string>> label_order_;
};

}  // namespace faceprobe::eval
