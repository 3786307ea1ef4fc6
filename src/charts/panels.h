#pragma once
// Panels of the tables of runs.
#include <map>

#include "charts/run.h"
#include "charts/sheet.h"
#include "charts/table.h"

namespace seiche::charts {

// A run and those of its tables that were asked for.
struct RunTables {
  std::string label;  // tells runs apart
  std::filesystem::path folder;
  std::map<std::string, Table> tables;
  int dimension = 3;
  std::map<std::string, std::string> probe_units;  // by name

  // Takes dimension and probes from the run's scene; without one they stay unknown.
  void read_scene_of_run();
  // Reads the table where it was not yet. Null if the run has none.
  const Table* table(const std::string& name);
};

// The panels of the columns that are asked for: one a unit; columns without a unit have panels of their own.
std::vector<Panel> panels_of_columns(std::vector<RunTables>& runs, const PlotOptions& options);

// A sheet of energy, volume, solver, step, speed, and probes.
std::vector<Panel> usual_panels(std::vector<RunTables>& runs, const PlotOptions& options);

}  // namespace seiche::charts
