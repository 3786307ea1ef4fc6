#pragma once
// Liquids whose viscosity depends on how fast they are sheared: mu(r) with the shear rate r = sqrt(2 D:D), 1/s, where
// D = (grad u + grad u') / 2.
#include <span>
#include <string>
#include <string_view>

#include "base/fluid_spec.h"
#include "grid/halo.h"

namespace seiche {

struct Scene;

// A row of the table: a model, the keys it has (names of RheologySpec's members) and its viscosity.
struct RheologyModel {
  std::string_view name;
  std::span<const std::string_view> keys;
  double (*viscosity)(const RheologySpec&, double rate);  // Pa s, of a regularisation that is set

  bool has(std::string_view key) const;
};

std::span<const RheologyModel> rheology_models();

// Throws Error(bad_input) that lists the names if there is no such model.
const RheologyModel& rheology_model(std::string_view name);

// mu(r), Pa s: finite for every r >= 0. The regularisation must be set where the model has one.
double viscosity(const RheologySpec& spec, double rate);

// The scene's rheology with its regularisation, where it gives none: a thousandth of the rate sqrt(g / L) at which
// gravity shears liquid as large as the domain, L its longest extent, and no less than would strain liquid by a
// thousandth in the whole run.
RheologySpec resolve_rheology(const Scene& scene);

// One line for the log: the model and what bounds its stiffness. Empty for Newtonian liquid.
std::string describe_rheology(const RheologySpec& spec);

// Fills mu at cell centres, ghosts too, from face velocities that are known two cells around the owned ones, of which
// those where `valid` is 0 do not count (ShearRates).
template <int Dim>
void set_viscosity(const Layout<Dim>& layout, const Halo<Dim>& halo, const RheologySpec& spec, const FaceField<Dim>& u,
                   const FaceField<Dim, char>& valid, CellField<Dim>& mu);

// The same where all velocities are valid.
template <int Dim>
void set_viscosity(const Layout<Dim>& layout, const Halo<Dim>& halo, const RheologySpec& spec, const FaceField<Dim>& u,
                   CellField<Dim>& mu);

// The same at the edges of the owned cells and of one layer around, of velocities that are known four cells around.
// Means of the cells' viscosities would not do: where liquid begins to yield it changes a thousandfold from one to the
// next, and profiles were first order.
template <int Dim>
void set_edge_viscosity(const Layout<Dim>& layout, const RheologySpec& spec, const FaceField<Dim>& u,
                        const FaceField<Dim, char>& valid, EdgeField<Dim>& mu);

}  // namespace seiche
