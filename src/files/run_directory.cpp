#include "files/run_directory.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <regex>
#include <string>
#include <utility>

#include "base/error.h"
#include "files/checked_file.h"

namespace seiche {
namespace fs = std::filesystem;
namespace {

// True if a file of this name, relative to the run's folder, belongs to a run.
bool is_ours(const std::string& name) {
  static const std::regex pattern(
      "(scene\\.toml|(stats|solids|probes|joints)\\.csv|summary\\.json|log\\.txt|validate\\.txt|stop|lock)(\\.tmp)?"
      "|frames/(frame|solids|fluid|elastic|joints)\\.[0-9]+\\.(vdb|vtu|vti)(\\.tmp)?"
      "|frames/(solids|fluid|elastic|joints)\\.pvd(\\.tmp)?|frames/[^/]+\\.pc2(\\.tmp)?"
      "|checkpoints/[0-9]+(\\.tmp)?/(COMMIT|rank\\.[0-9]+)(\\.tmp)?|pictures/.*\\.(png|gif|mp4)");
  return std::regex_match(name, pattern);
}

// True for the mesh beside a point cache of an elastic solid.
bool is_mesh_of_cache(const fs::path& file) {
  const fs::path cache = fs::path(file).replace_extension(".pc2");
  return file.extension() == ".obj" && file.parent_path().filename() == "frames" && fs::exists(cache);
}

[[noreturn]] void fail(const fs::path& path, const std::string& action) {
  throw Error(ExitCode::output_failed, describe_failure(path, action, errno));
}

RemovedFiles remove_run(const fs::path& folder) {
  std::vector<fs::path> files, folders;
  RemovedFiles removed;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string();
    if (entry.is_directory() && !entry.is_symlink()) {
      folders.push_back(entry.path());
    } else if ((is_ours(name) || is_mesh_of_cache(entry.path())) && name != "lock") {
      files.push_back(entry.path());
      ++(name.starts_with("pictures/") ? removed.pictures : removed.others);
    }
  }
  for (const fs::path& file : files) {
    if (::unlink(file.c_str()) != 0) fail(file, "remove");
  }
  // Deepest first; folders with foreign files remain.
  std::sort(folders.begin(), folders.end(), std::greater<>());
  for (const fs::path& empty : folders) ::rmdir(empty.c_str());
  return removed;
}

bool holds_output(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename() != "lock") return true;
  }
  return false;
}

// Likely mistake: the scene's name instead of the folder of its run.
[[noreturn]] void refuse_to_resume(const fs::path& given) {
  std::error_code ignored;
  if (!fs::exists(given, ignored))
    throw Error(ExitCode::bad_input, fmt::format("{}: there is no such run directory to resume", given.string()));
  const fs::path usual = fs::path("out") / given.stem();
  const bool there = fs::exists(usual / "scene.toml", ignored);
  const std::string remedy = there ? fmt::format("did you mean `seiche resume {}`?", usual.string())
                                   : fmt::format("such as {}", usual.string());
  throw Error(ExitCode::bad_input, fmt::format("{} is a file; resume takes the directory of a run, {}{}",
                                               given.string(), remedy, there ? "" : " or the one given with --out"));
}

std::string first_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

}  // namespace

RunDirectory::RunDirectory(const fs::path& folder, ExistingOutput policy)
    : paths_{fs::absolute(folder).lexically_normal()} {
  std::error_code ignored;
  if (policy == ExistingOutput::resume && !fs::is_directory(paths_.folder, ignored)) refuse_to_resume(folder);
  try {
    create_folder();
    take_lock();
    look_at_contents(policy);
  } catch (const fs::filesystem_error& error) {
    drop_lock();
    throw Error(ExitCode::output_failed, describe_failure(paths_.folder, "use", error.code().value()));
  } catch (...) {
    drop_lock();
    throw;
  }
}

RunDirectory::~RunDirectory() {
  drop_lock();
}

void RunDirectory::create_folder() {
  std::error_code ignored;
  std::vector<fs::path> missing;
  for (fs::path p = paths_.folder; !p.empty() && !fs::exists(p, ignored) && p.has_relative_path();
       p = p.parent_path()) {
    missing.push_back(p);
  }
  make_folder(paths_.folder);
  created_.assign(missing.rbegin(), missing.rend());
}

void RunDirectory::take_lock() {
  const fs::path file = paths_.lock();
  struct stat held {
  }, named{};
  do {  // again if another job removed the file between open and lock
    if (lock_ >= 0) ::close(lock_);
    lock_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (lock_ < 0) fail(file, "open");
    if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
      const std::string owner = first_line(file);
      ::close(std::exchange(lock_, -1));
      created_.clear();
      throw Error(ExitCode::output_failed,
                  fmt::format("{} is in use by another job (process {}); wait for it or choose "
                              "another folder with --out",
                              paths_.folder.string(), owner));
    }
  } while (::fstat(lock_, &held) != 0 || ::stat(file.c_str(), &named) != 0 || held.st_ino != named.st_ino);
  const std::string owner = std::to_string(::getpid()) + "\n";
  if (::ftruncate(lock_, 0) != 0 || ::write(lock_, owner.data(), owner.size()) != ssize_t(owner.size())) {
    fail(file, "write");
  }
}

void RunDirectory::drop_lock() {
  if (lock_ < 0) return;
  ::unlink(paths_.lock().c_str());
  ::close(std::exchange(lock_, -1));
  for (auto folder = created_.rbegin(); folder != created_.rend(); ++folder) ::rmdir(folder->c_str());
}

void RunDirectory::look_at_contents(ExistingOutput policy) {
  const bool is_run = fs::exists(paths_.scene());
  if (policy == ExistingOutput::resume && !is_run) {
    throw Error(ExitCode::bad_input,
                fmt::format("{}: not a run directory (it holds no scene.toml)", paths_.folder.string()));
  }
  if (policy == ExistingOutput::refuse && holds_output(paths_.folder)) {
    throw Error(ExitCode::bad_input,
                fmt::format("{} already holds {}; give --overwrite to replace it{}, `seiche resume` to continue it, or "
                            "another --out",
                            paths_.folder.string(), is_run ? "a run" : "files",
                            fs::exists(paths_.pictures()) ? " (its pictures, too)" : ""));
  }
  if (policy == ExistingOutput::overwrite) removed_ = remove_run(paths_.folder);
}

}  // namespace seiche
