// Keys of [[liquid.source]] and [[liquid.drain]].
#include <limits>

#include "base/fluid_spec.h"
#include "scene/options.h"

namespace seiche {
namespace {

using T = OptionType;

// Without an end (until = infinity) it is written without this key.
Key<LiquidSourceSpec> until_key(const std::string& doc) {
  const Option option{.key = "until", .unit = "s", .unset = "for ever", .doc = doc};
  Key<LiquidSourceSpec> key{option, {}, {}};
  key.read = [option](SceneContext& c, const Place& p, LiquidSourceSpec& s) { read_value(c, p, option, s.until); };
  key.write = [option](const LiquidSourceSpec& s, int dimension, const std::string& path, SceneLines& lines) {
    if (s.until == std::numeric_limits<double>::infinity()) return;
    lines.push_back({join_path(path, option.key), option.key, to_toml(s.until, option, dimension)});
  };
  return key;
}

// It begins at `start` where `from` is a point of the shape.
std::vector<Key<LiquidSourceSpec>> begin_keys(const std::string& what) {
  return {value_key<LiquidSourceSpec>(
              {.key = "from",
               .unit = "s",
               .only_for = {"shape",
                            {"box", "sphere", "plane", "polygon", "mesh", "expression", "level_set", "height_map"}},
               .unset = "0.0",
               .doc = "when the " + what + " begins"},
              &LiquidSourceSpec::from),
          value_key<LiquidSourceSpec>({.key = "start",
                                       .unit = "s",
                                       .only_for = {"shape", {"cylinder", "capsule"}},
                                       .unset = "0.0",
                                       .doc = "when the " + what + " begins (the from of these shapes is a point)"},
                                      &LiquidSourceSpec::from)};
}

Key<LiquidSourceSpec> rate_key(const std::string& unset, const std::string& doc) {
  return value_key<LiquidSourceSpec>({.key = "rate",
                                      .type = T::formula,
                                      .unit = "m^3/s",
                                      .range = between(0, number_limit),
                                      .variables = "t",
                                      .unset = unset,
                                      .doc = doc},
                                     &LiquidSourceSpec::rate);
}

void finish_source(SceneContext& c, const Place& p, LiquidSourceSpec& source, const std::string& list) {
  finish_shape(c, p, source.shape);
  if (!c.clean(p.path)) return;
  if (!(source.from < source.until)) c.report(p, "[[" + list + "]] must begin before its until");
  if (source.motion && source.attached_to) c.report(p, p.path + ": give attached_to or motion, not both");
}

// Without waves, which are for wave makers.
Section<MotionSpec> own_motion_section() {
  Section<MotionSpec> s = motion_section();
  std::erase_if(s.keys, [](const Key<MotionSpec>& key) { return key.option.key == "waves"; });
  return s;
}

std::vector<Key<LiquidSourceSpec>> moving_keys(const std::string& what) {
  return {
      value_key<LiquidSourceSpec>({.key = "attached_to",
                                   .type = T::text,
                                   .unset = "none",
                                   .doc = "solid that takes the " + what +
                                          " along: its shape is given where the solid begins, and "
                                          "moves and turns with it, as does its velocity, which is against the solid"},
                                  &LiquidSourceSpec::attached_to),
      optional_table_key<LiquidSourceSpec>({.key = "motion",
                                            .unset = "at rest",
                                            .doc = "how the " + what + " moves by itself, as a kinematic solid does"},
                                           &LiquidSourceSpec::motion, own_motion_section())};
}

Section<LiquidSourceSpec> section_of(const std::string& list, std::vector<Key<LiquidSourceSpec>> own) {
  Section<LiquidSourceSpec> s;
  s.keys = lift<LiquidSourceSpec>(shape_section(), &LiquidSourceSpec::shape);
  for (Key<LiquidSourceSpec>& key : own) s.keys.push_back(std::move(key));
  s.finish = [list](SceneContext& c, const Place& p, LiquidSourceSpec& source) { finish_source(c, p, source, list); };
  return s;
}

}  // namespace

Section<LiquidSourceSpec> source_section() {
  std::vector<Key<LiquidSourceSpec>> own{value_key<LiquidSourceSpec>({.key = "velocity",
                                                                      .type = T::formula_vector,
                                                                      .unit = "m/s",
                                                                      .variables = "xyzt",
                                                                      .unset = "zero",
                                                                      .doc = "velocity of the liquid that is added"},
                                                                     &LiquidSourceSpec::velocity)};
  for (Key<LiquidSourceSpec>& key : begin_keys("source")) own.push_back(std::move(key));
  own.push_back(
      until_key("the source flows while from <= t < until: its shape is filled at the start and kept full, parts of a "
                "step count. A shape that holds no cell's centre brings nothing, except with volume = \"cells\""));
  own.push_back(rate_key("the shape is kept full",
                         "volume that the liquid in the shape swells by a second (2D: m^2/s), so that it flows out of "
                         "it, also below the surface; without liquid in the shape nothing flows"));
  for (Key<LiquidSourceSpec>& key : moving_keys("source")) own.push_back(std::move(key));
  return section_of("liquid.source", std::move(own));
}

Section<LiquidSourceSpec> drain_section() {
  std::vector<Key<LiquidSourceSpec>> own = begin_keys("drain");
  own.push_back(until_key("the drain takes liquid while from <= t < until"));
  own.push_back(rate_key("the shape is kept empty, as a hole",
                         "volume that is sucked out of the shape a second (2D: m^2/s) where it is full of liquid; of a "
                         "partly filled one in proportion"));
  for (Key<LiquidSourceSpec>& key : moving_keys("drain")) own.push_back(std::move(key));
  return section_of("liquid.drain", std::move(own));
}

}  // namespace seiche
