// bench_direction --data DIR [--every N] [--set yale|london] [--weights FILE] [...]: how well known light directions come back from real faces.
// DIR/real/yaleB holds faces under one flash each, whose direction the database gives; DIR/real/portraits/london the same three
// studio lights on every person, measured from the reflections in their eyes. Prints one Markdown table per set.

#include "direction/direction.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>

std::vector<double> faceprobe::bench::answers(const eval::ScoreTable& scores, const std::string& metric,
                                              const eval::Selection& rows) {
  std::vector<double> values = scores.known_values(metric, rows);
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  return values;
}

int main(int argc, char** argv) {
  CLI::App app("Angles between estimated and known lights");
  std::string data;
  std::string set = "all";
  int every = 3;
  std::string weights;
  std::string prior;
  faceprobe::pipeline::EstimateOptions base;
  app.add_option("--data", data, "data folder (docs/data.md)")->required();
  app.add_option("--every", every, "use every n-th flash picture and every n-th person only")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--set", set, "yale, london or all")
      ->capture_default_str()
      ->check(CLI::IsMember({"yale", "london", "all"}));
  app.add_option("--weights", weights, "weights of the network in place of those that come with the program");
  app.add_option("--prior-weights", prior, "weights of the light prior, likewise");
  app.add_option("--highlight-weight", base.solve.highlight_weight, "of the transport solver")->capture_default_str();
  app.add_option("--least-shown", base.least_shown, "share of a face below which no network is asked")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    base.weights = weights;
    base.prior_weights = prior;
    const std::filesystem::path real = std::filesystem::path(data) / "real";
    for (const char* folder : {"yaleB", "portraits/london"}) {
      const bool yale = folder == std::string("yaleB");
      if (set != "all" && (set == "yale") != yale) continue;
      if (!std::filesystem::is_directory(real / folder)) {
        std::printf("real/%s is not in the data folder; skipped.\n", folder);
      } else if (yale) {
        faceprobe::bench::report_yale(real / folder, every, base);
      } else {
        faceprobe::bench::report_london(real / folder, every, base);
      }
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
  return 0;
}
