#include "info/examples.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>

#include "base/error.h"
#include "base/suggest.h"
#include "files/checked_file.h"

namespace seiche {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Texts between double quotes.
std::vector<std::string> quoted_texts(const std::string& text) {
  std::vector<std::string> found;
  for (std::size_t at = text.find('"'); at != std::string::npos;) {
    const std::size_t end = text.find_first_of("\"\n", at + 1);
    if (end == std::string::npos) break;
    if (text[end] == '"') found.push_back(text.substr(at + 1, end - at - 1));
    at = text.find('"', end + 1);
  }
  return found;
}

// A file of the example, and of what it names in turn, by its path below the folder.
void collect(const fs::path& folder, const fs::path& file, std::map<fs::path, std::string>& files) {
  const std::string bytes = bytes_of(folder / file);
  if (!files.emplace(file, bytes).second) return;
  const std::string kind = file.extension().string();
  if (kind != ".toml" && kind != ".urdf") return;
  for (const std::string& text : quoted_texts(bytes)) {
    const fs::path named = (file.parent_path() / text).lexically_normal();
    std::error_code failed;
    const bool inside = !text.empty() && named.is_relative() && *named.begin() != "..";
    if (inside && fs::is_regular_file(folder / named, failed)) collect(folder, named, files);
  }
}

}  // namespace

std::vector<Example> list_examples(const fs::path& folder) {
  std::vector<Example> examples;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing)) {
    if (entry.path().extension() != ".toml") continue;
    Example example{entry.path().stem().string(), {}};
    const std::string text = bytes_of(entry.path()), key = "title = \"";
    if (const std::size_t at = text.find(key); at != std::string::npos)
      example.title = text.substr(at + key.size(), text.find('"', at + key.size()) - at - key.size());
    examples.push_back(example);
  }
  std::ranges::sort(examples, {}, &Example::name);
  return examples;
}

std::vector<fs::path> copy_example(const fs::path& folder, const std::string& name, const fs::path& target,
                                   Existing existing) {
  std::vector<std::string> names;
  for (const Example& example : list_examples(folder)) names.push_back(example.name);
  if (std::ranges::find(names, name) == names.end()) {
    const auto near = suggest(name, names);
    throw Error(ExitCode::bad_input,
                fmt::format("there is no example '{}'; {}", name,
                            near ? fmt::format("did you mean '{}'?", *near) : "`seiche init --list` names them"));
  }
  std::map<fs::path, std::string> files;
  collect(folder, name + ".toml", files);
  std::vector<fs::path> written;
  const auto place = [&](const fs::path& file) {
    return file == name + ".toml" ? target : target.parent_path() / file;
  };
  for (const auto& [file, bytes] : files) {
    std::error_code failed;
    if (existing == Existing::replace || !fs::exists(place(file), failed) || bytes_of(place(file)) == bytes) continue;
    throw Error(ExitCode::bad_input,
                fmt::format("{}: is there already; give another name, or --overwrite", place(file).string()));
  }
  for (const auto& [file, bytes] : files) {
    if (place(file).has_parent_path()) make_folder(place(file).parent_path());
    write_file(place(file), bytes);
    written.push_back(place(file));
  }
  return written;
}

}  // namespace seiche
