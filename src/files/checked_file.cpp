#include "files/checked_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "base/error.h"

namespace seiche {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& action, int error_number) {
  throw Error(ExitCode::output_failed, describe_failure(path, action, error_number));
}

// File handle that is closed without a check when an error unwinds; close_checked() is the ordinary way.
class Handle {
 public:
  explicit Handle(int number) : number_(number) {}
  ~Handle() {
    if (number_ >= 0) ::close(number_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  int number() const { return number_; }
  int close_checked() { return ::close(std::exchange(number_, -1)); }

 private:
  int number_;
};

int open_retrying(const fs::path& path, int flags) {
  int number = -1;
  do {
    number = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  } while (number < 0 && errno == EINTR);
  return number;
}

// Returns zero or errno. Continues after short writes, repeats interrupted ones.
int write_all(int handle, std::string_view bytes) {
  constexpr std::size_t largest_write = std::size_t(1) << 30;
  while (!bytes.empty()) {
    const ssize_t done = ::write(handle, bytes.data(), std::min(bytes.size(), largest_write));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) return errno;
    if (done == 0) return ENOSPC;
    bytes.remove_prefix(std::size_t(done));
  }
  return 0;
}

int sync_handle(int handle) {
  int result = 0;
  do {
    result = ::fsync(handle);
  } while (result != 0 && errno == EINTR);
  // Pipes and character devices cannot be synced and need not be.
  return result == 0 || errno == EINVAL || errno == EROFS ? 0 : errno;
}

void write_synced(const fs::path& path, const std::function<void(const ByteSink&)>& produce) {
  Handle file(open_retrying(path, O_WRONLY | O_CREAT | O_TRUNC));
  if (file.number() < 0) fail(path, "open", errno);
  produce([&](std::string_view bytes) {
    if (const int error = write_all(file.number(), bytes)) fail(path, "write", error);
  });
  if (const int error = sync_handle(file.number())) fail(path, "sync", error);
  if (file.close_checked() != 0) fail(path, "close", errno);
}

struct UnlinkUnlessKept {
  fs::path path;
  bool kept = false;
  ~UnlinkUnlessKept() {
    if (!kept) ::unlink(path.c_str());
  }
};

std::string remedy(int error_number) {
  switch (error_number) {
    case ENOSPC:
    case EFBIG:
    case EDQUOT:
      return "make room, raise the limit, or choose another folder with --out";
    case EMFILE:
    case ENFILE:
      return "raise the limit of open files (ulimit -n)";
    default:
      return "choose a folder that can be written with --out";
  }
}

}  // namespace

std::string describe_failure(const fs::path& path, const std::string& action, int error_number) {
  fs::path folder = path.parent_path().empty() ? fs::path(".") : path.parent_path();
  std::error_code ignored;
  while (!fs::exists(folder, ignored) && folder.has_relative_path()) folder = folder.parent_path();
  struct statvfs space {};
  const std::string free = ::statvfs(folder.c_str(), &space) == 0
                               ? fmt::format("{} bytes free", std::uint64_t(space.f_bavail) * space.f_frsize)
                               : std::string("free space unknown");
  return fmt::format("cannot {} {}: {} ({} there); {}", action, path.string(), std::strerror(error_number), free,
                     remedy(error_number));
}

void write_file(const fs::path& path, std::string_view bytes) {
  write_file(path, [&](const ByteSink& write) { write(bytes); });
}

void write_file(const fs::path& path, const std::function<void(const ByteSink&)>& produce) {
  UnlinkUnlessKept temporary{fs::path(path.string() + ".tmp")};
  write_synced(temporary.path, produce);
  if (::rename(temporary.path.c_str(), path.c_str()) != 0) fail(path, "rename to", errno);
  temporary.kept = true;
  sync_folder(path.parent_path());
}

void overwrite_start(const fs::path& path, std::string_view bytes) {
  Handle file(open_retrying(path, O_WRONLY));
  if (file.number() < 0) fail(path, "open", errno);
  if (const int error = write_all(file.number(), bytes)) fail(path, "write", error);
  if (const int error = sync_handle(file.number())) fail(path, "sync", error);
  if (file.close_checked() != 0) fail(path, "close", errno);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail(folder, "create folder", error.value());
  if (!fs::is_directory(folder, error)) fail(folder, "create folder", ENOTDIR);
}

void sync_folder(const fs::path& folder) {
  Handle handle(open_retrying(folder.empty() ? fs::path(".") : folder, O_RDONLY | O_DIRECTORY));
  if (handle.number() < 0) fail(folder, "open folder", errno);
  if (const int error = sync_handle(handle.number())) fail(folder, "sync folder", error);
}

void rename_durably(const fs::path& from, const fs::path& to) {
  if (::rename(from.c_str(), to.c_str()) != 0) fail(to, "rename to", errno);
  sync_folder(to.parent_path());
}

std::string read_whole_file(const fs::path& path) {
  const auto refuse = [&](int error) {
    return Error(ExitCode::bad_checkpoint, fmt::format("cannot read {}: {}", path.string(), std::strerror(error)));
  };
  const Handle file(open_retrying(path, O_RDONLY));
  struct stat facts {};
  if (file.number() < 0 || ::fstat(file.number(), &facts) != 0) throw refuse(errno);
  if (!S_ISREG(facts.st_mode)) throw refuse(EINVAL);
  std::string bytes(std::size_t(facts.st_size), '\0');
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t got = ::read(file.number(), bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw refuse(errno);
    if (got == 0) break;
    filled += std::size_t(got);
  }
  bytes.resize(filled);
  return bytes;
}

AppendFile::AppendFile(fs::path path, std::uint64_t keep) : path_(std::move(path)) {
  handle_ = open_retrying(path_, O_WRONLY | O_CREAT | O_APPEND);
  if (handle_ < 0) fail(path_, "open", errno);
  struct stat facts {};
  if (::fstat(handle_, &facts) != 0) fail(path_, "examine", errno);
  size_ = std::uint64_t(facts.st_size);
  if (size_ <= keep) return;
  if (::ftruncate(handle_, off_t(keep)) != 0) fail(path_, "cut", errno);
  size_ = keep;
}

AppendFile::~AppendFile() {
  if (handle_ >= 0) ::close(handle_);
}

void AppendFile::flush() {
  if (pending_.empty()) return;
  const std::string text = std::exchange(pending_, {});
  if (const int error = write_all(handle_, text)) fail(path_, "write", error);
  size_ += text.size();
}

// Fails if the file was removed or replaced during the run: writes would then succeed and be lost.
void AppendFile::check_name() const {
  struct stat held {
  }, named{};
  if (::fstat(handle_, &held) != 0) fail(path_, "examine", errno);
  if (::stat(path_.c_str(), &named) == 0 && held.st_ino == named.st_ino && held.st_dev == named.st_dev) return;
  throw Error(ExitCode::output_failed,
              fmt::format("{} was removed or replaced while the run was writing it", path_.string()));
}

void AppendFile::sync() {
  flush();
  check_name();
  if (const int error = sync_handle(handle_)) fail(path_, "sync", error);
}

}  // namespace seiche
