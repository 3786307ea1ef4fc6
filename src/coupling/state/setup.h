#pragma once
// A scene as the simulation has it, fixed for the run.
#include <map>
#include <memory>

#include "base/scene.h"
#include "coupling/state/features.h"
#include "coupling/state/fluids.h"
#include "coupling/state/operator_perturbation.h"
#include "coupling/state/solids.h"
#include "coupling/state/source.h"
#include "fluid/boundary/domain.h"
#include "solid/mesh/point.h"

namespace seiche {

// Functions take the members that they read. Those for which a whole step or scene is meant take all of it.
template <int Dim>
struct Setup {
  Scene scene;
  OperatorPerturbation perturbation;
  std::vector<std::string> notes;  // of reading the shapes, for the log
  Fluids fluids;
  Domain<Dim> domain;
  Solids<Dim> solids;
  std::vector<Source<Dim>> sources;
  std::map<std::string, MaterialPoint> followed;  // by displacement probes, by their names
  Features features;

  Setup(const Scene& scene, const Communicator& ranks, const OperatorPerturbation& perturbation = {});
};

}  // namespace seiche
