#pragma once
// The [measure] of a validation case.
#include <filesystem>
#include <string>

#include "base/scene.h"

namespace seiche {

// What is measured on a finished run, by a name of the tables in kinds_*.cpp. Each kind uses some of these.
struct MeasureSpec {
  std::string kind;
  VectorFormula velocity{"0", "0", "0"};       // exact, in x, y, z, t, m/s
  Formula region = "-1";                       // of faces that count, negative inside, in x, y, z, t
  Formula surface = "0";                       // exact distance to the surface, in x, y, z, t, m
  std::string probe, minus, column, solid;     // names; minus: of a second probe
  Formula level = "0", reference = "0";        // constants
  Formula time_unit = "1", length_unit = "1";  // constants, s and m: what makes times and lengths dimensionless
  Formula unit = "1";                          // that a figure is counted in
  double from = 0, to = 0;                     // dimensionless lengths; of solids and of columns of probes: s
  std::filesystem::path data;                  // CSV: header and two columns, or those of csv_lines()
};

}  // namespace seiche
