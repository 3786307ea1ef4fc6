#include "scene/copies.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <set>

#include "base/scene.h"
#include "scene/options.h"

namespace seiche {
namespace {

using T = OptionType;

constexpr int most_copies = 10000;

Eigen::Matrix3d rotation_of(const RotationSpec& rotation) {
  const double angle = rotation.degrees * M_PI / 180;
  return angle == 0 ? Eigen::Matrix3d::Identity()
                    : Eigen::AngleAxisd(angle, rotation.axis.normalized()).toRotationMatrix();
}

// Rotations in the plane are about z, not -z, which scenes in 2D do not have.
RotationSpec rotation_by(const Eigen::Matrix3d& matrix) {
  const Eigen::AngleAxisd turn(matrix);
  const double degrees = turn.angle() * 180 / M_PI;
  const bool in_plane = turn.axis()[0] == 0 && turn.axis()[1] == 0;
  if (turn.angle() == 0 || in_plane) return {Vec3::UnitZ(), turn.axis()[2] * degrees};
  return {turn.axis(), degrees};
}

// Moves a solid by a rotation q about the origin, then by `way` (m).
void move_solid(SolidSpec& solid, const Eigen::Quaterniond& q, const Vec3& way) {
  TransformSpec& placed = solid.shape.transform;
  placed.rotate = rotation_by(q.toRotationMatrix() * rotation_of(placed.rotate));
  placed.translate = q * placed.translate + way;
  solid.motion.center = q * solid.motion.center + way;
  if (solid.rigid.center_of_mass) *solid.rigid.center_of_mass = q * *solid.rigid.center_of_mass + way;
}

// The middle of the shape as placed, m, if it has one.
std::optional<Vec3> middle_of(const ShapeSpec& shape) {
  const TransformSpec& placed = shape.transform;
  const auto at = [&](const Vec3& x) {
    return Vec3(placed.translate + rotation_of(placed.rotate) * (placed.scale * x));
  };
  if (shape.kind == "box") return at(0.5 * (shape.lower + shape.upper));
  if (shape.kind == "sphere") return at(shape.center);
  if (shape.kind == "cylinder" || shape.kind == "capsule") return at(0.5 * (shape.from + shape.to));
  return shape.has_facets() || shape.kind == "expression" ? std::optional(at(Vec3::Zero())) : std::nullopt;
}

// Radius of a ball about the middle that holds the shape, m, if it is known without a file.
std::optional<double> radius_of(const ShapeSpec& shape, int dimension) {
  const double scale = std::abs(shape.transform.scale);
  if (shape.kind == "box") return 0.5 * scale * (shape.upper - shape.lower).head(dimension).norm();
  if (shape.kind == "sphere") return scale * shape.radius;
  const double half = 0.5 * (shape.to - shape.from).norm();
  if (shape.kind == "capsule") return scale * (half + shape.radius);
  if (shape.kind == "cylinder") return scale * std::hypot(half, shape.radius);
  return std::nullopt;
}

// Random numbers that are the same on all machines.
class Draws {
 public:
  explicit Draws(int seed) : random_(std::uint32_t(seed)) {}
  double uniform() { return double(random_()) / 4294967296.0; }
  // Uniform over all rotations: K. Shoemake, Uniform random rotations, Graphics Gems III (1992). 2D: about z.
  Eigen::Quaterniond rotation(int dimension) {
    const double u = uniform(), v = 2 * M_PI * uniform(), w = 2 * M_PI * uniform();
    if (dimension == 2) return Eigen::Quaterniond(Eigen::AngleAxisd(v, Vec3::UnitZ()));
    return {std::sqrt(u) * std::cos(w), std::sqrt(1 - u) * std::sin(v), std::sqrt(1 - u) * std::cos(v),
            std::sqrt(u) * std::sin(w)};
  }

 private:
  std::mt19937 random_;
};

class Copier {
 public:
  Copier(SceneContext& context, const TomlNode& root, int dimension)
      : context_(context), root_(root), dimension_(dimension) {}

  // The copies of a solid; itself if it has none or they were reported.
  std::vector<SolidSpec> copies_of(const SolidSpec& solid, std::size_t index) {
    if (!solid.array && !solid.scatter) return {solid};
    path_ = fmt::format("solid.{}.{}", index, solid.array ? "array" : "scatter");
    const std::string fault = fault_of(solid);
    if (!fault.empty()) return report(fault), std::vector{solid};
    SolidSpec one = solid;
    one.array.reset();
    one.scatter.reset();
    std::vector<SolidSpec> copies = solid.array ? grid(one, *solid.array) : scattered(one, *solid.scatter);
    if (copies.empty()) return {one};
    for (std::size_t n = 0; n < copies.size(); ++n) copies[n].name = fmt::format("{}-{}", solid.name, n + 1);
    return copies;
  }

 private:
  void report(const std::string& text) { context_.report(path_, line_of(root_, path_), path_ + ": " + text); }

  std::string fault_of(const SolidSpec& solid) const {
    if (solid.array && solid.scatter) return "a solid has an array or a scatter, not both";
    if (solid.motion.waves) return "a wave maker has no copies";
    if (!solid.elastic.pinned.empty() || !solid.elastic.tractions.empty())
      return "solids with pins or tractions have no copies yet; write them out";
    const bool turned = solid.scatter && solid.scatter->turned;
    if (turned && (solid.rigid.inertia || solid.rigid.center_of_mass))
      return "solids with a given inertia or centre of mass cannot be turned; leave turned out";
    if (!solid.scatter) return {};
    if (!middle_of(solid.shape)) return "a " + solid.shape.kind + " cannot be scattered";
    if (!solid.scatter->radius && !radius_of(solid.shape, dimension_))
      return "needs radius, of a ball about the shape's origin that holds a copy";
    return {};
  }

  std::vector<SolidSpec> grid(const SolidSpec& one, const ArraySpec& array) {
    std::array<int, 3> count{1, 1, 1};
    double all = 1;
    for (int a = 0; a < dimension_; ++a) {
      count[std::size_t(a)] = int(std::lround(array.count[a]));
      all *= array.count[a];
      if (!(array.count[a] >= 1) || array.count[a] != std::round(array.count[a]))
        return report("count must hold whole numbers from 1"), std::vector<SolidSpec>();
    }
    if (all > most_copies) return report(fmt::format("at most {} copies", most_copies)), std::vector<SolidSpec>();
    std::vector<SolidSpec> copies;
    for (int k = 0; k < count[2]; ++k)
      for (int j = 0; j < count[1]; ++j)
        for (int i = 0; i < count[0]; ++i) {
          copies.push_back(one);
          move_solid(copies.back(), Eigen::Quaterniond::Identity(), array.spacing.cwiseProduct(Vec3(i, j, k)));
        }
    return copies;
  }

  // Places a copy at a time, each where its ball meets none before it; many tries, then no room.
  std::vector<SolidSpec> scattered(const SolidSpec& one, const ScatterSpec& scatter) {
    constexpr int most_tries = 20000;
    const double radius = scatter.radius.value_or(radius_of(one.shape, dimension_).value_or(0));
    Draws draws(scatter.seed);
    std::vector<Vec3> places;
    std::vector<SolidSpec> copies;
    for (int tries = 0; int(copies.size()) < scatter.count; ++tries) {
      if (tries == most_tries) {
        report(fmt::format("the box holds {} copies of radius {:g} m, {} do not find room", copies.size(), radius,
                           scatter.count - int(copies.size())));
        break;
      }
      Vec3 place = Vec3::Zero();
      for (int a = 0; a < dimension_; ++a) {
        const double low = scatter.lower[a] + radius, high = scatter.upper[a] - radius;
        place[a] = low + draws.uniform() * std::max(0.0, high - low);
        if (high < low) return report(fmt::format("the box is narrower than a copy along {}", "xyz"[a])), copies;
      }
      const Eigen::Quaterniond q = scatter.turned ? draws.rotation(dimension_) : Eigen::Quaterniond::Identity();
      const auto meets = [&](const Vec3& other) { return (other - place).norm() < 2 * radius + scatter.gap; };
      if (std::ranges::any_of(places, meets)) continue;
      places.push_back(place);
      copies.push_back(one);
      move_solid(copies.back(), q, place - q * *middle_of(one.shape));
      tries = -1;
    }
    return copies;
  }

  SceneContext& context_;
  const TomlNode& root_;
  int dimension_;
  std::string path_;
};

Section<ArraySpec> array_section() {
  using S = ArraySpec;
  Section<S> s;
  s.keys = {value_key<S>({.key = "count",
                          .type = T::vector,
                          .range = between(1, most_copies),
                          .presence = Presence::required,
                          .doc = "copies along each axis"},
                         &S::count),
            value_key<S>({.key = "spacing",
                          .type = T::vector,
                          .unit = "m",
                          .presence = Presence::required,
                          .doc = "from one copy to the next along each axis"},
                         &S::spacing)};
  return s;
}

Section<ScatterSpec> scatter_section() {
  using S = ScatterSpec;
  Section<S> s;
  s.keys = {
      value_key<S>({.key = "count",
                    .type = T::integer,
                    .range = between(1, most_copies),
                    .presence = Presence::required,
                    .doc = "number of copies"},
                   &S::count),
      value_key<S>({.key = "lower",
                    .type = T::vector,
                    .unit = "m",
                    .presence = Presence::required,
                    .doc = "low corner of the box that holds the copies"},
                   &S::lower),
      value_key<S>(
          {.key = "upper", .type = T::vector, .unit = "m", .presence = Presence::required, .doc = "its high corner"},
          &S::upper),
      value_key<S>({.key = "radius",
                    .unit = "m",
                    .range = positive(),
                    .unset = "that of the shape; required for meshes and expressions",
                    .doc = "of a ball about the shape's middle, of meshes its origin, that holds a copy"},
                   &S::radius),
      value_key<S>(
          {.key = "gap", .unit = "m", .range = between(0, number_limit), .doc = "least distance of these balls"},
          &S::gap),
      value_key<S>({.key = "turned", .type = T::boolean, .doc = "each copy is turned at random"}, &S::turned),
      value_key<S>({.key = "seed", .type = T::integer, .range = between(0, 2e9), .doc = "of the random places"},
                   &S::seed),
  };
  return s;
}

}  // namespace

std::vector<Key<SolidSpec>> copy_keys() {
  return {
      optional_table_key<SolidSpec>(
          {.key = "array", .unset = "one solid", .doc = "copies on a regular grid, named NAME-1, NAME-2, ..."},
          &SolidSpec::array, array_section()),
      optional_table_key<SolidSpec>(
          {.key = "scatter", .unset = "one solid", .doc = "copies at random places that keep apart, named likewise"},
          &SolidSpec::scatter, scatter_section())};
}

// The first copy takes the place of its solid, the others follow all solids of the file: problems that are found later
// then name the lines of the solids that the file has.
void expand_copies(SceneContext& context, const TomlNode& root, Scene& scene) {
  Copier copier(context, root, scene.dimension);
  std::set<std::string> names;
  const std::size_t written = scene.solids.size();
  for (std::size_t k = 0; k < written; ++k) {
    const std::vector<SolidSpec> copies = copier.copies_of(scene.solids[k], k);
    scene.solids[k] = copies[0];
    scene.solids.insert(scene.solids.end(), copies.begin() + 1, copies.end());
  }
  for (const SolidSpec& solid : scene.solids)
    if (!names.insert(solid.name).second)
      context.report("solid", line_of(root, "solid"),
                     fmt::format("there are two solids \"{}\", one of them a copy; rename one", solid.name));
}

}  // namespace seiche
