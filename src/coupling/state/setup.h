#pragma once
// The scene as the simulation uses it, fixed for the run.
#include <algorithm>
#include <map>
#include <memory>

#include "coupling/state/exterior.h"
#include "coupling/state/features.h"
#include "coupling/state/fluids.h"
#include "coupling/state/force.h"
#include "coupling/state/operator_perturbation.h"
#include "coupling/state/solids.h"
#include "coupling/state/source.h"
#include "coupling/state/sponge.h"
#include "fluid/boundary/domain.h"
#include "fluid/volume/ledger.h"
#include "solid/mesh/point.h"

namespace seiche {

struct Scene;

// Functions take the members that they read. Only functions that concern a whole step or scene take all of Setup.
template <int Dim>
struct Setup {
  std::shared_ptr<const Scene> scene;  // incomplete here: who reads a key includes base/scene.h
  OperatorPerturbation perturbation;
  std::vector<std::string> notes;  // from reading the shapes, for the log
  Fluids fluids;
  Domain<Dim> domain;
  std::vector<Force<Dim>> forces;  // before the solids, which refer to them
  Solids<Dim> solids;
  OwnedExterior<Dim> exterior;               // before its start
  std::vector<Source<Dim>> sources, drains;  // whose shapes are kept full and empty
  std::vector<Source<Dim>> feeds;            // sources and drains with a rate
  std::vector<Sponge> sponges;
  std::map<std::string, MaterialPoint> followed;  // points of displacement probes, by probe name
  Features features;
  std::string shift_because;                         // why a shift keeps the volume by default; empty: cells do
  std::shared_ptr<const OpenParts<Dim>> open_parts;  // if tracks_volume() beside solids, none of which moves; else null

  // `blocks`: owned cells of each rank; empty: of equal size.
  Setup(const Scene& scene, const Communicator& ranks, const OperatorPerturbation& perturbation = {},
        std::vector<Box<Dim>> blocks = {});

  // True if the liquid's volume is a field of its own (State::liquid), not kept by a shift of the level set.
  bool tracks_volume() const {
    if (fluids.liquid.volume != VolumeKeeping::automatic) return fluids.liquid.volume == VolumeKeeping::in_cells;
    return shift_because.empty();
  }
  // True if liquid or gas is there at the start, or sides and sources may bring it.
  bool may_have_fluid() const {
    return !fluids.liquid.regions.empty() || !sources.empty() || !feeds.empty() || domain.sides.any_passes() ||
           fluids.gas.present;
  }
  // True if State::liquid belongs to the time of the solve, the middle of a step.
  bool volume_lags() const { return tracks_volume() && !fluids.has_prescribed_flow(); }
  // True if volumes are carried, and liquid beyond the surface flies freely.
  bool volume_meets_void() const { return volume_lags() && !fluids.has_gas(); }
  // True if initial velocities need not fit the solids, the sides that volumes pass, the feeds and the gas.
  bool volume_sets_off() const {
    return volume_lags() && (!solids.bodies.empty() || domain.sides.any_passes() || !feeds.empty() || fluids.has_gas());
  }
  // True if the room for liquid in cells changes, State::open.
  bool room_changes() const {
    return tracks_volume() && (fluids.liquid.separates || !solids.bodies.empty()) && !open_parts;
  }
  Divergence divergence() const { return fluids.has_prescribed_flow() ? Divergence::swells : Divergence::stays; }
};

}  // namespace seiche
