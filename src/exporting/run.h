#pragma once
// Writes a run's frames in the forms of other programs.
#include <filesystem>
#include <functional>
#include <string>

namespace seiche::exporting {

struct ExportOptions {
  std::filesystem::path run;  // the run directory
  std::filesystem::path out;  // folder; empty: <run>/export
  std::string format;         // one of formats()
  std::string frames = "all";
  std::string up{};  // axis that points up in the files: scene, y, z; empty: as the scene's output.up says
};

// Names of the formats with a line on each.
const std::vector<std::pair<std::string, std::string>>& formats();

// `say` gets lines of text for the user. Throws Error(bad_input) for a folder that holds no run or no such frames, and
// for 2D runs where the format has surfaces only; Error(output_failed).
void export_run(const ExportOptions& options, const std::function<void(const std::string&)>& say);

}  // namespace seiche::exporting
