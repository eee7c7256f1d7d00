#pragma once
// Internal: the files that a model names. A model from a stranger must not read /etc/passwd, so they lie in its own folder or
// below, links followed.

#include "assets/model_checks.h"

#include <assimp/IOSystem.hpp>
#include <map>
#include <string>
#include <vector>

namespace faceprobe::assets {

// The path of a companion by the name in the file, which may have backslashes or glTF's %20. Empty when it is not there. Throws
// Error(kInput), `what` first ("the texture"), when it is absolute or outside the folder.
std::filesystem::path find_companion(const ModelFile& file, const std::string& written, const std::string& what);

// What assimp sees of the disk: the model from memory (or from disk without bytes), and its companions.
class FolderIo : public Assimp::IOSystem {
 public:
  // The bytes must outlive it; `text` companions (.mtl) must be short and without zeros.
  FolderIo(const ModelFile& file, const std::vector<std::byte>& bytes, bool text)
      : file_(file), bytes_(bytes), text_companions_(text) {}

  bool Exists(const char* path) const override;
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* path, const char* mode) override;
  void Close(Assimp::IOStream* stream) override;

  // Why a companion was not opened, a sentence's end; empty when all were.
  const std::string& refused() const { return refused_; }
  const std::vector<std::string>& missing() const { return missing_; }

 private:
  bool is_model(const std::filesystem::path& path) const;

  const ModelFile& file_;
  const std::vector<std::byte>& bytes_;
  bool text_companions_;
  std::int64_t companion_bytes_ = 0;
  std::map<Assimp::IOStream*, std::vector<std::byte>> contents_;
  std::string refused_;
  std::vector<std::string> missing_;
};

}  // namespace faceprobe::assets
