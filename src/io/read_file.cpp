#include "io/read_file.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/data_files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <system_error>

namespace faceprobe::io {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  int get() const { return fd_; }

 private:
  int fd_;
};

[[noreturn]] void refuse(const std::string& sentence) { throw Error(ExitCode::kInput, sentence); }

std::string system_reason() { return std::generic_category().message(errno); }

void require_regular(const struct stat& status, const std::string& name) {
  if (S_ISREG(status.st_mode)) return;
  if (S_ISDIR(status.st_mode)) refuse(name + " is a folder, not a file. Name the file in it.");
  if (S_ISFIFO(status.st_mode))
    refuse(name + " is a pipe; only regular files are read. Save its contents to a file first.");
  refuse(name + " is a device or socket; only regular files are read.");
}

}  // namespace

std::vector<std::byte> read_regular_file(const std::filesystem::path& path, std::int64_t max_bytes,
                                         const std::string& advice) {
  const std::string name = path.string();
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) refuse(name + " cannot be read: " + system_reason() + ".");
  require_regular(status, name);
  // Not blocking, and looked at again: the name may have come to mean a pipe in the meantime.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0) refuse(name + " cannot be read: " + system_reason() + ".");
  if (::fstat(file.get(), &status) != 0) refuse(name + " cannot be read: " + system_reason() + ".");
  require_regular(status, name);
  const auto refuse_length = [&](std::int64_t found) {
    refuse(name + " has " + std::to_string(found) + " bytes; at most " + std::to_string(max_bytes) + " are allowed" +
           advice + ".");
  };
  if (status.st_size > max_bytes) refuse_length(status.st_size);

  std::vector<std::byte> bytes(static_cast<std::size_t>(status.st_size));
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t got = ::read(file.get(), bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) refuse(name + " cannot be read: " + system_reason() + ".");
    if (got == 0) break;  // became shorter while we read
    filled += static_cast<std::size_t>(got);
  }
  bytes.resize(filled);
  return bytes;
}

std::vector<std::byte> read_file(const std::filesystem::path& path, std::int64_t max_bytes) {
  return read_regular_file(path, max_bytes, "");
}

std::string read_text(const std::filesystem::path& path, std::int64_t max_bytes) {
  const std::vector<std::byte> bytes = read_file(path, max_bytes);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace faceprobe::io
