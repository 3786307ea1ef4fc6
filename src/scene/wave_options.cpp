// Keys of a wave maker.
#include "scene/options.h"
#include "scene/waves.h"

namespace seiche {
namespace {

using T = OptionType;

Key<WavesSpec> length_key(const char* key, const char* unit, const char* doc, double WavesSpec::*member) {
  return value_key<WavesSpec>(
      {.key = key, .unit = unit, .range = positive(), .presence = Presence::required, .doc = doc}, member);
}

std::vector<Key<WavesSpec>> spectrum_keys() {
  using S = WavesSpec;
  return {
      value_key<WavesSpec>({.key = "spectrum",
                            .type = T::choice,
                            .choices = {"jonswap", "pierson_moskowitz"},
                            .unset = "regular waves",
                            .doc = "irregular waves: random phases, the same for the same seed"},
                           &WavesSpec::spectrum),
      value_key<S>({.key = "peakedness",
                    .range = between(1, 20),
                    .only_for = {"spectrum", {"jonswap"}},
                    .unset = "3.3",
                    .doc = "gamma of the spectrum"},
                   &S::peakedness),
      value_key<S>({.key = "components",
                    .type = T::integer,
                    .range = between(1, 60),
                    .only_for = {"spectrum", {"jonswap", "pierson_moskowitz"}},
                    .unset = "24",
                    .doc = "number of waves that the sum has"},
                   &S::components),
      value_key<S>({.key = "seed",
                    .type = T::integer,
                    .range = between(0, 2e9),
                    .only_for = {"spectrum", {"jonswap", "pierson_moskowitz"}},
                    .unset = "1",
                    .doc = "of the random phases"},
                   &S::seed),
  };
}

}  // namespace

Section<WavesSpec> waves_section() {
  using S = WavesSpec;
  Section<S> s;
  s.keys = {
      value_key<S>({.key = "paddle",
                    .type = T::choice,
                    .choices = {"piston", "flap"},
                    .doc = "piston: moves along direction; flap: turns about a hinge at the bottom"},
                   &S::paddle),
      length_key("depth", "m", "depth of the liquid at rest", &S::depth),
      length_key("height", "m", "from trough to crest; of a spectrum the significant height", &S::height),
      length_key("period", "s", "period; of a spectrum that of its peak", &S::period),
      value_key<S>({.key = "theory",
                    .type = T::choice,
                    .choices = {"airy", "stokes"},
                    .doc = "motion for linear waves, or of second order: regular waves of a piston without the free "
                           "waves of twice the frequency"},
                   &S::theory),
      value_key<S>({.key = "ramp",
                    .unit = "s",
                    .range = between(0, number_limit),
                    .unset = "two periods",
                    .doc = "time in which the motion grows to its full height"},
                   &S::ramp),
      value_key<S>(
          {.key = "direction", .type = T::vector, .unset = "along x", .doc = "that the waves take, horizontal"},
          &S::direction),
      value_key<S>({.key = "hinge", .type = T::vector, .unit = "m", .doc = "a point of the flap's axis"}, &S::hinge),
  };
  for (Key<S>& key : spectrum_keys()) s.keys.push_back(std::move(key));
  return s;
}

}  // namespace seiche
