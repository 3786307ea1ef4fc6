#include "coupling/solids/solid_kinds.h"

#include <fmt/format.h>

#include "base/error.h"
#include "coupling/state/participant.h"

// One row a kind; each is in a file kind_*.cpp of its own.
#define SEICHE_SOLID_KINDS(ROW) \
  ROW(static_solid)             \
  ROW(kinematic_solid)          \
  ROW(rigid_solid)              \
  ROW(elastic_solid)            \
  ROW(deforming_solid)          \
  ROW(sprung_solid)

namespace seiche {

#define SEICHE_DECLARE(row) SolidKindRow row();
SEICHE_SOLID_KINDS(SEICHE_DECLARE)

const std::vector<SolidKindRow>& solid_kinds() {
#define SEICHE_CALL(row) row(),
  static const std::vector<SolidKindRow> rows{SEICHE_SOLID_KINDS(SEICHE_CALL)};
  return rows;
}

namespace {

const SolidKindRow& row_of(const SolidKind& kind) {
  for (const SolidKindRow& row : solid_kinds())
    if (row.kind == kind) return row;
  throw Error(ExitCode::bug, fmt::format("no row for solids of kind '{}'", kind.name));
}

}  // namespace

template <int Dim>
Participants<Dim> make_participants(const std::vector<Body<Dim>>& bodies) {
  std::vector<std::unique_ptr<Participant<Dim>>> list;
  for (const Body<Dim>& body : bodies) {
    const SolidKindRow& row = row_of(body.kind());
    if constexpr (Dim == 2)
      list.push_back(row.make_2d(body, int(list.size())));
    else
      list.push_back(row.make_3d(body, int(list.size())));
  }
  return Participants<Dim>(std::move(list));
}

template Participants<2> make_participants<2>(const std::vector<Body<2>>&);
template Participants<3> make_participants<3>(const std::vector<Body<3>>&);

}  // namespace seiche
