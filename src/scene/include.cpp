#include "scene/include.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "scene/reader.h"
#include "scene/values.h"

namespace seiche {
namespace {

namespace fs = std::filesystem;
using Kind = TomlNode::Kind;

bool is_table_list(const TomlNode& node) {
  return node.kind == Kind::array && !node.items.empty() &&
         std::ranges::all_of(node.items, [](const TomlNode& item) { return item.kind == Kind::table; });
}

void merge(TomlNode& base, TomlNode over) {
  for (TomlEntry& entry : over.entries) {
    TomlEntry* below = base.find(entry.key);
    if (!below) {
      base.entries.push_back(std::move(entry));
    } else if (below->value.kind == Kind::table && entry.value.kind == Kind::table) {
      merge(below->value, std::move(entry.value));
    } else if (is_table_list(below->value) && is_table_list(entry.value)) {
      for (TomlNode& item : entry.value.items) below->value.items.push_back(std::move(item));
    } else {
      *below = std::move(entry);
    }
  }
}

void add_to_lines(TomlNode& node, int more) {
  node.line += more;
  for (TomlEntry& entry : node.entries) entry.line += more, add_to_lines(entry.value, more);
  for (TomlNode& item : node.items) add_to_lines(item, more);
}

class Includer {
 public:
  explicit Includer(SceneContext& context) : context_(context) {}

  // `folder`: of the file that `node` was read from.
  void resolve(TomlNode& node, const fs::path& folder) {
    const TomlEntry* entry = node.find("include");
    if (!entry) return;
    const TomlNode list = entry->value;
    std::erase_if(node.entries, [](const TomlEntry& one) { return one.key == "include"; });
    TomlNode below;
    for (const TomlNode& name : list.kind == Kind::array ? list.items : std::vector<TomlNode>{list})
      merge(below, load(name, folder));
    below.line = node.line;
    merge(below, std::move(node));
    node = std::move(below);
  }

 private:
  [[noreturn]] void fail(const TomlNode& name, const std::string& why) const {
    throw Error(ExitCode::bad_input, fmt::format("{}: include: {}", context_.where(name.line), why));
  }

  TomlNode load(const TomlNode& name, const fs::path& folder) {
    if (name.kind != Kind::text || name.text.empty())
      fail(name, fmt::format("it must be the path of a scene, or a list of paths, not {}", describe(name)));
    fs::path file;
    const std::string fault = fault_of_path(context_, folder / name.text, file);
    if (!fault.empty()) fail(name, fault);
    if (std::ranges::find(open_, file) != open_.end()) fail(name, fmt::format("\"{}\" includes itself", name.text));
    if (context_.included.size() >= most_included)
      fail(name, fmt::format("at most {} files are possible", most_included));
    context_.included.push_back(file.string());
    const int number = int(context_.included.size());
    TomlNode node = parse_toml(read_scene_text(file), file.string());
    add_to_lines(node, number * SceneContext::lines_a_file);
    open_.push_back(file);
    resolve(node, file.parent_path());
    open_.pop_back();
    return node;
  }

  static constexpr std::size_t most_included = 100;
  SceneContext& context_;
  std::vector<fs::path> open_;
};

}  // namespace

void merge_includes(SceneContext& context, TomlNode& root) {
  const TomlEntry* leave = root.find("allow_outside_files");
  if (leave && leave->value.kind == Kind::boolean && leave->value.boolean) context.access = FileAccess::anywhere;
  Includer(context).resolve(root, context.folder().empty() ? fs::path(".") : fs::absolute(context.folder()));
  context.access = FileAccess::scene_folder;
}

}  // namespace seiche
