#pragma once
// Liquid and solids of a scene at its start, for people and for programs.
#include <string>
#include <vector>

#include "coupling/state/start_account.h"
#include "files/json.h"

namespace seiche {

// Lines of a table: the liquid, then a row a solid with its kind, mass, density, volume, centre, size and draught.
// Solids beyond the first forty are counted.
std::vector<std::string> start_table(const StartAccount& start, int dimension);

// The same as JSON, all solids: {"liquid": {...}, "solids": [...], "notes": [...]}; numbers in SI units.
JsonMembers start_json(const StartAccount& start, int dimension);

}  // namespace seiche
