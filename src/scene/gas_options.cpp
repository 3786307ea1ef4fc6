// The [gas] table.
#include "base/scene.h"
#include "scene/options.h"

namespace seiche {
namespace {

Section<GasSpec> gas_section() {
  using S = GasSpec;
  Section<S> s;
  s.keys = {
      choice_key<S, Bubbles S::*, Bubbles>(
          {.key = "bubbles",
           .doc =
               "resolved: gas flows, with one velocity field and pressure for both; volume_conserving: each enclosed "
               "region of air has one pressure and keeps its volume, and nothing flows in it"},
          &S::bubbles, {{"resolved", Bubbles::resolved}, {"volume_conserving", Bubbles::volume_conserving}}),
      material_key<S>(MaterialState::gas),
      value_key<S>(density_option(), &S::density),
      value_key<S>({.key = "viscosity", .unit = "Pa s", .range = between(0, number_limit), .doc = "0: inviscid"},
                   &S::viscosity),
      value_key<S>(initial_velocity_option(), &S::velocity),
  };
  s.finish = [](SceneContext&, const Place&, S& gas) { gas.present = true; };
  return s;
}

}  // namespace

Key<Scene> gas_key() {
  Key<Scene> key = block_key<Scene>(
      {.key = "gas", .unset = "a free surface at pressure 0", .doc = "the gas beyond the liquid's surface"},
      &Scene::gas, gas_section());
  const auto write = key.write;
  key.write = [write](const Scene& s, int dimension, const std::string& path, SceneLines& lines) {
    if (s.gas.present) write(s, dimension, path, lines);
  };
  return key;
}

}  // namespace seiche
