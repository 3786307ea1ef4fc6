// Keys of waves: of paddles, and of sides of the domain.
#include "scene/options.h"
#include "scene/waves.h"

namespace seiche {
namespace {

using T = OptionType;

template <class S>
Key<S> length_key(const char* key, const char* unit, const char* doc, double WavesSpec::*member,
                  Range range = positive()) {
  return value_key<S>({.key = key, .unit = unit, .range = range, .presence = Presence::required, .doc = doc}, member);
}

// Not written if there is none.
template <class S>
Key<S> spectrum_key() {
  Key<S> key = value_key<S>({.key = "spectrum",
                             .type = T::choice,
                             .choices = {"jonswap", "pierson_moskowitz"},
                             .unset = "regular waves",
                             .doc = "irregular waves: random phases, the same for the same seed"},
                            &WavesSpec::spectrum);
  key.write = [write = key.write](const S& s, int dimension, const std::string& path, SceneLines& lines) {
    if (!s.spectrum.empty()) write(s, dimension, path, lines);
  };
  return key;
}

template <class S>
std::vector<Key<S>> spectrum_keys() {
  return {
      spectrum_key<S>(),
      value_key<S>({.key = "peakedness",
                    .range = between(1, 20),
                    .only_for = {"spectrum", {"jonswap"}},
                    .unset = "3.3",
                    .doc = "gamma of the spectrum"},
                   &WavesSpec::peakedness),
      value_key<S>({.key = "components",
                    .type = T::integer,
                    .range = between(1, 60),
                    .only_for = {"spectrum", {"jonswap", "pierson_moskowitz"}},
                    .unset = "24",
                    .doc = "number of waves that the sum has"},
                   &WavesSpec::components),
      value_key<S>({.key = "seed",
                    .type = T::integer,
                    .range = between(0, 2e9),
                    .only_for = {"spectrum", {"jonswap", "pierson_moskowitz"}},
                    .unset = "1",
                    .doc = "of the random phases"},
                   &WavesSpec::seed),
  };
}

template <class S>
Key<S> ramp_key(const char* doc) {
  return value_key<S>(
      {.key = "ramp", .unit = "s", .range = between(0, number_limit), .unset = "two periods", .doc = doc},
      &WavesSpec::ramp);
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
      length_key<S>("depth", "m", "depth of the liquid at rest", &S::depth),
      length_key<S>("height", "m", "from trough to crest; of a spectrum the significant height", &S::height),
      length_key<S>("period", "s", "period; of a spectrum that of its peak", &S::period),
      value_key<S>({.key = "theory",
                    .type = T::choice,
                    .choices = {"airy", "stokes"},
                    .doc = "motion for linear waves, or of second order: regular waves of a piston without the free "
                           "waves of twice the frequency"},
                   &S::theory),
      ramp_key<S>("time in which the motion grows to its full height"),
      value_key<S>(
          {.key = "direction", .type = T::vector, .unset = "along x", .doc = "that the waves take, horizontal"},
          &S::direction),
      value_key<S>({.key = "hinge", .type = T::vector, .unit = "m", .doc = "a point of the flap's axis"}, &S::hinge),
  };
  for (Key<S>& key : spectrum_keys<S>()) s.keys.push_back(std::move(key));
  return s;
}

Section<SideWavesSpec> side_waves_section() {
  using S = SideWavesSpec;
  Section<S> s;
  s.keys = {
      length_key<S>("depth", "m", "depth of the liquid at rest", &S::depth),
      length_key<S>("height", "m", "from trough to crest; of a spectrum the significant height; 0: none enter",
                    &S::height, between(0, number_limit)),
      length_key<S>("period", "s", "period, of a spectrum that of its peak, and of waves that are absorbed whole",
                    &S::period),
      value_key<S>({.key = "theory",
                    .type = T::choice,
                    .choices = {"airy", "stokes", "nonlinear"},
                    .doc = "of the waves that enter: linear; of second order; steady waves by Fourier's method, to any "
                           "height short of breaking"},
                   &S::theory),
      ramp_key<S>("time in which the waves grow to their full height"),
      value_key<S>({.key = "direction",
                    .type = T::vector,
                    .unset = "across the side, inward",
                    .doc = "that the waves take, horizontal"},
                   &S::towards),
      value_key<S>({.key = "absorbs", .type = T::boolean, .doc = "true: waves that come to the side leave through it"},
                   &S::absorbs),
      value_key<S>({.key = "level",
                    .unit = "m",
                    .unset = "depth above the bottom of the domain",
                    .doc = "coordinate of the liquid's surface at rest"},
                   &S::level),
  };
  for (Key<S>& key : spectrum_keys<S>()) s.keys.push_back(std::move(key));
  return s;
}

}  // namespace seiche
