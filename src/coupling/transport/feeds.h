#pragma once
// Feeds: sources and drains with a rate. The liquid in their shapes swells or shrinks, and the pressure passes it on:
//   div u = +-rate/V.  Cells share a rate by the room for liquid that they have within the shape.
#include <functional>
#include <vector>

#include "coupling/state/source.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"
#include "fluid/volume/volume_transport.h"

namespace seiche {

// Volume that a feed brings from t0 to t1 where its shape is full of liquid, m^Dim; negative for drains.
template <int Dim>
double volume_of_feed(const Source<Dim>& feed, double t0, double t1);

// Places of feeds: level set (m), and room for liquid of a cell beside solids, as a share of it.
template <int Dim>
struct FedLiquid {
  const CellField<Dim>& phi;
  std::function<double(Site)> room;

  // As at the solve that led to a state. psi: distance to the solids at nodes (m).
  FedLiquid(const Layout<Dim>& layout, const State<Dim>& solved, const NodeField<Dim>& psi);
  // The same for volumes in cells alone.
  explicit FedLiquid(const State<Dim>& solved);
};

// Volume that feeds bring into each cell from t0 to t1, m^Dim. A drain takes its rate times the part of its shape that
// holds liquid, since it takes air as well; a source brings all of it, but nothing without liquid. Collective.
template <int Dim>
CellValues brought_by_feeds(const Domain<Dim>& domain, const std::vector<Source<Dim>>& feeds,
                            const FedLiquid<Dim>& liquid, double t0, double t1);

// Flags of the sources that bring nothing from t0 to t1 for want of liquid in their shape. Collective.
template <int Dim>
std::vector<char> dry_sources(const Domain<Dim>& domain, const std::vector<Source<Dim>>& feeds,
                              const FedLiquid<Dim>& liquid, double t0, double t1);

// Sum of such values over all ranks. Collective.
template <int Dim>
double sum_of_cells(const Domain<Dim>& domain, const CellValues& values);

// Sets cell_flux to what must leave cells at the mean rates from t to t + dt, in which the flow that is solved for will
// carry the liquid. Returns what is brought into each cell, m^Dim/s. Collective.
template <int Dim>
CellValues set_flux_of_feeds(const Domain<Dim>& domain, const std::vector<Source<Dim>>& feeds,
                             const FedLiquid<Dim>& liquid, double t, double dt, FaceGeometry<Dim>& faces);

// Power of the pressure (Pa) on what feeds bring (m^Dim/s), and kinetic energy that this has at the velocity u (m/s),
// W. Collective.
template <int Dim>
double power_of_feeds(const Domain<Dim>& domain, double density, const CellValues& brought,
                      const CellField<Dim>& pressure, const FaceField<Dim>& u);

}  // namespace seiche
