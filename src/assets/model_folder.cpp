#include "assets/model_folder.h"

#include "faceprobe/io/data_files.h"

#include <assimp/MemoryIOWrapper.h>
#include <algorithm>
#include <charconv>

namespace faceprobe::assets {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMaxMaterialBytes = 512 << 10;  // assimp keeps some 13 kB for every newmtl

bool is_inside(const fs::path& folder, const fs::path& path) {
  const auto [left, ignored] = std::ranges::mismatch(folder, path);
  return left == folder.end();
}

// "%20" to a space, as in URIs.
std::string decoded(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    int code = 0;
    if (text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(&text[i + 1], &text[i + 1] + 2, code, 16).ptr == &text[i + 1] + 2 && code > 0) {
      out += static_cast<char>(code);
      i += 2;
    } else {
      out += text[i];
    }
  }
  return out;
}

}  // namespace

fs::path find_companion(const ModelFile& file, const std::string& written, const std::string& what) {
  std::string text = written.substr(0, written.find('\0'));
  std::ranges::replace(text, '\\', '/');
  for (const std::string& spelling : {text, decoded(text)}) {
    std::error_code problem;
    fs::path found = fs::weakly_canonical(file.folder / spelling, problem);
    if (fs::path(spelling).is_absolute() || problem || !is_inside(file.folder, found)) {
      std::string text_of_fault = "names ";
      text_of_fault.append(what).append(" '").append(written);
      file.refuse(
          text_of_fault +
          "', which is outside its folder; only files in that folder or below it are read. Put it beside the model "
          "and name it without a path.");
    }
    if (fs::exists(found, problem) && !problem) return found;
  }
  return {};
}

bool FolderIo::is_model(const fs::path& path) const { return path == file_.path; }

bool FolderIo::Exists(const char* path) const {
  std::error_code problem;
  const fs::path found = fs::weakly_canonical(path, problem);
  return is_model(path) || (!problem && is_inside(file_.folder, found) && fs::is_regular_file(found, problem));
}

Assimp::IOStream* FolderIo::Open(const char* path, const char* mode) {
  if (mode == nullptr || mode[0] != 'r') return nullptr;
  const bool model = is_model(path);
  std::vector<std::byte> own;
  try {
    if (!model) {
      std::error_code problem;
      const fs::path relative = fs::path(path).lexically_proximate(file_.folder);
      const fs::path found = find_companion(file_, relative.is_absolute() ? path : relative.string(), "the file");
      if (found.empty()) {
        missing_.push_back(fs::path(path).filename().string());
        return nullptr;
      }
      own = io::read_file(found, text_companions_ ? kMaxMaterialBytes : file_.limits.max_file_bytes);
      companion_bytes_ += static_cast<std::int64_t>(own.size());
      file_.check_count(companion_bytes_, file_.limits.max_file_bytes, "bytes in the files that it names");
      // assimp turns UTF-16 to UTF-8 with errors of its own.
      const bool zeros = std::ranges::find(own, std::byte{0}) != own.end();
      if (text_companions_ && (zeros || (!own.empty() && own[0] >= std::byte{0xFE}))) {
        file_.refuse("names the material file '" + found.filename().string() +
                     "', which is not plain text; save it as UTF-8.");
      }
      if (text_companions_) own = clean_mtl({reinterpret_cast<const char*>(own.data()), own.size()});
    } else if (bytes_.empty()) {
      own = io::read_file(file_.path, file_.limits.max_file_bytes);
    }
  } catch (const Error& error) {
    if (refused_.empty()) refused_ = error.what();
    return nullptr;
  }
  const std::vector<std::byte>& bytes = model && !bytes_.empty() ? bytes_ : own;
  auto* stream = new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  if (&bytes == &own) contents_[stream] = std::move(own);  // the heap block stays where it is
  return stream;
}

void FolderIo::Close(Assimp::IOStream* stream) {
  contents_.erase(stream);
  delete stream;
}

}  // namespace faceprobe::assets
