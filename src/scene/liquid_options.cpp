// Keys of [liquid].
#include "base/fluid_spec.h"
#include "scene/options.h"

namespace seiche {
namespace {

using T = OptionType;

Section<LiquidRegionSpec> region_section() {
  Section<LiquidRegionSpec> s;
  s.keys = lift<LiquidRegionSpec>(shape_section(), &LiquidRegionSpec::shape);
  s.keys.push_back(value_key<LiquidRegionSpec>({.key = "velocity",
                                                .type = T::formula_vector,
                                                .unit = "m/s",
                                                .variables = "xyzt",
                                                .unset = "that of [liquid]",
                                                .doc = "initial velocity in this region"},
                                               &LiquidRegionSpec::velocity));
  s.finish = [](SceneContext& c, const Place& p, LiquidRegionSpec& r) { finish_shape(c, p, r.shape); };
  return s;
}

void check_sponge(SceneContext& c, const Place& p, SpongeSpec& sponge) {
  if (!c.clean(p.path)) return;
  if (sponge.side.has_value() != sponge.length.has_value())
    c.report(p, p.path + (sponge.length ? ": length is for a sponge along a side; name the side"
                                        : ": a sponge along a side needs its length"));
  if (sponge.side && c.dimension == 2 && (*sponge.side)[0] == 'z')
    c.report(p, p.path + ": a scene in 2D has no side " + *sponge.side);
}

Section<SpongeSpec> sponge_section() {
  using S = SpongeSpec;
  Section<S> s;
  s.keys = {
      value_key<S>({.key = "rate",
                    .type = T::formula,
                    .unit = "1/s",
                    .variables = "xyzt",
                    .presence = Presence::required,
                    .doc = "rate, at least 0, at which the flow approaches velocity; with a side, the rate there"},
                   &S::rate),
      value_key<S>({.key = "velocity",
                    .type = T::formula_vector,
                    .unit = "m/s",
                    .variables = "xyzt",
                    .unset = "zero",
                    .doc = "velocity that the flow approaches"},
                   &S::velocity),
      value_key<S>({.key = "side",
                    .type = T::choice,
                    .choices = {"x_lower", "x_upper", "y_lower", "y_upper", "z_lower", "z_upper"},
                    .unset = "the rate holds everywhere",
                    .doc = "side of the domain that the sponge lies along"},
                   &S::side),
      value_key<S>({.key = "length",
                    .unit = "m",
                    .range = positive(),
                    .unset = "required with side",
                    .doc = "how far it reaches from that side; the rate falls to 0 there, as the square of the way"},
                   &S::length),
  };
  s.finish = check_sponge;
  return s;
}

Key<LiquidSpec> volume_key() {
  return choice_key<LiquidSpec, VolumeKeeping LiquidSpec::*, VolumeKeeping>(
      {.key = "volume",
       .doc =
           "how liquid is kept. \"cells\": the share of each cell is carried, so that liquid stays where it is, to "
           "rounding; for scenes whose solids are thicker than a cell. \"shift\": one shift of the whole surface keeps "
           "the sum. \"auto\": \"shift\" beside solids thinner than a cell, under gas that flows with surface tension, "
           "in prescribed flows with sources or inflow sides, and, if no gas flows, beside elastic solids, "
           "with enclosed air (gas.bubbles) beside solids that move, with sources or drains without a rate, where "
           "liquid fills the domain for good, and with time.cfl above 4; "
           "else \"cells\""},
      &LiquidSpec::volume,
      {{"auto", VolumeKeeping::automatic}, {"cells", VolumeKeeping::in_cells}, {"shift", VolumeKeeping::by_shift}});
}

Key<LiquidSpec> prescribed_velocity_key() {
  return value_key<LiquidSpec>(
      {.key = "prescribed_velocity",
       .type = T::formula_vector,
       .unit = "m/s",
       .variables = "xyzt",
       .unset = "the flow is solved for",
       .doc = "the flow at all times, which should be free of divergence: nothing is solved, only the "
              "surface moves with it, also through sides of the domain; for scenes of liquid alone"},
      &LiquidSpec::prescribed_velocity);
}

}  // namespace

Option density_option() {
  return {.key = "density", .unit = "kg/m^3", .range = positive(), .doc = "density"};
}

Option material_option(MaterialState state) {
  const bool solid = state == MaterialState::solid;
  return {.key = solid ? "name" : "material",
          .type = T::choice,
          .choices = material_names(state),
          .unset = "as the other keys say",
          .doc = solid                            ? "youngs_modulus, poisson_ratio and density of a material"
                 : state == MaterialState::liquid ? "density, viscosity and surface_tension of a material"
                                                  : "density and viscosity of a material"};
}

Option initial_velocity_option() {
  return {.key = "velocity",
          .type = T::formula_vector,
          .unit = "m/s",
          .variables = "xyzt",
          .unset = "zero",
          .doc = "initial velocity (expressions at t = 0)"};
}

// Keys of where liquid is, comes, goes and is drawn to a velocity.
std::vector<Key<LiquidSpec>> liquid_place_keys() {
  using S = LiquidSpec;
  return {
      list_key<S, LiquidRegionSpec>({.key = "region",
                                     .unset = "no liquid",
                                     .doc = "where liquid is at t = 0: the union of all",
                                     .most = most_entries},
                                    &S::regions, region_section()),
      list_key<S, LiquidSourceSpec>({.key = "source",
                                     .unset = "none",
                                     .doc = "liquid added in a shape for a time: up to a full shape, which inside "
                                            "liquid is next to nothing, or by a "
                                            "rate; see sources.md",
                                     .most = most_entries},
                                    &S::sources, source_section()),
      list_key<S, LiquidSourceSpec>(
          {.key = "drain", .unset = "none", .doc = "liquid taken away in a shape for a time", .most = most_entries},
          &S::drains, drain_section()),
      list_key<S, SpongeSpec>({.key = "sponge",
                               .unset = "none",
                               .doc = "where the flow is drawn to a velocity, as a beach absorbs waves",
                               .most = most_entries},
                              &S::sponges, sponge_section()),
  };
}

Section<LiquidSpec> liquid_section() {
  using S = LiquidSpec;
  Section<S> s;
  s.keys = {
      material_key<S>(MaterialState::liquid),
      value_key<S>(density_option(), &S::density),
      value_key<S>({.key = "separates",
                    .type = T::boolean,
                    .doc = "true: liquid separates from walls and solids where its pressure would fall below zero; "
                           "false: they exert suction"},
                   &S::separates),
      volume_key(),
      value_key<S>({.key = "spray",
                    .type = T::boolean,
                    .doc = "unless volume is kept by a shift or gas flows: liquid too little for the grid flies on as "
                           "drops; false: it is left out, and stats.csv counts it"},
                   &S::spray),
      viscosity_key(),
      surface_tension_key(),
      tension_scheme_key(),
      value_key<S>(contact_angle_option("where the surface meets sides and solids"), &S::contact_angle),
      rheology_key(),
      value_key<S>(initial_velocity_option(), &S::velocity),
      prescribed_velocity_key(),
  };
  const std::vector<Key<S>> places = liquid_place_keys();
  s.keys.insert(s.keys.end(), places.begin(), places.end());
  s.finish = [](SceneContext& c, const Place& p, S&) { check_one_viscosity(c, p); };
  return s;
}

}  // namespace seiche
