#pragma once
// What of the validation cases the user asks for.
#include <string>
#include <vector>

#include "validate/case/case.h"

namespace seiche {

// Words are names of cases, tags, and case/run for a single run; none at all choose everything. A word that is a case's
// name is no tag. Points into the cases.
class Selection {
 public:
  // Throws Error(bad_input) naming a word that fits nothing, with the nearest one that does.
  Selection(const std::vector<CaseSpec>& cases, std::vector<std::string> words);

  // Whether the case, or a run of it of any level, is chosen.
  bool takes(const CaseSpec& one) const;
  // Of the runs of the level, and of others those chosen by case/run.
  bool takes(const CaseSpec& one, const ResolutionSpec& run, const std::string& level) const;

 private:
  bool takes_whole(const CaseSpec& one) const;

  const std::vector<CaseSpec>* cases_;
  std::vector<std::string> words_;
};

}  // namespace seiche
