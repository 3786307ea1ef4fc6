#pragma once
// Cache of runs: finished ones are reused, interrupted ones resumed. They must have the same scene, number of ranks and
// build digest.
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace seiche {

struct Scene;

// Calls visit(ShapeSpec&) for all shapes of a scene; the scene may be const.
template <class AnyScene, class Visit>
void for_each_shape(AnyScene& scene, const Visit& visit) {
  for (auto& region : scene.liquid.regions) visit(region.shape);
  for (auto& source : scene.liquid.sources) visit(source.shape);
  for (auto& drain : scene.liquid.drains) visit(drain.shape);
  for (auto& solid : scene.solids) {
    visit(solid.shape);
    for (auto& pin : solid.elastic.pinned) visit(pin.shape);
    for (auto& traction : solid.elastic.tractions) visit(traction.shape);
  }
}

// Checksum of a file, such as "3d5a0c11 of 1024 bytes". Throws Error(bad_input) if the file cannot be read.
std::string checksum_of(const std::filesystem::path& file);

// One checksum line for each file of the scene, in order. Throws Error(bad_input).
std::string checksums_of_files(const Scene& scene);

// Identity of a run besides its scene: version and digest of the build (base/version.h), ranks, operators broken for a
// test, and checksums of the scene's files. Throws Error(bad_input) if such a file is unreadable.
std::string run_identity(const Scene& scene, int ranks, const std::string& perturbation);

// Machine of a stored run (machine.h); empty if it was not recorded.
std::string machine_of(const std::filesystem::path& run);

enum class Earlier { use, ignore };

// True if the run in a folder reached its last frame.
bool is_finished(const std::filesystem::path& run);

// Runs by scene and identity: finished ones, and stopped or killed ones. On rank 0 only.
class RunCache {
 public:
  // Reads the runs in out/<case>/<resolution>/ unless earlier ones are to be ignored.
  RunCache(std::filesystem::path out, Earlier earlier);
  // Reads them again, to find runs of concurrent jobs.
  void look();
  // Folder of a finished run with this scene and identity, if any.
  std::optional<std::filesystem::path> find(const Scene& scene, const std::string& identity) const;
  // Folder of an interrupted run that may be resumed, if any and if no other job works there. Checkpoints are not
  // verified.
  std::optional<std::filesystem::path> find_begun(const Scene& scene, const std::string& identity) const;
  // Call it before a run: empties the folder and marks it for find_begun() until keep(). Throws Error(output_failed),
  // also if another job works there.
  void begin(const std::filesystem::path& run, const Scene& scene, const std::string& identity);
  // Stores the run's identity and this machine, here and in its folder. Throws Error(output_failed).
  void keep(const std::filesystem::path& run, const std::string& identity);

 private:
  std::filesystem::path out_;
  Earlier earlier_;
  std::map<std::string, std::filesystem::path> runs_;  // by identity and scene; interrupted ones after `unfinished`
};

}  // namespace seiche
