#pragma once
// Cells of air that a flow brings more liquid in a step than they hold, as where two surfaces meet or a cavity closes.
// They take part in the solve: their pressure lets in what fills them, and no more.
#include "coupling/state/state.h"

namespace seiche {

// Cells that the solve counts as liquid.
template <int Dim>
struct Filling {
  CellField<Dim> inflow;  // what fills them, per face area, m/s; empty: there are none
  CellField<Dim> phi;     // m, before any of them counted as liquid

  bool empty() const { return inflow.empty(); }
};

// A step over dt (s): shares V of liquid, the flow before it, continued into air (m/s), the mean gravity in it, and the
// room beside solids.
template <int Dim>
struct FillingStep {
  const CellField<Dim>& share;
  const FaceField<Dim>& before;
  Vec3 gravity;
  double dt;
  Room<Dim> room = {};
  const Exterior<Dim>* exterior = nullptr;  // cells of air with a pressure do not fill; null: there are none
};

// Cells with phi >= 0 (m) beside liquid that have no room for what the flow u (m/s) brings, with solids where they are;
// those of the first layer around the owned ones, too. Local.
template <int Dim>
std::vector<Site> overfull_cells(const Domain<Dim>& domain, const FillingStep<Dim>& step, const FaceField<Dim>& u,
                                 const CellField<Dim>& phi);

// Finds cells with phi >= 0 (m) beside liquid that have no room for what the flow u (m/s) brings. Adds them to
// `filling`, but for those with a host (Room); sets phi < 0 there, and u* on their faces. Returns false if there are
// none, or no other air beside liquid: in a closed box its volume could not change. Collective.
template <int Dim>
bool add_filling_cells(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const FillingStep<Dim>& step,
                       const FaceField<Dim>& u, CellField<Dim>& phi, FaceField<Dim>& u_star, Filling<Dim>& filling);

}  // namespace seiche
