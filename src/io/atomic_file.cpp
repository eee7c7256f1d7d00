#include "faceprobe/io/atomic_file.h"

#include "faceprobe/core/error.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <random>
#include <string>
#include <system_error>

namespace faceprobe::io {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& target, const std::string& reason) {
  throw Error(ExitCode::kOutput, target.string() + " cannot be written: " + reason + ".");
}
std::string system_reason(int code) { return std::generic_category().message(code); }

fs::path folder_of(const fs::path& target) { return target.has_parent_path() ? target.parent_path() : fs::path("."); }

// The file behind a symbolic link is replaced, not the link. A pipe or device is refused: renaming over /dev/null would
// remove it.
fs::path resolve(const fs::path& path) {
  if (path.filename().empty()) fail(path, "it names no file");
  std::error_code error;
  fs::path target = path;
  if (fs::is_symlink(path, error)) {
    target = fs::weakly_canonical(path, error);
    if (error) fail(path, error.message());
  }
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status)) fail(path, "it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) fail(path, "it is not a regular file");
  return target;
}

// An empty file of its own in the target's folder, with the target's extension last; removed unless it was renamed away.
class Temporary {
 public:
  explicit Temporary(const fs::path& target) : target_(target) {
    constexpr char kLetters[] = "abcdefghijklmnopqrstuvwxyz0123456789";
    constexpr int kAttempts = 100;
    // Long names are cut: the temporary name must not exceed what the file system allows when the target's does not.
    const std::string stem = target.stem().string().substr(0, 100);
    const std::string extension = target.extension().string();
    std::random_device random;
    for (int attempt = 0; attempt < kAttempts && fd_ < 0; ++attempt) {
      std::string name = ".";
      name.append(stem).append(".");
      for (int i = 0; i < 8; ++i) name += kLetters[random() % (sizeof(kLetters) - 1)];
      name.append(".tmp").append(extension);
      path_ = folder_of(target) / name;
      fd_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);  // the process's umask applies
      if (fd_ < 0 && errno != EEXIST) fail(target, system_reason(errno));
    }
    if (fd_ < 0) fail(target, "no free temporary name was found");
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  ~Temporary() {
    if (fd_ >= 0) ::close(fd_);
    if (!renamed_) ::unlink(path_.c_str());
  }

  const fs::path& path() const { return path_; }

  void write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      const ssize_t done = ::write(fd_, bytes.data(), bytes.size());
      if (done < 0 && errno == EINTR) continue;
      if (done < 0) fail(target_, system_reason(errno));
      bytes = bytes.subspan(static_cast<std::size_t>(done));
    }
  }
  // A library that writes by name may have made a new file under it.
  void reopen() {
    ::close(fd_);
    fd_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW);
    if (fd_ < 0) fail(target_, system_reason(errno));
  }
  void put_in_place() {
    struct stat old {};
    if (::stat(target_.c_str(), &old) == 0) {
      // A replaced file keeps its permissions; where that is not allowed (another owner), the new ones stand.
      [[maybe_unused]] const int ignored = ::fchmod(fd_, old.st_mode & 07777);
    }
    if (::fsync(fd_) != 0) fail(target_, system_reason(errno));
    const int closed = ::close(fd_);
    fd_ = -1;
    if (closed != 0) fail(target_, system_reason(errno));
    if (::rename(path_.c_str(), target_.c_str()) != 0) fail(target_, system_reason(errno));
    renamed_ = true;
    // The rename itself reaches the disk with the folder. The new file is complete either way, so a file system that cannot
    // do this is no failure.
    const int folder = ::open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder >= 0) {
      ::fsync(folder);
      ::close(folder);
    }
  }

 private:
  fs::path target_;
  fs::path path_;
  int fd_ = -1;
  bool renamed_ = false;
};

}  // namespace

void write_file_atomically(const fs::path& path, std::span<const std::byte> bytes) {
  Temporary temporary(resolve(path));
  temporary.write(bytes);
  temporary.put_in_place();
}

void write_file_atomically(const fs::path& path, std::string_view text) {
  write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

void write_file_atomically(const fs::path& path, const std::function<void(const fs::path& temporary)>& write) {
  Temporary temporary(resolve(path));
  write(temporary.path());
  temporary.reopen();
  temporary.put_in_place();
}

void create_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw Error(ExitCode::kOutput, "The folder " + folder.string() + " cannot be made: " + error.message() + ".");
  if (!fs::is_directory(folder, error)) {
    throw Error(ExitCode::kOutput, folder.string() + " is a file where a folder is wanted. Choose another name.");
  }
}

}  // namespace faceprobe::io
