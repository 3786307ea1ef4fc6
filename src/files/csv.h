#pragma once
// Rows of stats.csv, solids.csv, joints.csv and probes.csv. Numbers have 17 digits, so they read back bit for bit.
#include <string>
#include <variant>
#include <vector>

#include "coupling/state/simulation.h"

namespace seiche {

// A column of a table with its value in one row.
struct TableColumn {
  const char* name;
  std::variant<double, std::int64_t> value;
};

std::vector<TableColumn> columns_of(const StepStats& stats);
std::vector<TableColumn> columns_of(const JointReport& joint);  // without time and name

std::string stats_header();
std::string stats_row(const StepStats& stats);

std::string solids_header();
std::string solids_row(double time, const SolidState& solid);

std::string joints_header();
std::string joints_row(double time, const JointReport& joint);

std::string probes_header();
// Scalars fill `value`, vectors x, y, z; other fields stay empty, and all of them for an undefined sample.
std::string probes_row(double time, const ProbeSample& sample);

// Name of the row's first non-finite number, or "".
std::string not_finite(const StepStats& stats);
std::string not_finite(const SolidState& solid);
std::string not_finite(const JointReport& joint);
std::string not_finite(const ProbeSample& sample);

}  // namespace seiche
