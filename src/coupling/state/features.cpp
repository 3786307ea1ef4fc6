#include "coupling/state/features.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/scene.h"
#include "base/time_spec.h"
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"

namespace seiche {
namespace {

using F = Feature;

// Text on a feature for the log and docs/features.md.
template <int Dim>
struct FeatureText {
  Feature feature;
  const char* name;
  const char* without;                 // consequence of its absence
  bool (*matters)(const Setup<Dim>&);  // true if the scene would have it without the exclusions
};

template <int Dim>
bool any_body(const Solids<Dim>& solids, bool (*holds)(const Body<Dim>&)) {
  return std::any_of(solids.bodies.begin(), solids.bodies.end(), holds);
}

template <int Dim>
bool has_kinematic(const Solids<Dim>& solids) {
  return any_body<Dim>(solids, [](const Body<Dim>& b) { return b.is_prescribed(); });
}

template <int Dim>
bool has_elements(const Solids<Dim>& solids) {
  return any_body<Dim>(solids, [](const Body<Dim>& b) { return b.kind().has_elements; });
}

bool is_second_order(const Fluids& fluids, const TimeSpec& time) {
  return time.scheme == TimeScheme::second_order && !fluids.has_prescribed_flow();
}

// True if an angle other than that of no wetting and no repelling is asked for.
bool has_contact_angles(const Scene& scene) {
  return scene.liquid.contact_angle != LiquidSpec{}.contact_angle ||
         std::any_of(scene.solids.begin(), scene.solids.end(), [](const SolidSpec& s) { return s.contact_angle; });
}

template <int Dim>
const std::vector<FeatureText<Dim>>& feature_texts() {
  using S = const Setup<Dim>&;
  static const std::vector<FeatureText<Dim>> table{
      {F::leapfrog, "leapfrog of surface and velocity",
       "surface and bodies move at once, before the solve; positions are of first order in the step where its length "
       "changes",
       [](S s) { return is_second_order(s.fluids, s.scene->time); }},
      {F::shared_viscosity, "viscous stress shared between start and end of a step",
       "it is taken at the end of the step; its error in time is four times as large",
       [](S s) { return is_second_order(s.fluids, s.scene->time) && s.fluids.is_viscous(); }},
      {F::shear_jump, "jump of shear across the surface between fluids",
       "shear beside the surface is smeared over a cell",
       [](S s) { return s.fluids.has_gas() && s.fluids.is_viscous(); }},
      {F::one_sided_at_medial_axis, "one-sided interpolation at the medial axis of the surface's distance",
       "the surface is interpolated across its medial axis, and thin films are transported less sharply",
       [](S s) { return s.scene->time.scheme == TimeScheme::second_order; }},
      {F::sealed_cavities, "cavities within elastic solids kept full",
       "the surface alone tells what a sealed cavity holds", [](S s) { return has_elements(s.solids); }},
      {F::contact_line_pull, "pull of surface tension on solids along the line where the surface meets them",
       "it acts on the liquid alone; small bodies that it should carry sink",
       [](S s) { return s.fluids.has_surface_tension(); }},
      {F::contact_angles, "contact angles", "the surface meets sides and solids at the angle that the flow gives",
       [](S s) { return has_contact_angles(*s.scene); }}};
  return table;
}

bool one_is_inviscid(const Fluids& fluids) {
  return fluids.constant_viscosity() && (*fluids.constant_viscosity() == 0 || fluids.gas.viscosity == 0);
}

const char* const introduction = R"doc(# Features that others switch off

Some features do not go together. At its start, the log of a run names each feature that a scene would have and that
something else in it switches off; so does `seiche check` for grids of up to two million cells. This page is made from
the same table.

Two things change from step to step and are not reported. Near contact, and where a source opens or closes, a step moves
everything at once even in scenes with the leapfrog. Viscous stress is shared only where liquid fills the domain and
is not stiff (dt μ/(ρ h²) ≤ ½, see [viscosity.md](viscosity.md)).

)doc";

}  // namespace

template <int Dim>
const std::vector<Exclusion<Dim>>& exclusions() {
  using S = const Setup<Dim>&;
  using B = const Body<Dim>&;
  static const std::vector<Exclusion<Dim>> table{
      {F::leapfrog, "scheme = \"first_order\"", [](S s) { return s.scene->time.scheme == TimeScheme::first_order; }},
      {F::leapfrog, "a prescribed flow", [](S s) { return s.fluids.has_prescribed_flow(); }},
      {F::leapfrog, "[gas] that flows, beside solids or sides with waves",
       [](S s) { return s.fluids.has_gas() && (!s.solids.bodies.empty() || s.domain.sides.any_waves()); }},
      {F::leapfrog, "[gas] that flows, without gravity or with surface_tension",
       [](S s) { return s.fluids.has_gas() && !s.fluids.has_gravity_waves(); }},
      {F::leapfrog, "enclosed air that keeps its volume", [](S s) { return s.fluids.keeps_air(); }},
      {F::leapfrog, "rigid beside kinematic solids",
       [](S s) { return s.solids.has_unknowns() && !s.solids.plans_steps() && has_kinematic(s.solids); }},
      {F::leapfrog, "solids that deform", [](S s) { return s.solids.plans_steps(); }},
      {F::leapfrog, "solids thinner than a cell",
       [](S s) { return s.may_have_fluid() && any_body<Dim>(s.solids, [](B b) { return b.is_thin(); }); }},
      {F::shared_viscosity, "scheme = \"first_order\"",
       [](S s) { return s.scene->time.scheme == TimeScheme::first_order; }},
      {F::shared_viscosity, "[gas] that flows", [](S s) { return s.fluids.has_gas(); }},
      {F::shared_viscosity, "solids", [](S s) { return !s.solids.bodies.empty(); }},
      {F::shear_jump, "viscosity by a formula or rheology", [](S s) { return !s.fluids.constant_viscosity(); }},
      {F::shear_jump, "a fluid without viscosity", [](S s) { return one_is_inviscid(s.fluids); }},
      {F::one_sided_at_medial_axis, "[gas] that flows", [](S s) { return s.fluids.has_gas(); }},
      {F::sealed_cavities, "[gas] that flows", [](S s) { return s.fluids.has_gas(); }},
      {F::contact_line_pull, "solids that forces move", [](S s) { return s.solids.has_unknowns(); }},
      {F::contact_angles, "no surface_tension", [](S s) { return !s.fluids.has_surface_tension(); }}};
  return table;
}

template <int Dim>
Features::Features(const Setup<Dim>& s) {
  for (const Exclusion<Dim>& row : exclusions<Dim>())
    if (row.present(s)) off_ |= 1u << int(row.feature);
}

template <int Dim>
std::vector<std::string> causes_against(const Setup<Dim>& s, Feature feature) {
  std::vector<std::string> causes;
  for (const Exclusion<Dim>& row : exclusions<Dim>())
    if (row.feature == feature && row.present(s)) causes.push_back(row.cause);
  return causes;
}

template <int Dim>
std::vector<std::string> describe_features(const Setup<Dim>& s) {
  std::vector<std::string> lines;
  for (const FeatureText<Dim>& text : feature_texts<Dim>()) {
    const std::vector<std::string> causes = causes_against(s, text.feature);
    if (causes.empty() || !text.matters(s)) continue;
    lines.push_back(fmt::format("off: {} (because of: {}); {}", text.name, fmt::join(causes, ", "), text.without));
  }
  return lines;
}

std::string feature_reference() {
  std::string page = introduction;
  page += "| feature | off with | what that means |\n|---|---|---|\n";
  for (const FeatureText<2>& text : feature_texts<2>()) {
    std::vector<std::string> causes;
    for (const Exclusion<2>& row : exclusions<2>())
      if (row.feature == text.feature) causes.push_back(row.cause);
    page += fmt::format("| {} | {} | {} |\n", text.name, fmt::join(causes, "; "), text.without);
  }
  return page;
}

#define SEICHE_INSTANTIATE(D)                                                    \
  template Features::Features(const Setup<D>&);                                  \
  template const std::vector<Exclusion<D>>& exclusions<D>();                     \
  template std::vector<std::string> causes_against<D>(const Setup<D>&, Feature); \
  template std::vector<std::string> describe_features<D>(const Setup<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
