// Keys of [[probe]].
#include <fmt/format.h>

#include <cmath>

#include "base/probe_spec.h"
#include "scene/options.h"

namespace seiche {
namespace {

using T = OptionType;

constexpr double most_points_of_probe = 10000;  // of one probe

const std::vector<std::string> at_points{"pressure", "velocity", "surface_height", "displacement"};

Key<ProbeSpec> probe_kind_key() {
  return choice_key<ProbeSpec, ProbeKind ProbeSpec::*, ProbeKind>(
      {.key = "kind", .presence = Presence::required, .doc = "what is measured; outputs.md defines each"},
      &ProbeSpec::kind,
      {{"pressure", ProbeKind::pressure},
       {"velocity", ProbeKind::velocity},
       {"surface_height", ProbeKind::surface_height},
       {"front", ProbeKind::front},
       {"displacement", ProbeKind::displacement},
       {"joint", ProbeKind::joint},
       {"flux", ProbeKind::flux},
       {"volume", ProbeKind::volume},
       {"force", ProbeKind::force},
       {"torque", ProbeKind::torque}});
}

// A key of `array` that holds a place.
Key<ProbeSpec> array_key(const std::string& name, std::optional<Vec3> ProbeArraySpec::*member, const std::string& doc) {
  const auto of = [member](auto& s) -> auto& {
    return s.array.*member;
  };
  return value_key<ProbeSpec>(
      {.key = name, .type = T::vector, .unit = "m", .only_for = {"kind", at_points}, .unset = "one point", .doc = doc},
      of);
}

std::vector<Key<ProbeSpec>> array_keys() {
  using A = ProbeArraySpec;
  return {
      array_key("corner", &A::corner,
                "first of the points in a parallelogram, named NAME-1-1, NAME-2-1, ...: number along edge_a, then "
                "along edge_b"),
      array_key("edge_a", &A::edge_a, "from the corner along the one side to its end"),
      array_key("edge_b", &A::edge_b, "from the corner along the other side to its end"),
      value_key<ProbeSpec>(
          {.key = "counts",
           .type = T::interval,
           .range = between(2, most_points_of_probe),
           .only_for = {"kind", at_points},
           .unset = "one point",
           .doc = "numbers of points along edge_a and edge_b, the ends included"},
          [](auto& s) -> auto& { return s.array.counts; }),
      array_key("from", &A::from, "first of count points along a line, named NAME-1, NAME-2, ..."),
      array_key("to", &A::to, "last of these points"),
      value_key<ProbeSpec>(
          {.key = "count",
           .type = T::integer,
           .range = between(2, most_points_of_probe),
           .only_for = {"kind", at_points},
           .unset = "one point",
           .doc = "number of points along the line, its ends included"},
          [](auto& s) -> auto& { return s.array.count; }),
  };
}

std::vector<Key<ProbeSpec>> place_keys() {
  return {
      value_key<ProbeSpec>(
          {.key = "position",
           .type = T::vector,
           .unit = "m",
           .only_for = {"kind", at_points},
           .unset = "required, but for points along a line or in a parallelogram",
           .doc = "where it is measured; displacement: a point of the solid at rest, which is followed"},
          &ProbeSpec::position),
      value_key<ProbeSpec>({.key = "every",
                            .unit = "s",
                            .range = {shortest_time, number_limit},
                            .unset = "each step",
                            .doc = "time between samples"},
                           &ProbeSpec::every),
      value_key<ProbeSpec>({.key = "solid",
                            .type = T::text,
                            .only_for = {"kind", {"displacement"}},
                            .presence = Presence::required,
                            .doc = "name of the elastic solid"},
                           &ProbeSpec::solid),
      value_key<ProbeSpec>({.key = "joint",
                            .type = T::text,
                            .only_for = {"kind", {"joint"}},
                            .presence = Presence::required,
                            .doc = "name of the joint"},
                           &ProbeSpec::joint),
      choice_key<ProbeSpec, JointQuantity ProbeSpec::*, JointQuantity>(
          {.key = "quantity",
           .only_for = {"kind", {"joint"}},
           .doc = "force or torque on the joint's first solid, as in joints.csv; its coordinate; its power"},
          &ProbeSpec::quantity,
          {{"force", JointQuantity::force},
           {"torque", JointQuantity::torque},
           {"coordinate", JointQuantity::coordinate},
           {"power", JointQuantity::power}}),
  };
}

std::vector<Key<ProbeSpec>> region_keys() {
  const Condition boxes{"kind", {"flux", "volume"}}, loads{"kind", {"force", "torque"}};
  return {
      value_key<ProbeSpec>(
          {.key = "lower",
           .type = T::vector,
           .unit = "m",
           .only_for = boxes,
           .presence = Presence::required,
           .doc = "low corner of the box; flux: of a flat one, equal to upper along one axis, which the "
                  "liquid passes; positive along that axis"},
          &ProbeSpec::lower),
      value_key<ProbeSpec>({.key = "upper",
                            .type = T::vector,
                            .unit = "m",
                            .only_for = boxes,
                            .presence = Presence::required,
                            .doc = "high corner"},
                           &ProbeSpec::upper),
      value_key<ProbeSpec>(
          {.key = "solids",
           .type = T::names,
           .only_for = loads,
           .presence = Presence::required,
           .doc = "names of the solids whose loads are summed; * stands for any characters, ? for one"},
          &ProbeSpec::solids),
      value_key<ProbeSpec>({.key = "about",
                            .type = T::vector,
                            .unit = "m",
                            .only_for = {"kind", {"torque"}},
                            .unset = "the origin",
                            .doc = "point of the torque"},
                           &ProbeSpec::about),
  };
}

void check_counts(SceneContext& c, const Place& p, const ProbeSpec& probe) {
  if (!probe.array.counts) return;
  const auto [along_a, along_b] = *probe.array.counts;
  const std::string path = join_path(p.path, "counts");
  if (along_a != std::round(along_a) || along_b != std::round(along_b))
    c.report(path, p.node->line, path + " must hold whole numbers");
  else if (along_a * along_b > most_points_of_probe)
    c.report(path, p.node->line,
             fmt::format("{}: {} points; at most {}", path, along_a * along_b, most_points_of_probe));
}

// One point, a line or a parallelogram, each with all of its keys.
void check_points(SceneContext& c, const Place& p, const ProbeSpec& probe) {
  const ProbeArraySpec& a = probe.array;
  const int of_line = a.from.has_value() + a.to.has_value() + a.count.has_value();
  const int of_plane = a.corner.has_value() + a.edge_a.has_value() + a.edge_b.has_value() + a.counts.has_value();
  const int forms = (p.node->find("position") != nullptr) + (of_line > 0) + (of_plane > 0);
  if (forms == 1 && (of_line == 0 || of_line == 3) && (of_plane == 0 || of_plane == 4))
    return check_counts(c, p, probe);
  c.report(p, fmt::format("[[probe]] needs one of these: position; from, to and count, of points along a line; corner, "
                          "edge_a, edge_b and counts, of points in a parallelogram{}",
                          forms > 1 ? "; it has keys of several" : ""));
}

int flat_axes(const ProbeSpec& probe, int dimension) {
  int count = 0;
  for (int a = 0; a < dimension; ++a) count += probe.lower[a] == probe.upper[a];
  return count;
}

void check_box(SceneContext& c, const Place& p, const ProbeSpec& probe) {
  for (int a = 0; a < c.dimension; ++a)
    if (probe.lower[a] > probe.upper[a])
      return c.report(p, fmt::format("{}: lower is above upper along {}: {} and {}", p.path, "xyz"[a], probe.lower[a],
                                     probe.upper[a]));
  const int flat = flat_axes(probe, c.dimension);
  if (probe.kind == ProbeKind::flux && flat != 1)
    c.report(p, p.path + ": a flux passes a flat box, whose lower and upper agree along one axis and no other");
  if (probe.kind == ProbeKind::volume && flat > 0)
    c.report(p, p.path + ": the box is flat; each component of lower must be less than that of upper");
}

void finish_probe(SceneContext& c, const Place& p, ProbeSpec& probe) {
  probe.where = c.where(p.node->line);
  if (!c.clean(p.path) || c.dimension == 0) return;
  if (probe.has_position()) check_points(c, p, probe);
  if (probe.has_box()) check_box(c, p, probe);
}

}  // namespace

Section<ProbeSpec> probe_section() {
  Section<ProbeSpec> s;
  s.keys = {
      value_key<ProbeSpec>({.key = "name", .type = T::text, .unset = "`probe1`, `probe2`, ...", .doc = "unique name"},
                           &ProbeSpec::name),
      probe_kind_key()};
  for (auto keys : {place_keys(), array_keys(), region_keys()})
    for (Key<ProbeSpec>& key : keys) s.keys.push_back(std::move(key));
  s.finish = finish_probe;
  return s;
}

}  // namespace seiche
