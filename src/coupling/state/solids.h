#pragma once
// The solids of a scene, fixed for the run: shapes, kinds, and the state they begin with.
#include <optional>

#include "coupling/state/interaction.h"
#include "coupling/state/joint_rows.h"
#include "coupling/state/operator_perturbation.h"
#include "fluid/boundary/domain.h"
#include "geometry/mesh/facet_pieces.h"

namespace seiche {

struct Scene;
struct OperatorPerturbation;

// The part of a solid's surface in one cell.
template <int Dim>
struct PlacedPiece {
  IVec<Dim> cell;
  Vec<Dim> normal;                // outward
  std::vector<Vec<Dim>> corners;  // m; of a segment or a convex polygon
  double area = 0;                // m^(Dim-1)
};

// Keeps references to its own members: neither copied nor moved.
template <int Dim>
struct Solids {
  std::vector<Body<Dim>> bodies;
  JointSet<Dim> joints;
  PairCoefficients restitutions;  // of pairs that have one, by pairs as those of friction
  SharedPairs apart;              // pairs that joints or [[contact]] let reach into each other, ascending
  SolidGeometry<Dim> geometry;
  Participants<Dim> at_start;
  Interactions<Dim> interactions;
  std::optional<ContactScene<Dim>> contact;                 // set if any solid has unknowns
  std::vector<std::vector<PlacedPiece<Dim>>> still_pieces;  // pieces_of_still_solids()

  // Appends notes of reading the shapes, for the log. The domain and the forces must outlive the solids.
  Solids(const Scene& scene, const Domain<Dim>& domain, const std::vector<Force<Dim>>& forces,
         const OperatorPerturbation& perturbation, std::vector<std::string>& notes);
  Solids(const Solids&) = delete;

  bool has_unknowns() const;
  bool plans_steps() const;  // Participant::plans_steps
  // True if the coming step is planned: by participants, or by joints, which are closed where it will be solved for.
  bool leads_ahead() const { return plans_steps() || !joints.list.empty(); }
  bool may_seal() const;  // Participant::may_seal
};

}  // namespace seiche
