#pragma once
// The report's page as a PDF, by a browser that is there anyway: nothing prints HTML as they do.

#include <filesystem>
#include <string>

namespace faceprobe::cli {

// Why there is no PDF now; empty when there is. Looks for Chromium, Chrome and WeasyPrint on the PATH.
std::string print_pdf(const std::filesystem::path& html, const std::filesystem::path& pdf);

}  // namespace faceprobe::cli
