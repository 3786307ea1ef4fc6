#pragma once
// Units of the tables' columns, and short names for several of them.
#include <string>
#include <vector>

#include "charts/table.h"

namespace seiche::charts {

// Unit of a column of a table ("stats", "solids", "joints", "probes") as docs/outputs.md has it; "" where it is a
// number or is not known.
std::string unit_of(const std::string& table, const std::string& column);

// The unit of the same quantity in 2D, where volumes are areas, and masses, forces and energies count per m of depth.
std::string unit_in_2d(const std::string& unit);

// Names of the tables in the order in which columns are searched.
const std::vector<std::string>& table_names();

// The columns that a word of --columns means in a table: itself, or those of a group such as "energy", "volume",
// "force". Empty if the table has none of them.
std::vector<std::string> columns_meant(const Table& table, const std::string& word);

// Words of groups that the table has columns for.
std::vector<std::string> groups_of(const Table& table);

}  // namespace seiche::charts
