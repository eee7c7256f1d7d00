#pragma once
// A list of figures, one a picture, in a few numbers. Values that are not finite are set aside and counted as missing: a
// method that fails on a picture must not look better for it.
//
// Several pictures of one person are not independent: an interval that takes them so is too narrow. Told whom each value is of, it draws people
// instead of pictures, each with all their pictures (cluster bootstrap: Davison & Hinkley 1997, section 3.8; Cameron, Gelbach & Miller 2008). Of few
// people, a dozen say, it is still somewhat narrow.
//
//   const eval::Summary s = eval::summarize(errors);            // of independent values
//   const eval::Summary t = eval::summarize(errors, persons);   // persons[i]: whom errors[i] is of
//   std::cout << s.mean << " [" << s.mean_low << ", " << s.mean_high << "], median " << s.median;

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::eval {

struct Bootstrap {
  std::uint64_t seed = 1;
  int resamples = 2000;  // >= 1
};

// In the unit of the values. All numbers are NaN where there are no values, the interval where there are fewer than two people.
struct Summary {
  std::size_t count = 0;    // finite values
  std::size_t people = 0;   // whom they are of; as many where nobody was told apart
  std::size_t missing = 0;  // the others
  double mean = 0;          // of the finite values, as all that follow
  double median = 0;        // between the two middle ones where there are two
  double p90 = 0;           // nine of ten values are below it: the bad end of an error, the good end of a similarity
  double mean_low = 0;      // 95 % interval of the mean: percentile bootstrap (Efron & Tibshirani 1993, chapter 13)
  double mean_high = 0;     // the interval's upper end
};

// The order of the values does not matter. Throws std::invalid_argument when bootstrap.resamples < 1.
Summary summarize(std::span<const double> values, const Bootstrap& bootstrap = {});
// The same with an interval that draws people. `persons`: one name a value, of any kind; an empty one is that of somebody who has no other value.
// Mean, median and p90 count each value alike, as before. Neither the order nor the names change the result. Throws std::invalid_argument when there
// are not as many names as values.
Summary summarize(std::span<const double> values, std::span<const std::string> persons, const Bootstrap& bootstrap = {});

// Ends of the 95 % percentile-bootstrap interval of any statistic, in its unit; `of` is given each list of draws and may reorder it. `values`
// ascend, so that the draws do not depend on the order in which they came. NaN twice for fewer than two values. Throws std::invalid_argument when
// bootstrap.resamples < 1.
std::pair<double, double> bootstrap_interval(std::span<const double> values, const Bootstrap& bootstrap,
                                             const std::function<double(std::span<double>)>& of);

// One list of values for each person; lists ascend, and so do they among themselves.
using ValuesByPerson = std::vector<std::vector<double>>;
// The finite ones of `values` by whom they are of. Names as for summarize().
ValuesByPerson values_by_person(std::span<const double> values, std::span<const std::string> persons);
// The same as bootstrap_interval(), but drawing as many lists as there are; `of` is given all values of those drawn. NaN twice for fewer than two.
std::pair<double, double> cluster_interval(const ValuesByPerson& people, const Bootstrap& bootstrap,
                                           const std::function<double(std::span<double>)>& of);

// p in [0, 1]; linear between the two nearest ranks; NaN for an empty list. `sorted` ascends.
double quantile_of_sorted(std::span<const double> sorted, double p);

// Bins of one width over [low, high]; a value on a border belongs to the bin above it, `high` itself to the last.
struct Histogram {
  double low = 0;                   // in the unit of the values
  double high = 0;                  // the same
  std::vector<std::size_t> counts;  // from low to high
  std::size_t below = 0;            // values under `low`
  std::size_t above = 0;            // values over `high`
};
// NaN is left out. Throws std::invalid_argument unless low < high, both finite, and bins >= 1.
Histogram histogram(std::span<const double> values, double low, double high, int bins);

}  // namespace faceprobe::eval
