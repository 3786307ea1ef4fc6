#pragma once
// Preconditioners by name. A new one is a file and a row in the table of preconditioners.cpp.
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "linalg/core/linear_system.h"

namespace seiche {

class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  // z = B r with B symmetric positive (semi-)definite. Collective.
  virtual void apply(const Vector& r, Vector& z) = 0;
};

// A preconditioner, or the reason why there is none; the same on all ranks.
struct PreconditionerOrFailure {
  std::unique_ptr<Preconditioner> preconditioner;
  std::string failure;
};

struct PreconditionerEntry {
  const char* name;
  const char* description;
  PreconditionerOrFailure (*make)(const LinearSystem&);  // collective
};

std::span<const PreconditionerEntry> preconditioner_table();

// Names that a scene may use: "auto" and those of the table.
std::vector<std::string> preconditioner_names();

// True if a preconditioner needs rows that couple neighbouring cells alone.
bool keeps_to_grid(const std::string& name);

// Replaces "auto" by the choice for this system; returns any other name unchanged. Collective.
std::string choose_preconditioner(const std::string& name, const LinearSystem& system);

// Throws Error(bad_input) for a name that is not in the table. Collective.
PreconditionerOrFailure make_preconditioner(const std::string& name, const LinearSystem& system);

}  // namespace seiche
