#pragma once
// Internal: what a method wrote for a case, kept from one run of the benchmark to the next.
//
//   CaseEntry entry("out/cache", case_hash(folder), method.identity);
//   if (!entry.finished_seconds()) { entry.begin(); run(entry.out()); entry.finish(3.2); }

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace faceprobe::eval {

// What a result came to, where the case knows the truth.
struct CaseFigures {
  bool has_light = false;               // whether the method wrote a map ...
  bool has_highlight = false;           // ... and a layer
  std::map<std::string, double> light;  // empty: the truth is not known
  std::map<std::string, double> highlight;
};

class CaseEntry {
 public:
  CaseEntry(const std::filesystem::path& work, const std::string& case_hash, const std::string& identity);

  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path out() const { return folder_ / "out"; }
  std::filesystem::path log() const { return folder_ / "log.txt"; }

  // How long the run took that is kept here; nothing when none came to its end.
  std::optional<double> finished_seconds() const;
  // Empties the folder. Throws Error(kOutput), as finish() does.
  void begin() const;
  // `method`, `sample`: for people who look into the folder.
  void finish(const std::string& method, const std::string& sample, double seconds) const;

  // Those of a finished run; nothing when they are of another scoring. `scoring` empty: never any.
  std::optional<CaseFigures> figures(const std::string& scoring) const;
  void keep(const CaseFigures& figures, const std::string& scoring) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace faceprobe::eval
