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
      "|checkpoints/[0-9]+(\\.tmp)?/(COMMIT|rank\\.[0-9]+)(\\.tmp)?|pictures/"
      "(frame\\.[0-9]+|contact_sheet)\\.(png|svg|pdf|exr)(\\.tmp)?");
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

// Calls visit(path, name) for each file of a run, `name` relative to the folder, but for the lock.
template <class Visit>
void for_each_run_file(const fs::path& folder, Visit&& visit) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_directory() && !entry.is_symlink()) continue;
    const std::string name = fs::relative(entry.path(), folder).string();
    if ((is_ours(name) || is_mesh_of_cache(entry.path())) && name != "lock") visit(entry.path(), name);
  }
}

void remove_run(const fs::path& folder) {
  std::vector<fs::path> files, folders;
  for_each_run_file(folder, [&](const fs::path& path, const std::string&) { files.push_back(path); });
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_directory() && !entry.is_symlink()) folders.push_back(entry.path());
  for (const fs::path& file : files) {
    if (::unlink(file.c_str()) != 0) fail(file, "remove");
  }
  // Deepest first; folders with foreign files remain.
  std::sort(folders.begin(), folders.end(), std::greater<>());
  for (const fs::path& empty : folders) ::rmdir(empty.c_str());
}

// True if more than one thing in the folder looks like a run's. One alone may be a stranger's, such as a scene.toml
// that a user wrote.
bool looks_like_run(const fs::path& folder) {
  const auto there = [&](const char* name) { return fs::exists(folder / name); };
  constexpr std::array<const char*, 6> signs{"scene.toml",   "stats.csv", "log.txt",
                                             "summary.json", "frames",    "checkpoints"};
  return there("validate.txt") || std::count_if(signs.begin(), signs.end(), there) > 1;
}

// Time of the last whole row of stats.csv, s.
std::optional<double> last_time(const fs::path& stats) {
  std::ifstream in(stats);
  std::string line, header, last;
  std::getline(in, header);
  while (std::getline(in, line))
    if (!in.eof() && !line.empty()) last = line;  // a line without an end was cut off
  const std::size_t comma = last.find(',');
  if (!header.starts_with("step,time,") || comma == std::string::npos) return {};
  return std::strtod(last.c_str() + comma + 1, nullptr);
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

std::string counted_things(int count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

RunContents survey_run(const fs::path& folder) {
  RunContents found;
  int images = 0;  // frames for ParaView, beside the others or in place of them
  for_each_run_file(folder, [&](const fs::path& path, const std::string& name) {
    std::error_code gone;
    const auto size = fs::is_symlink(path) ? 0 : fs::file_size(path, gone);
    found.bytes += gone ? 0 : double(size);
    ++found.files;
    images += name.starts_with("frames/fluid.") && name.ends_with(".vti");
    found.frames += name.starts_with("frames/frame.") && name.ends_with(".vdb");
    found.checkpoints += name.starts_with("checkpoints/") && name.ends_with("/COMMIT");
    found.pictures += name.starts_with("pictures/");
  });
  found.frames = std::max(found.frames, images);
  found.time = last_time(RunPaths{folder}.stats());
  return found;
}

std::string describe_contents(const RunContents& contents) {
  std::string text = counted_things(contents.frames, "frame");
  if (contents.time) text += fmt::format(" to t = {:g} s", *contents.time);
  if (contents.checkpoints > 0) text += ", " + counted_things(contents.checkpoints, "checkpoint");
  if (contents.pictures > 0) text += ", " + counted_things(contents.pictures, "picture");
  const char* unit = contents.bytes < 1e6 ? "kB" : contents.bytes < 1e9 ? "MB" : "GB";
  const double scale = contents.bytes < 1e6 ? 1e3 : contents.bytes < 1e9 ? 1e6 : 1e9;
  return text + fmt::format("; {}, {:.3g} {}", counted_things(contents.files, "file"), contents.bytes / scale, unit);
}

RunDirectory::RunDirectory(const fs::path& folder, ExistingOutput policy, const Announce& announce)
    : paths_{fs::absolute(folder).lexically_normal()} {
  std::error_code ignored;
  if (policy == ExistingOutput::resume && !fs::is_directory(paths_.folder, ignored)) refuse_to_resume(folder);
  try {
    create_folder();
    take_lock();
    look_at_contents(policy, announce);
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

void RunDirectory::look_at_contents(ExistingOutput policy, const Announce& announce) {
  const bool is_run = fs::exists(paths_.scene());
  if (policy == ExistingOutput::resume && !is_run) {
    throw Error(ExitCode::bad_input,
                fmt::format("{}: not a run directory (it holds no scene.toml)", paths_.folder.string()));
  }
  if (policy == ExistingOutput::refuse && holds_output(paths_.folder)) {
    const std::string held = is_run ? "a run (" + describe_contents(survey_run(paths_.folder)) + ")" : "files";
    throw Error(ExitCode::bad_input,
                fmt::format("{} already holds {}; give --overwrite to replace it, `seiche resume` to continue it, or "
                            "another --out",
                            paths_.folder.string(), held));
  }
  if (policy == ExistingOutput::overwrite) clear(announce);
}

void RunDirectory::clear(const Announce& announce) {
  const RunContents held = survey_run(paths_.folder);
  if (held.files == 0) return;
  if (!looks_like_run(paths_.folder)) {
    std::string first;
    for_each_run_file(paths_.folder, [&](const fs::path&, const std::string& name) {
      if (first.empty() || name < first) first = name;
    });
    throw Error(ExitCode::bad_input, fmt::format("{} holds {}, but no run of Seiche, so nothing is overwritten; move "
                                                 "that file, or choose another folder with --out",
                                                 paths_.folder.string(), first));
  }
  if (announce) announce(held);
  remove_run(paths_.folder);
}

}  // namespace seiche
