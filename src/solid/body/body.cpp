#include "solid/body/body.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/numbered_files.h"
#include "geometry/shapes/closed_surface.h"
#include "geometry/shapes/mesh_shape.h"
#include "solid/body/deforming.h"
#include "solid/body/thin_surface.h"
#include "solid/body/thinness.h"

namespace seiche {
namespace {

double radians(double degrees) {
  return degrees * 3.14159265358979323846 / 180;
}

bool is_simple(const std::string& kind) {
  return kind == "box" || kind == "sphere" || kind == "cylinder" || kind == "capsule" || kind == "plane";
}

// Centre of a simple shape (a plane's point) before its transform; the origin for other shapes.
Vec3 shape_center(const ShapeSpec& s) {
  if (s.kind == "box") return 0.5 * (s.lower + s.upper);
  if (s.kind == "sphere") return s.center;
  if (s.kind == "cylinder" || s.kind == "capsule") return 0.5 * (s.from + s.to);
  if (s.kind == "plane") return s.point;
  return Vec3::Zero();
}

// Reference point of a solid that no forces move: the centre of a simple shape, else the centroid of the volume within
// the surface.
template <int Dim>
Vec3 center_of(const ShapeSpec& spec, const SurfaceMesh& surface) {
  const TransformSpec& t = spec.transform;
  const Vec3 center = t.translate + Eigen::AngleAxisd(radians(t.rotate.degrees), t.rotate.axis.normalized()) *
                                        Vec3(t.scale * shape_center(spec));
  if (is_simple(spec.kind) || surface.points.empty()) return center;
  const Vec3 enclosed = mass_of_surface<Dim>(surface, 1).center;
  return enclosed.allFinite() ? enclosed : center;
}

bool is_round(const std::string& kind) {
  return kind == "sphere" || kind == "cylinder" || kind == "capsule";
}

// Volume of a round shape, or of its hole.
template <int Dim>
double round_volume(ShapeSpec spec, const ShapeOptions& options, const Vec<Dim>& lower, const Vec<Dim>& upper) {
  spec.invert = false;
  return mass_properties<Dim>(spec, 1, options, lower, upper).volume;
}

// With the mass, centre and inertia that the scene gives. The inertia of a shape of one density goes with the mass.
MassProperties given_mass(MassProperties m, const RigidSpec& rigid) {
  m.centroid = m.center;
  if (rigid.mass) m.inertia *= *rigid.mass / m.mass, m.mass = *rigid.mass;
  if (rigid.center_of_mass) m.center = *rigid.center_of_mass;
  if (!rigid.inertia) return m;
  m.inertia = rigid.inertia->asDiagonal();
  const Vec3 products = rigid.products_of_inertia.value_or(Vec3(0, 0, 0));
  m.inertia(0, 1) = m.inertia(1, 0) = products[0];
  m.inertia(0, 2) = m.inertia(2, 0) = products[1];
  m.inertia(1, 2) = m.inertia(2, 1) = products[2];
  return m;
}

}  // namespace

template <int Dim>
Body<Dim>::Body(const SolidSpec& spec, const ShapeOptions& options, const Vec<Dim>& lower, const Vec<Dim>& upper)
    : spec_(spec) {
  if (spec.kind.has_elements) {
    make_elastic(options, lower, upper);
    return;
  }
  if (spec.kind.follows_meshes) {
    make_deforming(options, lower, upper);
    return;
  }
  shape_ = make_shape<Dim>(spec.shape, options);
  surface_ = seiche::contact_surface<Dim>(spec.shape, options, lower, upper);
  if (spec.kind.is_free()) {
    const double density = spec.rigid.mass ? 1 : spec.rigid.density;
    mass_ = given_mass(mass_properties<Dim>(spec.shape, density, options, lower, upper), spec.rigid);
    for (const Vec3& x : surface_.points) radius_ = std::max(radius_, (x - mass_.center).norm());
  }
  if (spec.kind.is_free() || is_round(spec.shape.kind))
    facet_ratio_ = (spec.kind.is_free() ? mass_.volume : round_volume<Dim>(spec.shape, options, lower, upper)) /
                   std::abs(mass_of_surface<Dim>(surface_, 1).volume);
  reference_ = spec.kind.is_free() ? mass_.center : center_of<Dim>(spec.shape, surface_);
  thin_ = is_thinner_than(*this, options.cell_size, lower, upper);
  if (thin_) thin_surface_ = std::make_shared<const ThinSurface<Dim>>(surface_);
  if (!spec.kind.is_prescribed()) return;
  const MotionSpec& m = spec.motion;
  motion_.emplace(Motion{VectorExpression(m.translate), Expression(m.degrees), m.axis.normalized(), m.center});
}

template <int Dim>
void Body<Dim>::make_elastic(const ShapeOptions& options, const Vec<Dim>& lower, const Vec<Dim>& upper) {
  elastic_ = std::make_unique<ElasticSolid<Dim>>(make_elastic_solid<Dim>(spec_, options, lower, upper));
  surface_ = elastic_->surface.facets;
  thin_ = is_thinner_than(*elastic_, options.cell_size);
  const ElasticBody<Dim>& body = elastic_->body;
  // Row sums of M: the mass of each node.
  const Eigen::VectorXd masses = body.mass * Eigen::VectorXd::Ones(body.size());
  for (std::size_t n = 0; n < body.mesh.nodes.size(); ++n) {
    const double m = masses[Dim * Eigen::Index(n)];
    mass_.mass += m;
    mass_.center += m * extend<Dim>(body.mesh.nodes[n]);
  }
  mass_.center /= mass_.mass;
  mass_.volume = mass_.mass / spec_.rigid.density;
  reference_ = mass_.center;
}

// The reference point is the centroid of the first mesh.
template <int Dim>
void Body<Dim>::make_deforming(const ShapeOptions& options, const Vec<Dim>& lower, const Vec<Dim>& upper) {
  elastic_ = std::make_unique<ElasticSolid<Dim>>(make_deforming_solid<Dim>(spec_, options));
  surface_ = elastic_->surface.facets;
  mass_.center = reference_ = mass_of_surface<Dim>(surface_, 1).center;
  const SurfaceMesh first = surface_;
  const MeshSequence& sequence = *elastic_->sequence;
  for (int mesh = 0; mesh < sequence.count(); ++mesh) {
    surface_.points = sequence.points_of(mesh);
    shape_ = make_mesh_shape<Dim>(surface_, options.cell_size);
    if (is_thinner_than(*this, options.cell_size, lower, upper))
      throw Error(ExitCode::bad_input,
                  fmt::format("{}: solid '{}' is thinner than a cell of {:g} m in {}, where a deforming solid cannot "
                              "be seen; give its meshes thickness, or take smaller cells",
                              spec_.shape.where, spec_.name, options.cell_size,
                              numbered_files(spec_.shape.file, spec_.sequence.meshes)[std::size_t(mesh)].string()));
  }
  surface_ = first;
  shape_.reset();
}

template <int Dim>
Pose Body<Dim>::pose(double t) const {
  if (!motion_) return {};
  const double angle = radians(motion_->degrees(Vec3::Zero(), t));
  return {Eigen::AngleAxisd(angle, motion_->axis).toRotationMatrix(), motion_->center,
          motion_->translate(Vec3::Zero(), t)};
}

template <int Dim>
Twist Body<Dim>::twist(double t0, double t1) const {
  if (!motion_ || t1 == t0) return {};
  const double dt = t1 - t0;
  const Vec3 d0 = motion_->translate(Vec3::Zero(), t0), d1 = motion_->translate(Vec3::Zero(), t1);
  const double turn = motion_->degrees(Vec3::Zero(), t1) - motion_->degrees(Vec3::Zero(), t0);
  return {(d1 - d0) / dt, motion_->axis * (radians(turn) / dt), motion_->center + d1};
}

template <int Dim>
Twist Body<Dim>::velocity(double t, double tau) const {
  if (!motion_) return {};
  const Twist one = twist(t, t + tau), two = twist(t, t + 2 * tau);
  return {2 * one.linear - two.linear, 2 * one.angular - two.angular,
          motion_->center + motion_->translate(Vec3::Zero(), t)};
}

template <int Dim>
double Body<Dim>::distance_in(const Pose& pose, const Vec<Dim>& x) const {
  return (*shape_)(truncate<Dim>(pose.to_rest(extend<Dim>(x))));
}

template <int Dim>
bool Body<Dim>::lies_between(const Pose& pose, const Vec<Dim>& x, const Vec<Dim>& y) const {
  return thin_surface_->meets(truncate<Dim>(pose.to_rest(extend<Dim>(x))), truncate<Dim>(pose.to_rest(extend<Dim>(y))));
}

template class Body<2>;
template class Body<3>;

}  // namespace seiche
