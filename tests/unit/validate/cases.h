#pragma once
// Small cases for tests of `seiche validate`.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "unit/files/scratch.h"
#include "validate/run/run.h"

namespace seiche {

namespace fs = std::filesystem;

// Liquid that moves at 1 m/s through a periodic box.
inline const char* const scene_text = R"(dimension = 2
gravity = [0.0, 0.0]
[domain]
upper = [1.0, 1.0]
cell_size = 0.125
[domain.boundary]
x_lower = "periodic"
x_upper = "periodic"
y_lower = "periodic"
y_upper = "periodic"
[time]
end = 0.2
frame_rate = 5.0
[liquid]
velocity = [1.0, 0.0]
[[liquid.region]]
shape = "expression"
phi = "-1"
)";

inline std::string case_text(const std::string& column, double bar) {
  return "title = \"t\"\ntags = [\"one\"]\nscene = \"scene.toml\"\nmax_error = " + std::to_string(bar) +
         "\n[measure]\nkind = \"max_of_column\"\ncolumn = \"" + column +
         "\"\n[[resolution]]\nname = \"8\"\n[[resolution]]\nname = \"16\"\nlevels = [\"full\"]\nset = "
         "[\"domain.cell_size=0.0625\"]\n";
}

// A change relative to an initial value of zero.
inline std::string unmeasurable_text() {
  std::string text = case_text("volume_corrected", 1);
  text.replace(text.find("max_of_column\"\n"), 15, "column_drift\"\n");
  return text;
}

inline void put_case(const ScratchFolder& folder, const std::string& name, const std::string& text) {
  fs::create_directories(folder.path() / "cases" / name);
  put(folder.path() / "cases" / name / "case.toml", text);
  put(folder.path() / "cases" / name / "scene.toml", scene_text);
}

struct Outcome {
  ExitCode code;
  std::string table, json;
};

inline Outcome validate(const ScratchFolder& folder, const std::vector<std::string>& words, const std::string& level,
                        ValidateOptions options = {}, const std::function<void(const std::string&)>& live = {}) {
  const Communicator ranks;
  const EmergencyChannel emergency(ranks);
  Outcome outcome;
  Console console;
  console.line = [&outcome](const std::string& text) { outcome.table += text + "\n"; };
  console.warning = [](const std::string&) {};
  console.live = live;
  options.words = words;
  options.level = level;
  options.cases = folder / "cases";
  options.out = folder / "out";
  options.threads = 1;
  outcome.code = validate_command(options, {ranks, emergency, console});
  outcome.json = contents(folder / "out" / "validation.json");
  return outcome;
}

}  // namespace seiche
