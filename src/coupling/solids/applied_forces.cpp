#include "coupling/solids/applied_forces.h"

#include "coupling/solids/kind_elastic.h"
#include "coupling/solids/solid_coupling.h"
#include "coupling/solids/surface_load.h"

namespace seiche {
namespace {

using Twist6 = Eigen::Matrix<double, 6, 1>;  // velocity, angular velocity; or force, torque
using Slope6 = Eigen::Matrix<double, 6, 6>;

// Load on a body that moves as a whole: force - slope V, with the twist V about its centre of mass.
struct TwistForce {
  Twist6 force = Twist6::Zero();
  Slope6 slope = Slope6::Zero();
};

// The same on the unknowns of a participant.
struct UnknownForce {
  Eigen::VectorXd force;
  std::vector<Eigen::Triplet<double>> slope;
};

// A body as the forces see it.
template <int Dim>
struct MovedBody {
  const Participant<Dim>& participant;
  Pose pose;
  Vec3 center;              // of mass, m
  Eigen::Matrix3d inertia;  // about it, in world axes, kg m^2

  explicit MovedBody(const Participant<Dim>& p)
      : MovedBody(p, p.rigid() ? rigid_pose(p.body(), *p.rigid()) : p.place(0, 0, 0).pose) {}
  MovedBody(const Participant<Dim>& p, const Pose& at) : participant(p), pose(at) {
    center = pose.apply(p.body().mass().center);
    inertia = pose.rotation * p.body().mass().inertia * pose.rotation.transpose();
  }
  double mass() const { return participant.body().mass().mass; }

  // Twist of each unknown at unit velocity, one a row.
  Eigen::Matrix<double, Eigen::Dynamic, 6> twists() const {
    Eigen::Matrix<double, Eigen::Dynamic, 6> P(participant.unknowns(), 6);
    for (int i = 0; i < 6; ++i) {
      BodyImpulse unit;
      (i < 3 ? unit.linear : unit.angular)[i % 3] = 1;
      P.col(i) = participant.generalised(unit);
    }
    return P;
  }
};

template <int Dim>
Slope6 mass_of_twist(const MovedBody<Dim>& body) {
  Slope6 M = Slope6::Zero();
  M.topLeftCorner<3, 3>().diagonal().setConstant(body.mass());
  M.bottomRightCorner<3, 3>() = body.inertia;
  return M;
}

// F = m a(c),  T_i = e_ijk da_k/dx_l S_jl with S the second moments of the mass about c, S = tr(I)/2 - I.
template <int Dim>
Twist6 field_on(const Force<Dim>& force, const MovedBody<Dim>& body, double t) {
  const double step = 1e-4 * std::max(body.participant.body().radius(), 1e-3);
  const Eigen::Matrix3d S = 0.5 * body.inertia.trace() * Eigen::Matrix3d::Identity() - body.inertia;
  Vec3 torque = Vec3::Zero();
  for (int l = 0; l < Dim; ++l) {
    const Vec3 way = step * Vec3::Unit(l),
               change = (force.field_at(body.center + way, t) - force.field_at(body.center - way, t)) / (2 * step);
    torque += S.col(l).cross(change);
  }
  Twist6 f;
  f << body.mass() * force.field_at(body.center, t), torque;
  return f;
}

// Force and torque of a load, turned with the solid if it says so.
template <int Dim>
Twist6 load_on(const Force<Dim>& load, const MovedBody<Dim>& body, double t) {
  const Eigen::Matrix3d turn = load.spec.turns_with_solid ? body.pose.rotation : Eigen::Matrix3d::Identity();
  const Vec3 force = turn * load.force(Vec3::Zero(), t),
             arm = load.spec.at ? Vec3(body.pose.apply(*load.spec.at) - body.center) : Vec3(0, 0, 0);
  Twist6 f;
  f << force, arm.cross(force) + turn * load.spec.axis.normalized() * load.torque(Vec3::Zero(), t);
  return f;
}

// Matrix that takes a twist to the velocity at a place off the centre.
Eigen::Matrix<double, 3, 6> velocity_at(const Vec3& arm) {
  Eigen::Matrix<double, 3, 6> G;
  G << Eigen::Matrix3d::Identity(), Eigen::Matrix3d{{0, arm[2], -arm[1]}, {-arm[2], 0, arm[0]}, {arm[1], -arm[0], 0}};
  return G;
}

// C rho |w - v|/2 times the part of a unit area that faces the relative wind, kg/(m^2 s).
double wind_rate(const ForceSpec& spec, const Vec3& relative, const Vec3& normal) {
  const double speed = relative.norm();
  if (speed == 0) return 0;
  return 0.5 * spec.drag_coefficient * spec.air_density * speed * std::max(0.0, -normal.dot(relative) / speed);
}

template <int Dim>
class ForcesOnSolids {
 public:
  ForcesOnSolids(const Domain<Dim>& domain, const State<Dim>& state, double t)
      : domain_(domain), state_(state), t_(t) {}

  UnknownForce on(const Force<Dim>& force, const Participant<Dim>& p) const {
    UnknownForce f{Eigen::VectorXd::Zero(p.unknowns()), {}};
    if (!p.body().is_free()) return f;
    if (const auto* elastic = dynamic_cast<const ElasticParticipant<Dim>*>(&p)) {
      force.spec.kind == ForceKind::wind ? wind_on_nodes(force, *elastic, f) : act_on_nodes(force, *elastic, f);
      return f;
    }
    const MovedBody<Dim> body(p);
    if (!force.acts_at(body.center)) return f;
    const TwistForce whole = on_twist(force, body);
    const auto P = body.twists();
    f.force = P * whole.force;
    const Eigen::MatrixXd slope = P * whole.slope * P.transpose();
    for (int i = 0; i < slope.rows(); ++i)
      for (int j = 0; j < slope.cols(); ++j)
        if (slope(i, j) != 0) f.slope.emplace_back(i, j, slope(i, j));
    return f;
  }

 private:
  TwistForce on_twist(const Force<Dim>& force, const MovedBody<Dim>& body) const {
    if (force.is_field()) return {field_on(force, body, t_), Slope6::Zero()};
    if (force.spec.kind == ForceKind::load) return {load_on(force, body, t_), Slope6::Zero()};
    if (force.spec.kind == ForceKind::wind) return wind_on(force, body);
    TwistForce drag;
    drag.slope = std::max(0.0, force.rate(body.center, t_)) * mass_of_twist(body);
    Twist6 w = Twist6::Zero();
    w.template head<3>() = force.velocity(body.center, t_);
    drag.force = drag.slope * w;
    return drag;
  }

  // F = C rho/2 int |w - v| (w - v) over the dry surface that faces it.
  TwistForce wind_on(const Force<Dim>& force, const MovedBody<Dim>& body) const {
    const SurfaceMesh& surface = body.participant.body().contact_surface();
    const std::vector<Vec<Dim>> points = placed_points<Dim>(surface, body.pose);
    const Twist6 V = body.twists().transpose() * body.participant.velocity();
    const double round = std::pow(body.participant.body().facet_ratio(), 1 - 1.0 / Dim);  // facets cut areas, too
    TwistForce sum;
    for (const FacetPiece<Dim>& piece :
         cut_at_cells(domain_.layout.geometry(), domain_.layout.cells(), surface, points)) {
      const double dry = dry_part(piece.cell);
      if (dry == 0) continue;
      for_each_point_on(corners_of(piece, surface, points), [&](const Vec<Dim>& at, double weight) {
        const Vec3 x = extend<Dim>(at), w = force.velocity(x, t_);
        const Eigen::Matrix<double, 3, 6> G = velocity_at(x - body.center);
        const double rate = round * dry * weight * wind_rate(force.spec, w - G * V, extend<Dim>(piece.normal));
        sum.force += rate * G.transpose() * w;
        sum.slope += rate * G.transpose() * G;
      });
    }
    std::vector<double> all(sum.force.begin(), sum.force.end());
    all.insert(all.end(), sum.slope.data(), sum.slope.data() + sum.slope.size());
    domain_.ranks.global_sum(all);
    return {Twist6(all.data()), Slope6(all.data() + 6)};
  }

  // Part of a cell that no liquid fills, by its level set.
  double dry_part(const IVec<Dim>& cell) const {
    return std::clamp(0.5 + state_.phi[domain_.layout.site(cell)] / domain_.layout.h(), 0.0, 1.0);
  }

  Vec<Dim> node_at(const ElasticParticipant<Dim>& p, int n) const {
    return p.body().elastic().body.mesh.nodes[std::size_t(n)] + p.motion().state.u.template segment<Dim>(Dim * n);
  }

  void act_on_nodes(const Force<Dim>& force, const ElasticParticipant<Dim>& p, UnknownForce& f) const {
    const Eigen::VectorXd& mass = p.body().elastic().body.lumped_mass;
    for (int n = 0; n < int(mass.size()) / Dim; ++n) {
      const Vec3 x = extend<Dim>(node_at(p, n));
      if (!force.acts_at(x)) continue;
      const double rate = force.is_field() ? 0 : std::max(0.0, force.rate(x, t_));
      const Vec3 a = force.is_field() ? force.field_at(x, t_) : Vec3(rate * force.velocity(x, t_));
      add_at_node(n, mass[Dim * n] * truncate<Dim>(a), rate * mass[Dim * n], f);
    }
  }

  // Each facet's load goes to its corners in equal parts.
  void wind_on_nodes(const Force<Dim>& force, const ElasticParticipant<Dim>& p, UnknownForce& f) const {
    const auto& solid = p.body().elastic();
    const Eigen::VectorXd v = p.velocity();
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(2 * f.force.size());  // forces, then rates
    for (const auto& facet : facets_of<Dim>(solid.surface.facets)) {
      std::vector<Vec<Dim>> corners;
      Vec<Dim> middle = Vec<Dim>::Zero(), velocity = Vec<Dim>::Zero();
      for (int i = 0; i < Dim; ++i) {
        const int n = solid.surface.nodes[std::size_t(facet[std::size_t(i)])];
        corners.push_back(node_at(p, n));
        middle += corners.back() / Dim;
        velocity += v.template segment<Dim>(Dim * n) / Dim;
      }
      const auto cell = cell_of(middle);
      if (!cell || !force.acts_at(extend<Dim>(middle))) continue;
      const Vec3 w = force.velocity(extend<Dim>(middle), t_), area = extend<Dim>(area_vector(corners));
      const double rate =
          area.norm() * dry_part(*cell) * wind_rate(force.spec, w - extend<Dim>(velocity), area.stableNormalized());
      for (int i = 0; i < Dim; ++i) {
        const int n = Dim * solid.surface.nodes[std::size_t(facet[std::size_t(i)])];
        sums.template segment<Dim>(n) += rate / Dim * truncate<Dim>(w);
        sums.template segment<Dim>(f.force.size() + n).array() += rate / Dim;
      }
    }
    domain_.ranks.global_sum(std::span(sums.data(), std::size_t(sums.size())));
    for (int n = 0; n < int(f.force.size()) / Dim; ++n)
      add_at_node(n, sums.template segment<Dim>(Dim * n), sums[f.force.size() + Dim * n], f);
  }

  static void add_at_node(int n, const Vec<Dim>& force, double rate, UnknownForce& f) {
    f.force.template segment<Dim>(Dim * n) += force;
    for (int a = 0; a < Dim && rate > 0; ++a) f.slope.emplace_back(Dim * n + a, Dim * n + a, rate);
  }

  // Area times the outward normal of a facet.
  static Vec<Dim> area_vector(const std::vector<Vec<Dim>>& c) {
    if constexpr (Dim == 2)
      return {c[1][1] - c[0][1], c[0][0] - c[1][0]};
    else
      return 0.5 * (c[1] - c[0]).cross(c[2] - c[0]);
  }

  // The owned cell that holds x, if any.
  std::optional<IVec<Dim>> cell_of(const Vec<Dim>& x) const {
    const Geometry<Dim>& g = domain_.layout.geometry();
    IVec<Dim> cell;
    for (int a = 0; a < Dim; ++a) cell[a] = int(std::floor((x[a] - g.lower[a]) / g.h));
    return domain_.layout.cells().contains(cell) ? std::optional(cell) : std::nullopt;
  }

  const Domain<Dim>& domain_;
  const State<Dim>& state_;
  double t_;
};

template <int Dim>
class AppliedForces : public Interaction<Dim> {
 public:
  AppliedForces(const Domain<Dim>& domain, const std::vector<Force<Dim>>& forces) : domain_(domain), forces_(forces) {}

  // push += dt f,  M += dt k  for a force f - k v.
  void add_forces(const CoupledStep<Dim>& step, CouplingParts<Dim>& parts) const override {
    SolidCoupling<Dim>& c = parts.coupling;
    const double t = step.state.time - 0.5 * step.dt;
    std::vector<Eigen::Triplet<double>> slope;
    for (std::size_t b = 0; b < c.bodies.size(); ++b) {
      const int first = c.first[b];
      for_each_force(step.state, std::size_t(c.bodies[b]), t, [&](const UnknownForce& f) {
        for (Eigen::Index i = 0; i < f.force.size(); ++i)
          if (!c.is_held(first + i)) c.push[first + i] += step.dt * f.force[i];
        for (const auto& e : f.slope)
          if (!c.is_held(first + e.row()) && !c.is_held(first + e.col()))
            slope.emplace_back(first + e.row(), first + e.col(), step.dt * e.value());
      });
    }
    if (slope.empty()) return;
    SparseMatrix K(c.size(), c.size());
    K.setFromTriplets(slope.begin(), slope.end());
    c.mass += K;
  }

  double driven_work(const State<Dim>& state, double dt) const override {
    double work = 0;
    for (std::size_t k = 0; k < state.solids.size(); ++k) {
      const Eigen::VectorXd v = state.solids[k].velocity();
      if (v.size() == 0) continue;
      for_each_force(state, k, state.time - 0.5 * dt, [&](const UnknownForce& f) {
        work += dt * f.force.dot(v);
        for (const auto& e : f.slope) work -= dt * v[e.row()] * e.value() * v[e.col()];
      });
    }
    return work;
  }

 private:
  template <class Visit>
  void for_each_force(const State<Dim>& state, std::size_t k, double t, const Visit& visit) const {
    const Participant<Dim>& p = state.solids[k];
    const ForcesOnSolids<Dim> on_solids(domain_, state, t);
    for (const Force<Dim>& force : forces_)
      if (force.acts_on_solid(p.body().spec().name)) visit(on_solids.on(force, p));
  }

  const Domain<Dim>& domain_;
  const std::vector<Force<Dim>>& forces_;
};

}  // namespace

template <int Dim>
std::unique_ptr<const Interaction<Dim>> make_applied_forces(const Domain<Dim>& domain,
                                                            const std::vector<Force<Dim>>& forces) {
  return std::make_unique<AppliedForces<Dim>>(domain, forces);
}

template <int Dim>
Eigen::Matrix<double, 6, 1> steady_load(const std::vector<Force<Dim>>& forces, const Participant<Dim>& solid,
                                        const Pose& pose, double t) {
  const MovedBody<Dim> body(solid, pose);
  Twist6 sum = Twist6::Zero();
  for (const Force<Dim>& force : forces) {
    if (!force.acts_on_solid(solid.body().spec().name) || !force.acts_at(body.center)) continue;
    if (force.is_field()) sum += field_on(force, body, t);
    if (force.spec.kind == ForceKind::load) sum += load_on(force, body, t);
  }
  return sum;
}

template Twist6 steady_load<2>(const std::vector<Force<2>>&, const Participant<2>&, const Pose&, double);
template Twist6 steady_load<3>(const std::vector<Force<3>>&, const Participant<3>&, const Pose&, double);
template std::unique_ptr<const Interaction<2>> make_applied_forces<2>(const Domain<2>&, const std::vector<Force<2>>&);
template std::unique_ptr<const Interaction<3>> make_applied_forces<3>(const Domain<3>&, const std::vector<Force<3>>&);

}  // namespace seiche
