#include "linalg/precond/preconditioners.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "linalg/precond/geometric_multigrid.h"
#include "linalg/precond/hypre_adapter.h"

namespace seiche {
namespace {

// z_i = r_i / a_ii
class DiagonalScaling : public Preconditioner {
 public:
  explicit DiagonalScaling(const LinearSystem& system) : inverse_(system.rows()) {
    for (int i = 0; i < system.rows(); ++i) inverse_[i] = 1 / std::abs(system.diagonal(i));
  }
  void apply(const Vector& r, Vector& z) override {
    for (std::size_t i = 0; i < r.size(); ++i) z[i] = inverse_[i] * r[i];
  }

 private:
  std::vector<double> inverse_;
};

PreconditionerOrFailure diagonal_scaling(const LinearSystem& system) {
  return {std::make_unique<DiagonalScaling>(system), {}};
}
PreconditionerOrFailure boomeramg(const LinearSystem& system) {
  // Rows of enclosed air couple to thousands of cells and are not on the grid. Aggressive coarsening then needs more
  // iterations (docs/decisions/0012-enclosed-air.md).
  const bool on_grid = box_of_rows(system).cells() > 0;
  return on_grid ? make_boomeramg(system) : make_boomeramg(system, {.aggressive_levels = 0});
}
PreconditionerOrFailure geometric(const LinearSystem& system) {
  return make_geometric_multigrid(system);
}
PreconditionerOrFailure multigrid(const LinearSystem& system) {
  return make_pfmg(system);
}

constexpr PreconditionerEntry table[] = {
    {"none", "each row scaled by its diagonal", diagonal_scaling},
    {"boomeramg", "algebraic multigrid (hypre BoomerAMG): any liquid shape", boomeramg},
    {"geometric", "geometric multigrid of our own on the box around the liquid", geometric},
    {"multigrid", "geometric multigrid (hypre PFMG) on the box around the liquid", multigrid},
};

// docs/decisions/0002-preconditioner-choice.md, 0032-geometric-multigrid.md
constexpr std::int64_t rows_worth_a_hierarchy = 2000;
constexpr double share_worth_a_box = 0.05;

}  // namespace

std::span<const PreconditionerEntry> preconditioner_table() {
  return table;
}

std::vector<std::string> preconditioner_names() {
  std::vector<std::string> names{"auto"};
  for (const auto& entry : table) names.emplace_back(entry.name);
  return names;
}

bool keeps_to_grid(const std::string& name) {
  return name == "geometric" || name == "multigrid";
}

std::string choose_preconditioner(const std::string& name, const LinearSystem& system) {
  if (name != "auto") return name;
  const auto rows = system.pattern().global_rows;
  if (rows < rows_worth_a_hierarchy) return "none";
  const std::int64_t box = box_of_rows(system).cells();  // 0 if some row is not on the grid (enclosed air)
  return box > 0 && double(rows) >= share_worth_a_box * double(box) ? "geometric" : "boomeramg";
}

PreconditionerOrFailure make_preconditioner(const std::string& name, const LinearSystem& system) {
  const auto entry = std::find_if(std::begin(table), std::end(table), [&](const auto& e) { return name == e.name; });
  if (entry != std::end(table)) return entry->make(system);
  throw Error(ExitCode::bad_input, fmt::format("there is no preconditioner '{}'; there are {}", name,
                                               fmt::join(preconditioner_names(), ", ")));
}

}  // namespace seiche
