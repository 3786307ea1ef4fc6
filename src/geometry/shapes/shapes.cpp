// The shape table, and the parts common to all shapes: transform, inversion, location in messages.
#include "geometry/shapes/shapes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "geometry/shapes/makers.h"

namespace seiche {
namespace shape {
namespace {

enum class Frame { own, world };  // coordinates of the maker's field

template <int Dim>
struct Row {
  const char* name;
  Field<Dim> (*make)(const ShapeSpec&, const ShapeOptions&);
  Frame frame;
};

// The shape table. A new shape needs one more row.
template <int Dim>
constexpr std::array<Row<Dim>, 10> table{{
    {"box", make_box<Dim>, Frame::own},
    {"sphere", make_sphere<Dim>, Frame::own},
    {"cylinder", make_cylinder<Dim>, Frame::own},
    {"capsule", make_capsule<Dim>, Frame::own},
    {"plane", make_plane<Dim>, Frame::own},
    {"polygon", make_mesh<Dim>, Frame::world},
    {"mesh", make_mesh<Dim>, Frame::world},
    {"expression", make_expression<Dim>, Frame::own},
    {"level_set", make_level_set<Dim>, Frame::own},
    {"height_map", make_height_map<Dim>, Frame::own},
}};

template <int Dim>
const Row<Dim>& find_row(const std::string& kind) {
  std::string names;
  for (const Row<Dim>& row : table<Dim>) {
    if (kind == row.name) return row;
    names += (names.empty() ? "" : ", ") + std::string(row.name);
  }
  refuse("unknown shape '" + kind + "'; use one of " + names);
}

// phi(x) = scale phi0(R' (x - translate) / scale)
template <int Dim>
struct Transformed : ShapeField<Dim> {
  Field<Dim> inner;
  Eigen::Matrix<double, Dim, Dim> to_own;  // R'
  Vec<Dim> translate;
  double scale = 1;
  double operator()(const Vec<Dim>& x) const override {
    return scale * (*inner)(Vec<Dim>(to_own * (x - translate) / scale));
  }
};

template <int Dim>
struct Inverted : ShapeField<Dim> {
  Field<Dim> inner;
  double operator()(const Vec<Dim>& x) const override { return -(*inner)(x); }
};

template <int Dim>
bool is_identity(const TransformSpec& t) {
  return t.scale == 1 && t.rotate.degrees == 0 && truncate<Dim>(t.translate).isZero(0);
}

template <int Dim>
Field<Dim> transform(Field<Dim> inner, const TransformSpec& spec) {
  if (is_identity<Dim>(spec)) return inner;
  auto result = std::make_unique<Transformed<Dim>>();
  result->inner = std::move(inner);
  result->to_own = rotation<Dim>(spec.rotate).transpose();
  result->translate = truncate<Dim>(spec.translate);
  result->scale = spec.scale;
  return result;
}

template <int Dim>
Field<Dim> invert(Field<Dim> inner) {
  auto result = std::make_unique<Inverted<Dim>>();
  result->inner = std::move(inner);
  return result;
}

void require_transform(const TransformSpec& t) {
  if (!(t.scale > 0) || !std::isfinite(t.scale)) refuse("scale is not positive; use a factor such as 1.0");
  if (!std::isfinite(t.rotate.degrees) || !t.rotate.axis.allFinite()) refuse("rotate is not finite");
  if (!t.translate.allFinite()) refuse("translate is not finite");
}

template <int Dim>
Field<Dim> build(const ShapeSpec& spec, const ShapeOptions& options) {
  const Row<Dim>& row = find_row<Dim>(spec.kind);
  require_transform(spec.transform);
  Field<Dim> field = row.make(spec, options);
  if (row.frame == Frame::own) field = transform<Dim>(std::move(field), spec.transform);
  return spec.invert ? invert<Dim>(std::move(field)) : std::move(field);
}

// Cosine and sine, exact at multiples of 90 degrees.
std::pair<double, double> cos_sin(double degrees) {
  int quarters = 0;
  const double rest = std::remquo(degrees, 90.0, &quarters) * std::numbers::pi / 180;
  double c = std::cos(rest), s = std::sin(rest);
  for (int i = 0; i < (quarters & 3); ++i) c = std::exchange(s, c) * -1;
  return {c, s};
}

}  // namespace

void refuse(const std::string& message) {
  throw Error(ExitCode::bad_input, message);
}

template <>
Eigen::Matrix2d rotation<2>(const RotationSpec& rotate) {
  const auto [c, s] = cos_sin(rotate.degrees);
  Eigen::Matrix2d r;
  r << c, -s, s, c;
  return r;
}

// Rodrigues: R = c I + s [a]x + (1 - c) a a'
template <>
Eigen::Matrix3d rotation<3>(const RotationSpec& rotate) {
  if (rotate.degrees == 0) return Eigen::Matrix3d::Identity();
  const double length = rotate.axis.stableNorm();
  if (!(length > 0)) refuse("the axis of rotate is zero; use for example [0, 1, 0]");
  const Vec3 a = rotate.axis / length;
  const auto [c, s] = cos_sin(rotate.degrees);
  return c * Eigen::Matrix3d::Identity() + s * cross_matrix(a) + (1 - c) * a * a.transpose();
}

}  // namespace shape

template <int Dim>
std::unique_ptr<ShapeField<Dim>> make_shape(const ShapeSpec& spec, const ShapeOptions& options) {
  try {
    return shape::build<Dim>(spec, options);
  } catch (const Error& e) {
    throw Error(e.code(), spec.where.empty() ? e.what() : spec.where + ": " + e.what());
  }
}

std::vector<std::string> shape_names() {
  std::vector<std::string> names;
  for (const auto& row : shape::table<3>) names.emplace_back(row.name);
  return names;
}

template std::unique_ptr<ShapeField<2>> make_shape<2>(const ShapeSpec&, const ShapeOptions&);
template std::unique_ptr<ShapeField<3>> make_shape<3>(const ShapeSpec&, const ShapeOptions&);

}  // namespace seiche
