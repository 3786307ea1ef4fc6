#pragma once
// Runs that need not be made again, or only their rest: those of the same scene on as many ranks by a build that gives
// the same.
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "base/scene.h"

namespace seiche {

// Calls visit(ShapeSpec&) for all shapes of a scene, which may be const.
template <class AnyScene, class Visit>
void for_each_shape(AnyScene& scene, const Visit& visit) {
  for (auto& region : scene.liquid.regions) visit(region.shape);
  for (auto& source : scene.liquid.sources) visit(source.shape);
  for (auto& solid : scene.solids) {
    visit(solid.shape);
    for (auto& pin : solid.elastic.pinned) visit(pin.shape);
    for (auto& traction : solid.elastic.tractions) visit(traction.shape);
  }
}

// "3d5a0c11 of 1024 bytes". Throws Error(bad_input) where the file cannot be read.
std::string checksum_of(const std::filesystem::path& file);

// A line of checksum for each file that the scene names, in their order. Throws Error(bad_input).
std::string checksums_of_files(const Scene& scene);

// What makes a run the same but for its scene: version and digest of the build (base/version.h), ranks, what is broken
// for a test, the bytes of the files that the scene names. Throws Error(bad_input) where such a file cannot be read.
std::string run_identity(const Scene& scene, int ranks, const std::string& tampering);

// The machine on which a kept run was made (machine.h); empty where that was not noted.
std::string machine_of(const std::filesystem::path& run);

enum class Earlier { use, ignore };

// Whether the run in a folder ended with its last frame.
bool is_finished(const std::filesystem::path& run);

// Runs by scene and identity: finished ones, and those that were stopped or killed. On rank 0 alone.
class RunCache {
 public:
  // Looks at the runs in out/<case>/<resolution>/ unless earlier ones are to be ignored.
  RunCache(std::filesystem::path out, Earlier earlier);
  // Looks again, for what other jobs have made meanwhile.
  void look();
  // The folder of such a run that is finished, if there is one.
  std::optional<std::filesystem::path> find(const Scene& scene, const std::string& identity) const;
  // The folder of such a run that may go on, its checkpoints unseen, if no other job works there.
  std::optional<std::filesystem::path> find_begun(const Scene& scene, const std::string& identity) const;
  // Such a run is about to be made in this folder: removes what there is, and leaves what find_begun looks for until
  // the run is kept. Throws Error(output_failed), where another job works there too.
  void begin(const std::filesystem::path& run, const Scene& scene, const std::string& identity);
  // Remembers the run, here and in its folder, with this machine. Throws Error(output_failed).
  void keep(const std::filesystem::path& run, const std::string& identity);

 private:
  std::filesystem::path out_;
  Earlier earlier_;
  std::map<std::string, std::filesystem::path> runs_;  // by identity and scene, after `unfinished` where it is so
};

}  // namespace seiche
