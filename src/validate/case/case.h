#pragma once
// Validation cases: a folder with a case.toml, its scenes and its reference data. docs/validating.md describes the
// keys.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/formula.h"
#include "scene/reader.h"
#include "validate/measure/spec.h"

namespace seiche {

// Plot of the measured series over that of a reference, for the report.
struct PlotSpec {
  std::filesystem::path data;                 // CSV: header and two columns
  Formula time_unit = "1", value_unit = "1";  // constants: units of the columns
  std::string x = "time, s", y = "value";     // names of the axes
};

struct ResolutionSpec {
  std::string name;
  std::optional<std::filesystem::path> scene;  // unset: the scene of the case
  std::vector<std::string> levels{"quick", "full"};
  std::vector<Override> overrides;
  std::optional<double> max_error;   // unset: that of the case
  std::optional<Formula> reference;  // unset: that of the measure
  std::string others;                // results of others at this resolution
  std::string series;  // name of the series of runs that differ in the grid only; unnamed runs form one series
};

struct CaseSpec {
  std::string name;  // of its folder
  std::filesystem::path folder;
  std::string title, others;
  std::string known;  // known causes of missed bars
  std::vector<std::string> tags;
  std::filesystem::path scene;
  MeasureSpec measure;
  PlotSpec plot;  // without data: no plot
  std::optional<double> max_error, min_order;
  std::vector<ResolutionSpec> resolutions;
};

// Reads folder/case.toml. Throws Error(bad_input) with a line for each problem.
CaseSpec read_case(const std::filesystem::path& folder);

// Reads all cases below a folder, by name. Throws Error(bad_input).
std::vector<CaseSpec> read_cases(const std::filesystem::path& folder);

// Folders beside the cases that lack a case.toml, by name.
std::vector<std::filesystem::path> folders_without_case(const std::filesystem::path& folder);

bool belongs_to(const ResolutionSpec& resolution, const std::string& level);
const std::filesystem::path& scene_of(const CaseSpec& one, const ResolutionSpec& resolution);
std::optional<double> max_error_of(const CaseSpec& one, const ResolutionSpec& resolution);
// min_order is for a fit over three resolutions or more. The order of two resolutions may be lower by this.
constexpr double order_scatter = 0.2;

const Formula& reference_of(const CaseSpec& one, const ResolutionSpec& resolution);
// True if two runs of a case belong to one convergence study: equal series and reference.
bool same_series(const CaseSpec& one, const ResolutionSpec& a, const ResolutionSpec& b);
// The measure of the case with the reference of this resolution.
MeasureSpec measure_of(const CaseSpec& one, const ResolutionSpec& resolution);

// Default folder of the cases: `here`/validation, else share/seiche/validation beside the program's folder, else the
// source tree around build/<preset>/. Throws Error(bad_input) naming the places searched.
std::filesystem::path find_cases_folder(const std::filesystem::path& here, const std::filesystem::path& program);

}  // namespace seiche
