#pragma once
// The folder of one run: its layout, its lock, and what may happen to what is already there.
#include <filesystem>
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
  std::filesystem::path probes() const { return folder / "probes.csv"; }
  std::filesystem::path pictures() const { return folder / "pictures"; }
  std::filesystem::path summary() const { return folder / "summary.json"; }
  std::filesystem::path log() const { return folder / "log.txt"; }
  std::filesystem::path stop() const { return folder / "stop"; }
  std::filesystem::path lock() const { return folder / "lock"; }
};

enum class ExistingOutput { refuse, overwrite, resume };

// Files that overwriting took away.
struct RemovedFiles {
  int pictures = 0, others = 0;
};

// Holds the folder for the life of the object (an flock on `lock`, which also holds the process id). Rank 0 owns the
// only one of a run.
class RunDirectory {
 public:
  // Creates the folder where missing and locks it. Throws Error(output_failed) when it cannot be written or another job
  // holds it, and Error(bad_input) when it holds output already (refuse) or holds no run (resume). Overwriting removes
  // the files of a run and nothing else.
  RunDirectory(const std::filesystem::path& folder, ExistingOutput policy);
  // Releases the lock; folders that this object created and nothing was put into are removed again.
  ~RunDirectory();
  RunDirectory(const RunDirectory&) = delete;
  RunDirectory& operator=(const RunDirectory&) = delete;

  const RunPaths& paths() const { return paths_; }
  const RemovedFiles& removed() const { return removed_; }

 private:
  void create_folder();
  void take_lock();
  void drop_lock();
  void look_at_contents(ExistingOutput policy);

  RunPaths paths_;
  RemovedFiles removed_;
  int lock_ = -1;
  std::vector<std::filesystem::path> created_;  // outermost first
};

}  // namespace seiche
