#pragma once
// The CSV tables of a run, read back.
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace seiche::charts {

struct Table {
  std::vector<std::string> columns;         // as in the header, without "name"
  std::vector<std::vector<double>> values;  // one list a column; NaN where a cell is empty
  std::vector<std::string> names;           // of each row; empty if the table has no column "name"

  std::size_t rows() const { return values.empty() ? 0 : values[0].size(); }
  // Index of a column; columns.size() if there is none.
  std::size_t find(const std::string& column) const;
  // The different names in order of appearance; {""} for a table without names.
  std::vector<std::string> entities() const;
};

// Reads a table with a header. A last line without its end, as a run in progress leaves it, is left out. Throws
// Error(bad_input) naming file and line.
Table read_table(const std::filesystem::path& file);

}  // namespace seiche::charts
