#pragma once
// Plots of runs' tables.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace seiche::charts {

struct PlotOptions {
  std::vector<std::filesystem::path> runs;  // run directories; their curves share panels
  std::string table;                        // stats, solids, probes, joints; empty: the first that has the columns
  std::vector<std::string> columns;         // names or groups; empty: a sheet of the most useful ones
  std::vector<std::string> names;           // of solids, probes, joints; empty: all
  std::filesystem::path out;                // .png, .svg, .pdf; empty: pictures/plot.png of the first run
  int width = 0, height = 0;                // pixels; 0: by the number of panels
  bool logarithmic = false;
  std::string font;
};

// Draws the plot and returns its file. Throws Error(bad_input) that lists the columns or names that exist,
// Error(output_failed).
std::filesystem::path plot_runs(const PlotOptions& options);

}  // namespace seiche::charts
