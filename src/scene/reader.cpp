#include "scene/reader.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "base/scene.h"
#include "scene/checks.h"
#include "scene/curves.h"
#include "scene/include.h"
#include "scene/materials.h"
#include "scene/options.h"
#include "scene/overrides.h"

namespace seiche {
namespace {

class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& file) : handle_(::open(file.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~OpenFile() {
    if (handle_ >= 0) ::close(handle_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int handle() const { return handle_; }

 private:
  int handle_;
};

[[noreturn]] void fail_to_read(const std::filesystem::path& file) {
  throw Error(ExitCode::bad_input, "cannot read the scene '" + file.string() + "': " + std::strerror(errno));
}

}  // namespace

std::string read_scene_text(const std::filesystem::path& file) {
  const OpenFile open_file(file);
  if (open_file.handle() < 0) fail_to_read(file);
  std::string bytes;
  std::vector<char> buffer(1 << 16);
  while (bytes.size() <= most_scene_bytes) {
    const ssize_t count = ::read(open_file.handle(), buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail_to_read(file);
    if (count == 0) break;
    bytes.append(buffer.data(), std::size_t(count));
  }
  return bytes;
}

Scene parse_scene(const std::string& text, const std::string& name, const std::filesystem::path& folder,
                  const std::vector<Override>& overrides) {
  TomlNode root = parse_toml(text, name);
  SceneContext context(name, folder);
  merge_includes(context, root);
  apply_overrides(root, overrides);
  if (root.entries.empty()) {
    throw Error(ExitCode::bad_input,
                name +
                    ": the scene is empty; it needs at least [domain] with upper and cell_size, and "
                    "[time] with end");
  }
  for (const Override& override : overrides) context.override_paths.push_back(override.path);
  context.parameters = read_parameters(context, root);
  if (!context.clean("parameters")) context.throw_problems();  // what uses them would only repeat their faults
  const Parameters signals = read_signals(context, root);
  std::map<std::string, TimeCurve> curves = read_curves(context, root);
  fill_in_materials(context, root);
  const Scene defaults;
  context.dimension = root.find("dimension") ? 0 : defaults.dimension;
  Scene scene;
  scene.signals = signals;
  scene.curves = std::move(curves);
  read_section(context, {&root, ""}, scene_section(), own_options(scene_section()), scene);
  check_scene(context, root, scene);
  context.throw_problems();
  return scene;
}

Scene read_scene(const std::filesystem::path& file, const std::vector<Override>& overrides) {
  return parse_scene(read_scene_text(file), file.string(), file.parent_path(), overrides);
}

}  // namespace seiche
