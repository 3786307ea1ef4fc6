// Paths of meshes and level sets in a scene.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "scene/values.h"

namespace seiche {
namespace {

namespace fs = std::filesystem;

bool is_inside(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

// Reason why the file cannot be read, or empty.
std::string fault_of_file(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) return error ? error.message() : "No such file or directory";
  if (fs::is_directory(status)) return "Is a directory";
  if (!fs::is_regular_file(status)) return "not a regular file";
  const int opened = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (opened < 0) return std::strerror(errno);
  ::close(opened);
  return fs::file_size(file, error) == 0 ? "the file is empty" : "";
}

}  // namespace

std::string fault_of_path(const SceneContext& c, const fs::path& given, fs::path& out) {
  std::error_code error;
  const fs::path folder = fs::weakly_canonical(c.folder().empty() ? fs::path(".") : c.folder(), error);
  const fs::path file = error ? given : fs::weakly_canonical(folder / given, error);
  if (error) return fmt::format("cannot follow \"{}\": {}", given.string(), error.message());
  if (c.access == FileAccess::scene_folder && !is_inside(file, folder))
    return fmt::format(
        "\"{}\" lies outside the scene's folder; move it there, or set allow_outside_files = true at the top of the "
        "scene",
        given.string());
  const std::string fault = fault_of_file(file);
  if (!fault.empty()) return fmt::format("cannot read \"{}\": {}", given.string(), fault);
  out = file;
  return {};
}

void read_value(SceneContext& c, const Place& p, const Option&, fs::path& out) {
  if (!is_text(*p.node) || p.node->text.empty()) {
    return c.report(p, fmt::format("{} must be a path in quotes, not {}", p.path, describe(*p.node)));
  }
  if (p.node->text.find('\0') != std::string::npos) return c.report(p, p.path + " must not contain a zero byte");
  const fs::path given(p.node->text);
  if (c.access == FileAccess::scene_folder && given.is_absolute())
    return c.report(p, fmt::format("{}: \"{}\", an absolute path, counts as outside the scene's folder; set "
                                   "allow_outside_files = true at the top of the scene",
                                   p.path, given.string()));
  const std::string fault = fault_of_path(c, given, out);
  if (!fault.empty()) c.report(p, fmt::format("{}: {}", p.path, fault));
}

}  // namespace seiche
