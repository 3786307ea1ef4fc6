// Keys of [[force]] and [[contact]].
#include "base/contact_spec.h"
#include "base/force_spec.h"
#include "scene/options.h"

namespace seiche {
namespace {

using T = OptionType;

Condition for_kinds(std::vector<std::string> kinds) {
  return {"kind", std::move(kinds)};
}

std::vector<Key<ForceSpec>> force_target_keys() {
  using S = ForceSpec;
  return {
      value_key<S>({.key = "name", .type = T::text, .unset = "`force1`, `force2`, ...", .doc = "unique name"},
                   &S::name),
      choice_key<S, ForceKind S::*, ForceKind>(
          {.key = "kind",
           .presence = Presence::required,
           .doc =
               "acceleration: by a formula; point: towards a point; vortex: round an axis; drag: towards a velocity; "
               "wind: pressure of air on solids above the liquid and drag on its surface; load: force and torque on "
               "each solid"},
          &S::kind,
          {{"acceleration", ForceKind::acceleration},
           {"point", ForceKind::point},
           {"vortex", ForceKind::vortex},
           {"drag", ForceKind::drag},
           {"wind", ForceKind::wind},
           {"load", ForceKind::load}}),
      choice_key<S, ForceTarget S::*, ForceTarget>(
          {.key = "acts_on",
           .only_for = for_kinds({"acceleration", "point", "vortex", "drag", "wind"}),
           .doc = "the liquid, solids that forces move, or all of them"},
          &S::acts_on, {{"all", ForceTarget::all}, {"liquid", ForceTarget::liquid}, {"solids", ForceTarget::solids}}),
      value_key<S>({.key = "solids",
                    .type = T::names,
                    .unset = "all that forces move",
                    .doc = "names of the solids that it acts on; * stands for any characters, ? for one"},
                   &S::solids),
  };
}

std::vector<Key<ForceSpec>> field_keys() {
  using S = ForceSpec;
  return {value_key<S>({.key = "acceleration",
                        .type = T::formula_vector,
                        .unit = "m/s^2",
                        .variables = "xyzt",
                        .only_for = for_kinds({"acceleration"}),
                        .presence = Presence::required,
                        .doc = "acceleration of what is at x, y, z, beside gravity"},
                       &S::acceleration)};
}

std::vector<Key<ForceSpec>> whirl_keys() {
  using S = ForceSpec;
  return {
      value_key<S>({.key = "center",
                    .type = T::vector,
                    .unit = "m",
                    .only_for = for_kinds({"point", "vortex"}),
                    .presence = Presence::required,
                    .doc = "the point; vortex: a point of its axis"},
                   &S::center),
      value_key<S>({.key = "axis",
                    .type = T::axis,
                    .only_for = for_kinds({"vortex", "load"}),
                    .doc = "axis of the vortex or the torque, counter-clockwise seen against it; 2D: along z"},
                   &S::axis),
      value_key<S>({.key = "strength",
                    .type = T::formula,
                    .unit = "m/s^2",
                    .variables = "t",
                    .only_for = for_kinds({"point", "vortex"}),
                    .presence = Presence::required,
                    .doc = "point: s in s R^2 d/(R^2 + d^2)^(3/2) towards the point at the distance d, negative: away; "
                           "vortex: acceleration at the radius, the largest, of 2 s (d/R)/(1 + (d/R)^2)"},
                   &S::strength),
      value_key<S>({.key = "radius",
                    .unit = "m",
                    .range = positive(),
                    .only_for = for_kinds({"point", "vortex"}),
                    .presence = Presence::required,
                    .doc = "R of these formulas"},
                   &S::radius),
  };
}

std::vector<Key<ForceSpec>> drag_keys() {
  using S = ForceSpec;
  return {
      value_key<S>({.key = "velocity",
                    .type = T::formula_vector,
                    .unit = "m/s",
                    .variables = "xyzt",
                    .only_for = for_kinds({"drag", "wind"}),
                    .unset = "zero",
                    .doc = "velocity of the wind, or of what drags"},
                   &S::velocity),
      value_key<S>({.key = "rate",
                    .type = T::formula,
                    .unit = "1/s",
                    .variables = "xyzt",
                    .only_for = for_kinds({"drag"}),
                    .presence = Presence::required,
                    .doc = "rate, at least 0, at which velocity is approached"},
                   &S::rate),
      value_key<S>({.key = "air_density",
                    .unit = "kg/m^3",
                    .range = positive(),
                    .only_for = for_kinds({"wind"}),
                    .doc = "density of the air"},
                   &S::air_density),
      value_key<S>({.key = "drag_coefficient",
                    .range = between(0, 100),
                    .only_for = for_kinds({"wind"}),
                    .doc = "C in F = C rho A v^2/2 on solids, with the dry area A that faces the wind"},
                   &S::drag_coefficient),
      value_key<S>({.key = "surface_drag",
                    .range = between(0, 1),
                    .only_for = for_kinds({"wind"}),
                    .doc = "C in C rho v^2, the shear stress on the liquid's surface"},
                   &S::surface_drag),
  };
}

std::vector<Key<ForceSpec>> load_keys() {
  using S = ForceSpec;
  const Condition load = for_kinds({"load"});
  return {
      value_key<S>({.key = "force",
                    .type = T::formula_vector,
                    .unit = "N",
                    .variables = "t",
                    .only_for = load,
                    .unset = "zero",
                    .doc = "force on each of the solids; 2D: per metre of depth"},
                   &S::force),
      value_key<S>({.key = "torque",
                    .type = T::formula,
                    .unit = "N m",
                    .variables = "t",
                    .only_for = load,
                    .doc = "torque on each of the solids about the axis; 2D: per metre of depth"},
                   &S::torque),
      value_key<S>({.key = "at",
                    .type = T::vector,
                    .unit = "m",
                    .only_for = load,
                    .unset = "the centre of mass",
                    .doc = "point of the solid at t = 0 at which the force acts, also later"},
                   &S::at),
      value_key<S>({.key = "turns_with_solid",
                    .type = T::boolean,
                    .only_for = load,
                    .doc = "true: force and torque turn with the solid, as those of a thruster"},
                   &S::turns_with_solid),
  };
}

Section<ShapeSpec> force_region_section() {
  Section<ShapeSpec> s = shape_section();
  s.finish = [](SceneContext& c, const Place& p, ShapeSpec& shape) { finish_shape(c, p, shape); };
  return s;
}

}  // namespace

Section<ForceSpec> force_section() {
  using S = ForceSpec;
  Section<S> s;
  for (auto& keys : {force_target_keys(), field_keys(), whirl_keys(), drag_keys(), load_keys()})
    s.keys.insert(s.keys.end(), keys.begin(), keys.end());
  s.keys.push_back(optional_table_key<S, ShapeSpec>(
      {.key = "region",
       .only_for = for_kinds({"acceleration", "point", "vortex", "drag", "wind"}),
       .unset = "it acts everywhere",
       .doc = "a shape within which it acts: on liquid there, and on solids whose centre of mass lies there"},
      &S::region, force_region_section()));
  s.finish = [](SceneContext& c, const Place& p, S& force) { force.where = c.where(p.node->line); };
  return s;
}

Section<ContactSpec> contact_section() {
  using S = ContactSpec;
  Section<S> s;
  s.keys = {
      value_key<S>({.key = "between",
                    .type = T::names,
                    .presence = Presence::required,
                    .doc = "names of the solids on both sides, or one for pairs among themselves; * stands for any "
                           "characters, ? for one; \"domain\": its sides"},
                   &S::between),
      value_key<S>({.key = "friction",
                    .range = between(0, number_limit),
                    .unset = "by the solids' own coefficients",
                    .doc = "Coulomb's coefficient where they touch"},
                   &S::friction),
      value_key<S>({.key = "restitution",
                    .range = between(0, 1),
                    .unset = "0: contact takes the energy of an impact",
                    .doc = "speed of rebound over speed of approach, of rigid solids that meet each other, kinematic "
                           "or static solids, or sides"},
                   &S::restitution),
      value_key<S>({.key = "collide", .type = T::boolean, .doc = "false: they pass through each other"}, &S::collide),
  };
  s.finish = [](SceneContext& c, const Place& p, S& contact) { contact.where = c.where(p.node->line); };
  return s;
}

}  // namespace seiche
