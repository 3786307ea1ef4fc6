#pragma once
// The validation cases that the user selects.
#include <string>
#include <vector>

#include "validate/case/case.h"

namespace seiche {

// Words are names of cases, tags, or case/run for a single run; no words select everything. A case's name takes
// precedence over a tag. Points into the cases.
class Selection {
 public:
  // Throws Error(bad_input) naming a word that matches nothing, with the nearest one that does.
  Selection(const std::vector<CaseSpec>& cases, std::vector<std::string> words);

  // True if the case, or any run of it at any level, is selected.
  bool takes(const CaseSpec& one) const;
  // Selects runs of the level, and runs of other levels if named by case/run.
  bool takes(const CaseSpec& one, const ResolutionSpec& run, const std::string& level) const;

 private:
  bool takes_whole(const CaseSpec& one) const;

  const std::vector<CaseSpec>* cases_;
  std::vector<std::string> words_;
};

}  // namespace seiche
