#include "validate/record/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "files/checked_file.h"

namespace seiche {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& action, const std::string& why) {
  throw Error(ExitCode::output_failed, fmt::format("cannot {} {}: {}", action, path.string(), why));
}

fs::path temporary_beside(const fs::path& file) {
  static std::atomic<int> count{0};
  return fmt::format("{}.{}.{}", file.string(), ::getpid(), count++);
}

}  // namespace

fs::path target_of(const fs::path& file) {
  std::error_code failed;
  const fs::path target = fs::weakly_canonical(fs::absolute(file), failed);
  return failed ? fs::absolute(file) : target;
}

FolderLock::FolderLock(const fs::path& folder) : handle_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (handle_ < 0) fail(folder, "open the folder", std::strerror(errno));
  int result = 0;
  do {
    result = ::flock(handle_, LOCK_EX);
  } while (result != 0 && errno == EINTR);
  if (result == 0) return;
  const int error = errno;
  ::close(handle_);
  fail(folder, "lock the folder", std::strerror(error));
}

FolderLock::~FolderLock() {
  ::close(handle_);
}

fs::path folder_of(const fs::path& file) {
  return target_of(file).parent_path();
}

void replace_file(const fs::path& file, std::string_view bytes) {
  const fs::path target = target_of(file), temporary = temporary_beside(target);
  write_file(temporary, bytes);
  try {
    rename_durably(temporary, target);
  } catch (const Error&) {
    ::unlink(temporary.c_str());
    throw;
  }
}

void check_writable(const fs::path& file) {
  const fs::path target = target_of(file);
  if (fs::is_directory(target)) fail(file, "write", "it is a folder");
  if (fs::exists(target) && !fs::is_regular_file(target)) fail(file, "write", "it is no ordinary file");
  const fs::path temporary = temporary_beside(target);
  const int handle = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (handle < 0) fail(file, "write", std::strerror(errno));
  const bool written = ::write(handle, "\n", 1) == 1;
  const int error = errno;
  ::close(handle);
  ::unlink(temporary.c_str());
  if (!written) fail(file, "write", std::strerror(error));
}

}  // namespace seiche
