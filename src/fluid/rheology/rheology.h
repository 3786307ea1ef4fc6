#pragma once
// Liquids whose viscosity mu(r) depends on the shear rate r = sqrt(2 D:D), 1/s, D = (grad u + grad u') / 2.
#include <span>
#include <string>
#include <string_view>

#include "base/fluid_spec.h"
#include "grid/halo.h"

namespace seiche {

struct Scene;

// A row of the table: a model, its keys (names of RheologySpec's members) and its viscosity.
struct RheologyModel {
  std::string_view name;
  std::span<const std::string_view> keys;
  double (*viscosity)(const RheologySpec&, double rate);  // Pa s; the regularisation must be set if the model has one

  bool has(std::string_view key) const;
};

std::span<const RheologyModel> rheology_models();

// Throws Error(bad_input) that lists the names if there is no such model.
const RheologyModel& rheology_model(std::string_view name);

// mu(r), Pa s: finite for every r >= 0. The regularisation must be set if the model has one.
double viscosity(const RheologySpec& spec, double rate);

// The scene's rheology with its regularisation. The default is a thousandth of the larger of two rates: sqrt(g / L), at
// which gravity shears liquid as large as the domain (L its longest extent), and 1 / end, which strains liquid by 1 in
// the whole run.
RheologySpec resolve_rheology(const Scene& scene);

// One line for the log: the model, its regularisation and its viscosity at rest. Empty for Newtonian liquid.
std::string describe_rheology(const RheologySpec& spec);

// Fills mu (Pa s) at cell centres including ghosts. Face velocities must be known two cells around the owned ones;
// those with `valid` = 0 do not count (see ShearRates). Collective.
template <int Dim>
void set_viscosity(const Layout<Dim>& layout, const Halo<Dim>& halo, const RheologySpec& spec, const FaceField<Dim>& u,
                   const FaceField<Dim, char>& valid, CellField<Dim>& mu);

// The same with all velocities valid.
template <int Dim>
void set_viscosity(const Layout<Dim>& layout, const Halo<Dim>& halo, const RheologySpec& spec, const FaceField<Dim>& u,
                   CellField<Dim>& mu);

// The same at the edges of the owned cells and of one layer around. Velocities must be known four cells around the
// owned ones. Means of cell viscosities are not accurate enough: at the yield surface viscosity changes a thousandfold
// between neighbours, and velocity profiles were only first order. Local.
template <int Dim>
void set_edge_viscosity(const Layout<Dim>& layout, const RheologySpec& spec, const FaceField<Dim>& u,
                        const FaceField<Dim, char>& valid, EdgeField<Dim>& mu);

}  // namespace seiche
