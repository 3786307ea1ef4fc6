#pragma once
// The folder of one run: layout, lock, and treatment of existing contents.
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace seiche {

struct RunPaths {
  std::filesystem::path folder;
  std::filesystem::path scene() const { return folder / "scene.toml"; }
  std::filesystem::path frames() const { return folder / "frames"; }
  std::filesystem::path checkpoints() const { return folder / "checkpoints"; }
  std::filesystem::path stats() const { return folder / "stats.csv"; }
  std::filesystem::path solids() const { return folder / "solids.csv"; }
  std::filesystem::path joints() const { return folder / "joints.csv"; }
  std::filesystem::path probes() const { return folder / "probes.csv"; }
  std::filesystem::path pictures() const { return folder / "pictures"; }
  std::filesystem::path summary() const { return folder / "summary.json"; }
  std::filesystem::path log() const { return folder / "log.txt"; }
  std::filesystem::path stop() const { return folder / "stop"; }
  std::filesystem::path lock() const { return folder / "lock"; }
};

enum class ExistingOutput { refuse, overwrite, resume };

// Files of a run in a folder, by their names; others are not counted.
struct RunContents {
  int frames = 0, checkpoints = 0, pictures = 0, files = 0;  // files: all of them
  double bytes = 0;
  std::optional<double> time;  // that the run has reached, s; unset if no table tells
};

// Contents of a folder that may hold a run. Throws std::filesystem::filesystem_error.
RunContents survey_run(const std::filesystem::path& folder);

// "25 frames to t = 1 s, 2 checkpoints, 25 pictures; 75 files, 12.3 MB"
std::string describe_contents(const RunContents& contents);

// Locks the folder for the life of the object (flock on `lock`, which also holds the process id). Only rank 0 has one.
class RunDirectory {
 public:
  using Announce = std::function<void(const RunContents&)>;

  // Creates the folder if missing and locks it. Overwriting removes files of a run and nothing else, after telling
  // `announce` of them if there are some. Throws Error(output_failed) if the folder is not writable or locked by
  // another job, Error(bad_input) if it already holds output (refuse), files with the names of a run's but no run
  // (overwrite), or no run (resume).
  RunDirectory(const std::filesystem::path& folder, ExistingOutput policy, const Announce& announce = {});
  // Releases the lock and removes folders that this object created and that are still empty.
  ~RunDirectory();
  RunDirectory(const RunDirectory&) = delete;
  RunDirectory& operator=(const RunDirectory&) = delete;

  const RunPaths& paths() const { return paths_; }

 private:
  void create_folder();
  void take_lock();
  void drop_lock();
  void look_at_contents(ExistingOutput policy, const Announce& announce);
  void clear(const Announce& announce);

  RunPaths paths_;
  int lock_ = -1;
  std::vector<std::filesystem::path> created_;  // outermost first
};

}  // namespace seiche
