#include "validate/record/cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/crc32c.h"
#include "base/error.h"
#include "base/numbered_files.h"
#include "base/scene.h"
#include "base/shape_spec.h"
#include "base/version.h"
#include "files/checked_file.h"
#include "files/json.h"
#include "files/run_directory.h"
#include "scene/writer.h"
#include "validate/record/machine.h"

namespace seiche {
namespace fs = std::filesystem;
namespace {

fs::path identity_file(const fs::path& run) {
  return run / "validate.txt";
}

constexpr const char* machine_word = "machine ";  // starts the line that describes the run's machine
const std::string unfinished = "unfinished\n";    // precedes the identity until the run is complete

// Selects the lines that begin with machine_word, or the others.
enum class Lines { of_machine, of_identity };
std::string lines_of(const std::string& text, Lines wanted) {
  std::string chosen;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    const std::string line = text.substr(at, end - at);
    if (line.starts_with(machine_word) == (wanted == Lines::of_machine)) chosen += line;
    at = end;
  }
  return chosen;
}

std::string key_of(const Scene& scene, const std::string& identity) {
  return identity + write_scene(scene);
}

// Identity and scene of the run in a folder; empty if no validation made it.
std::string key_in(const fs::path& run) {
  try {
    return lines_of(read_whole_file(identity_file(run)), Lines::of_identity) + read_whole_file(RunPaths{run}.scene());
  } catch (const Error&) {
    return {};
  }
}

// Value in the summary of a folder's run; empty if there is none, as after a kill.
std::string summary_value(const fs::path& run, const char* key) {
  try {
    return json_value(read_whole_file(RunPaths{run}.summary()), key);
  } catch (const Error&) {
    return {};
  }
}

// True if a run may be resumed. One that could not continue would fail again; one finished outside of a validation may
// be of any build.
bool may_go_on(const fs::path& run) {
  const std::string code = summary_value(run, "exit_code");
  const auto is = [&](ExitCode one) { return code == std::to_string(int(one)); };
  return !is_finished(run) && !is(ExitCode::cannot_continue) && !is(ExitCode::bug);
}

bool is_free(const fs::path& run) {
  try {
    const RunDirectory tried(run, ExistingOutput::resume);
    return true;
  } catch (const Error&) {
    return false;
  }
}

std::vector<fs::path> folders_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code failed;
  for (fs::directory_iterator it(folder, failed), end; !failed && it != end; it.increment(failed))
    if (it->is_directory(failed)) found.push_back(it->path());
  return found;
}

}  // namespace

std::string checksum_of(const fs::path& file) {
  try {
    const std::string bytes = read_whole_file(file);
    return fmt::format("{:08x} of {} bytes", crc32c(bytes), bytes.size());
  } catch (const Error& error) {
    throw Error(ExitCode::bad_input, error.what());
  }
}

std::string checksums_of_files(const Scene& scene) {
  std::string text;
  for_each_shape(scene, [&](const ShapeSpec& shape) {
    if (!shape.file.empty()) text += fmt::format("file {}\n", checksum_of(shape.file));
  });
  for (const SolidSpec& solid : scene.solids)
    for (const fs::path& file : numbered_files(solid.shape.file, solid.sequence.meshes))
      text += fmt::format("file {}\n", checksum_of(file));
  return text;
}

std::string run_identity(const Scene& scene, int ranks, const std::string& perturbation) {
  std::string text = fmt::format("seiche {}, build {}\nranks {}\n", version(), build_digest(), ranks);
  if (!perturbation.empty()) text += fmt::format("broken {}\n", perturbation);
  return text + checksums_of_files(scene);
}

std::string machine_of(const fs::path& run) {
  try {
    const std::string line = lines_of(read_whole_file(identity_file(run)), Lines::of_machine);
    if (line.empty()) return {};
    const std::size_t begin = std::string(machine_word).size();
    return line.substr(begin, line.find('\n') - begin);
  } catch (const Error&) {
    return {};
  }
}

bool is_finished(const fs::path& run) {
  return summary_value(run, "ended") == "finished";
}

RunCache::RunCache(fs::path out, Earlier earlier) : out_(std::move(out)), earlier_(earlier) {
  look();
}

void RunCache::look() {
  if (earlier_ == Earlier::ignore) return;
  for (const fs::path& one : folders_in(out_))
    for (const fs::path& run : folders_in(one)) {
      const std::string key = key_in(run);
      if (key.starts_with(unfinished) ? may_go_on(run) : !key.empty() && is_finished(run)) runs_.emplace(key, run);
    }
}

std::optional<fs::path> RunCache::find(const Scene& scene, const std::string& identity) const {
  const auto found = runs_.find(key_of(scene, identity));
  return found == runs_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<fs::path> RunCache::find_begun(const Scene& scene, const std::string& identity) const {
  const auto found = find(scene, unfinished + identity);
  return found && is_free(*found) ? found : std::nullopt;
}

void RunCache::begin(const fs::path& run, const Scene& scene, const std::string& identity) {
  std::erase_if(runs_, [&](const auto& entry) { return entry.second == run; });
  const RunDirectory emptied(run, ExistingOutput::overwrite);
  write_file(identity_file(run), unfinished + identity);
  write_file(RunPaths{run}.scene(), write_scene(scene));
}

void RunCache::keep(const fs::path& run, const std::string& identity) {
  write_file(identity_file(run), identity + machine_word + describe_machine() + "\n");
  std::erase_if(runs_, [&](const auto& entry) { return entry.second == run; });
  if (const std::string key = key_in(run); !key.empty()) runs_.emplace(key, run);
}

}  // namespace seiche
