#include "paper/print_pdf.h"

#include "run_program.h"

#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <vector>

namespace faceprobe::cli {

namespace {

namespace fs = std::filesystem;

bool on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (!folder.empty() && access((fs::path(folder) / program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

std::vector<std::string> command_for(const std::string& program, const fs::path& html, const fs::path& pdf) {
  if (program == "weasyprint") return {program, html.string(), pdf.string()};
  std::vector<std::string> words = {program, "--headless", "--disable-gpu", "--no-pdf-header-footer",
                                    "--print-to-pdf=" + pdf.string()};
  if (geteuid() == 0)
    words.emplace_back("--no-sandbox");  // its sandbox does not work for root; the page is our own and without scripts
  words.push_back("file://" + html.string());
  return words;
}

}  // namespace

std::string print_pdf(const fs::path& html, const fs::path& pdf) {
  constexpr int kLimit_s = 300;
  for (const char* program : {"chromium", "chromium-browser", "google-chrome", "weasyprint"}) {
    if (!on_path(program)) continue;
    const fs::path log = fs::path(pdf).replace_extension(".log");
    const std::string failure = run_program(command_for(program, fs::absolute(html), fs::absolute(pdf)), log, kLimit_s);
    if (failure.empty() && fs::exists(pdf)) {
      fs::remove(log);
      return {};
    }
    return std::string(program) + " made no PDF (" + (failure.empty() ? "no file" : failure) + "); see " +
           log.string() + ".";
  }
  return "there is no PDF: none of chromium, google-chrome and weasyprint is installed. report.html prints as one.";
}

}  // namespace faceprobe::cli
