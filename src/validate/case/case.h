#pragma once
// Validation cases: a folder with a case.toml, its scenes and its reference data. docs/validating.md tells the keys.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/scene.h"
#include "scene/reader.h"
#include "validate/measure/spec.h"

namespace seiche {

// The measured series over a reference's, for the report.
struct PlotSpec {
  std::filesystem::path data;                 // CSV: header and two columns
  Formula time_unit = "1", value_unit = "1";  // constants: what makes times and values what the columns hold
  std::string x = "time, s", y = "value";     // names of the axes
};

struct ResolutionSpec {
  std::string name;
  std::optional<std::filesystem::path> scene;  // unset: the case's
  std::vector<std::string> levels{"quick", "full"};
  std::vector<Override> overrides;
  std::optional<double> max_error;   // unset: the case's
  std::optional<Formula> reference;  // unset: the measure's
  std::string others;                // what others report at this resolution
  std::string series;                // of runs that differ in the grid alone; those that name none make one
};

struct CaseSpec {
  std::string name;  // of its folder
  std::filesystem::path folder;
  std::string title, others;
  std::string known;  // why bars are missed, as far as known
  std::vector<std::string> tags;
  std::filesystem::path scene;
  MeasureSpec measure;
  PlotSpec plot;  // no data: none
  std::optional<double> max_error, min_order;
  std::vector<ResolutionSpec> resolutions;
};

// Reads folder/case.toml. Throws Error(bad_input) with a line for each problem.
CaseSpec read_case(const std::filesystem::path& folder);

// All cases below a folder, by name. Throws Error(bad_input).
std::vector<CaseSpec> read_cases(const std::filesystem::path& folder);

// What lies there beside the cases and would be one, had it a case.toml; by name.
std::vector<std::filesystem::path> folders_without_case(const std::filesystem::path& folder);

bool belongs_to(const ResolutionSpec& resolution, const std::string& level);
const std::filesystem::path& scene_of(const CaseSpec& one, const ResolutionSpec& resolution);
std::optional<double> max_error_of(const CaseSpec& one, const ResolutionSpec& resolution);
// The least order that is asked for over three resolutions or more is that of a fit; what two of them show may be this
// much less.
constexpr double order_scatter = 0.2;

const Formula& reference_of(const CaseSpec& one, const ResolutionSpec& resolution);
// Whether two runs of a case refine the same thing, so that orders are taken over them: the same series and reference.
bool same_series(const CaseSpec& one, const ResolutionSpec& a, const ResolutionSpec& b);
// The case's measure with the reference of this resolution.
MeasureSpec measure_of(const CaseSpec& one, const ResolutionSpec& resolution);

// Where the cases are when the user does not say: `here`/validation, else share/seiche/validation beside the folder
// of the program, else the source tree around build/<preset>/. Throws Error(bad_input) naming the places looked at.
std::filesystem::path find_cases_folder(const std::filesystem::path& here, const std::filesystem::path& program);

// The running program's file.
std::filesystem::path program_file();

}  // namespace seiche
