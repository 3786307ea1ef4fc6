#pragma once
// The [measure] of a validation case.
#include <filesystem>
#include <string>

#include "base/formula.h"

namespace seiche {

// A measure of a finished run, by a name of the tables in kinds_*.cpp. Each kind uses some of these keys.
struct MeasureSpec {
  std::string kind;
  VectorFormula velocity{"0", "0", "0"};       // exact, in x, y, z, t, m/s
  Formula region = "-1";                       // of the faces that count, negative inside, in x, y, z, t
  Formula surface = "0";                       // exact distance to the surface, in x, y, z, t, m
  std::string probe, minus, column, solid;     // names; minus: a second probe
  Formula level = "0", reference = "0";        // constants
  Formula time_unit = "1", length_unit = "1";  // constants, s and m: scales of times and lengths
  Formula unit = "1";                          // unit of a figure
  double from = 0, to = 0;                     // dimensionless lengths; s for solids and columns of probes
  std::filesystem::path data;                  // CSV: header and two columns, or the columns of lines.h
};

}  // namespace seiche
