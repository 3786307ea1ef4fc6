#pragma once
// Liquid sources: a shape kept full while its source is open, and the velocity of the liquid that it brings.
#include <functional>
#include <optional>
#include <vector>

#include "coupling/state/solids.h"
#include "coupling/state/source.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Part of a step from t0 to t1 in which a source is open, s; empty optional if none. `oldest` and `youngest`: ages at
// t1 of the liquid that it brings in the step. Liquid from before t0 is already in the flow, so a source open before
// has one age only.
struct OpenTime {
  double begin = 0, end = 0, youngest = 0, oldest = 0;
};
std::optional<OpenTime> open_in_step(const LiquidSourceSpec& source, double t0, double t1);

// Liquid that sources brought: its volume (m^Dim), its kinetic energy over the density, m^(Dim+2)/s^2, and its share of
// each cell's volume if any source was open.
template <int Dim>
struct Brought {
  double volume = 0, kinetic = 0;
  std::optional<CellField<Dim>> share{};
};

// Sources whose shapes are kept full, and drains whose shapes are kept empty.
template <int Dim>
struct Openings {
  const std::vector<Source<Dim>>&sources, &drains;
  bool empty() const { return sources.empty() && drains.empty(); }
};

// Joins phi at t1 with the liquid that sources bring from t0 to t1, and takes away what lies in drains, with the solids
// as in `before`. Fills ghosts. Collective.
template <int Dim>
Brought<Dim> add_sources(const Domain<Dim>& domain, const Solids<Dim>& solids, const Openings<Dim>& openings,
                         const State<Dim>& before, double t0, double t1, CellField<Dim>& phi);

// The same for the shares of liquid in cells: fills them up to what lies within the sources, and empties them down to
// what lies beyond the drains, with the velocity u (m/s). psi: distance to the solids at nodes (m). Fills ghosts.
// Collective.
template <int Dim>
Brought<Dim> add_source_shares(const Domain<Dim>& domain, const Openings<Dim>& openings, const NodeField<Dim>& psi,
                               const FaceField<Dim>& u, double t0, double t1, CellField<Dim>& share);

// Joins phi at t1 with the liquid that sources keep from t0 to t1, without what lies in drains. Ghosts are not filled.
// Collective.
template <int Dim>
void join_sources(const Domain<Dim>& domain, const Openings<Dim>& openings, double t0, double t1, CellField<Dim>& phi);

// Share of a cell that lies in the shape of a source.
template <int Dim>
double share_within_shape(const Layout<Dim>& layout, const Source<Dim>& source, const IVec<Dim>& cell);

// Impulse on the fluid at a face, kg m/s (2D: kg/s).
struct FaceImpulse {
  int axis;
  Site face;
  double impulse;
};

// Sets the velocity u (m/s) on the faces within the liquid that sources bring from t0 to t1. Returns for each of these
// owned faces the impulse on the liquid that was there before. mass(axis, face): mass of that liquid, kg (2D: kg/m).
template <int Dim>
std::vector<FaceImpulse> set_source_velocity(const Domain<Dim>& domain, const std::vector<Source<Dim>>& sources,
                                             double t0, double t1, const std::function<double(int, Site)>& mass,
                                             FaceField<Dim>& u);

// Empty, or a text if a source's velocity is not finite within its shape at time t (s), on this rank.
template <int Dim>
std::string fault_of_source(const Domain<Dim>& domain, const std::vector<Source<Dim>>& sources, std::size_t index,
                            double t);

// Mass of liquid that a face of unknown velocity stands for, kg (2D: kg/m), where a source acts on what was there
// before: half of that in the cells beside it, less what the source has brought.
template <int Dim>
double mass_at_face(const Layout<Dim>& l, const Fluids& fluids, const CellField<Dim>& phi, const NodeField<Dim>& psi,
                    const CellField<Dim>* brought, int axis, Site face);

}  // namespace seiche
