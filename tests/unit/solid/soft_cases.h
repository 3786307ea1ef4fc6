#pragma once
// Time steps (backward Euler) of elastic and rigid bodies with contact, for the tests.
#include "solid/contact/system.h"
#include "solid/elastic/potential.h"
#include "unit/solid/contact_cases.h"
#include "unit/solid/elastic_cases.h"

namespace seiche::testing {

// Triangles in a disc, tetrahedra in a ball: the box [-1, 1]^Dim mapped such that cubes become spheres.
template <int Dim>
ElasticMesh<Dim> ball_mesh(double radius, const Vec<Dim>& center, int cells, int order) {
  ElasticMesh<Dim> mesh = box_mesh<Dim>(-Vec<Dim>::Ones(), Vec<Dim>::Ones(), IVec<Dim>::Constant(cells), order);
  for (Vec<Dim>& X : mesh.nodes) {
    const double size = X.norm(), side = X.cwiseAbs().maxCoeff();
    const double share = side * side;  // straight inside, round outside
    if (size > 0) X *= (1 - share) * 0.75 + share * side / size;
    X = center + radius * X;
  }
  return mesh;
}

template <int Dim>
struct SoftBody {
  ElasticBody<Dim> body;
  ElasticState state;
  std::optional<double> friction;
  std::map<int, double> held;  // velocities of fixed degrees of freedom, m/s
};

// Rigid bodies come first, soft ones after them.
template <int Dim>
struct SoftWorld {
  std::vector<contact_cases::DryBody<Dim>> rigid;
  std::vector<SoftBody<Dim>> soft;
  std::vector<ContactWall> walls;
  Vec3 gravity{0, 0, 0};
  ContactOptions options;
  ContactReport report;
  int newton_iterations = 0;

  SoftBody<Dim>& add(ElasticMesh<Dim> mesh, double density, double E, double nu) {
    auto body = elastic_body<Dim>(std::move(mesh), "stable_neo_hookean", density, E, nu);
    const ElasticState state = at_rest(body);
    soft.push_back({std::move(body), state, {}, {}});
    return soft.back();
  }
  contact_cases::DryBody<Dim>& add_rigid(const SurfaceMesh& surface, const Vec3& center, double mass,
                                         const Vec3& inertia) {
    contact_cases::DryBody<Dim> b;
    b.contact.surface = surface;
    b.contact.mass = mass;
    b.pose.displacement = center;
    b.inertia = inertia;
    rigid.push_back(b);
    return rigid.back();
  }

  double mass(const SoftBody<Dim>& s) const { return s.body.lumped_mass.sum() / Dim; }

  ContactScene<Dim> scene() const {
    std::vector<ContactBody> list;
    for (const auto& b : rigid) list.push_back(b.contact);
    for (const auto& s : soft) {
      const ElasticSurface surface = surface_of<Dim>(s.body.mesh);
      list.push_back({surface.facets, BodyControl::deformable, mass(s), s.friction, "", surface.nodes,
                      int(s.body.mesh.nodes.size())});
    }
    return {list, walls};
  }
  std::vector<ContactMotion> motions(const std::map<int, Pose>& ends = {}) const {
    std::vector<ContactMotion> list;
    for (size_t b = 0; b < rigid.size(); ++b)
      list.push_back({rigid[b].pose, ends.count(int(b)) ? ends.at(int(b)) : rigid[b].pose});
    for (const auto& s : soft) list.push_back({{}, {}, s.state.u});
    return list;
  }

  // Terms of inertia, gravity and fixed velocities, M (v - v_n - dt g).
  DryProblem problem(double dt) const {
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<double> target, velocities;
    std::vector<Freedom> freedom;
    for (const auto& b : rigid) {
      if (b.contact.control == BodyControl::prescribed) continue;
      const int begin = int(target.size());
      contact_cases::TwistVector<Dim> v = b.velocity;
      v.template head<Dim>() += dt * gravity.template head<Dim>();
      for (int i = 0; i < twist_size<Dim>; ++i)
        entries.emplace_back(begin + i, begin + i, i < Dim ? b.contact.mass : b.inertia[Dim == 2 ? 2 : i - Dim]);
      target.insert(target.end(), v.data(), v.data() + v.size());
    }
    freedom.assign(target.size(), Freedom::free);
    velocities.assign(target.size(), 0);
    for (const auto& s : soft) {
      const int begin = int(target.size());
      for (int c = 0; c < s.body.mass.outerSize(); ++c)
        for (SparseMatrix::InnerIterator m(s.body.mass, c); m; ++m)
          entries.emplace_back(begin + int(m.row()), begin + c, m.value());
      for (int i = 0; i < s.body.size(); ++i) {
        target.push_back(s.state.v[i] + dt * gravity[i % Dim]);
        freedom.push_back(s.held.count(i) ? Freedom::fixed : Freedom::free);
        velocities.push_back(s.held.count(i) ? s.held.at(i) : 0);
      }
    }
    const int size = int(target.size());
    Eigen::SparseMatrix<double> M(size, size);
    M.setFromTriplets(entries.begin(), entries.end());
    return {M, Eigen::Map<Eigen::VectorXd>(target.data(), size), freedom,
            Eigen::Map<Eigen::VectorXd>(velocities.data(), size)};
  }

  ElasticPotential<Dim> potential(double dt, int size) const {
    std::vector<ElasticShare<Dim>> shares;
    for (size_t k = 0; k < soft.size(); ++k) shares.push_back({&soft[k].body, &soft[k].state.u, first_dof(int(k)), {}});
    return {shares, size, dt, dt};
  }
  int first_dof(int soft_body) const {
    int first = 0;
    for (const auto& b : rigid) first += b.contact.control == BodyControl::free ? twist_size<Dim> : 0;
    for (int k = 0; k < soft_body; ++k) first += soft[k].body.size();
    return first;
  }

  void step(double dt, const std::map<int, Pose>& ends = {}) {
    DryProblem inertia = problem(dt);
    const auto energy = potential(dt, inertia.size());
    const auto where = motions(ends);
    report = solve_contact<Dim>(scene(), where, dt, dt, inertia, options, {}, &energy);
    INFO(report.failure);
    REQUIRE(report.failure.empty());
    newton_iterations += report.newton_iterations;
    int begin = 0;
    for (size_t b = 0; b < rigid.size(); ++b) {
      rigid[b].pose = where[b].end;
      if (rigid[b].contact.control == BodyControl::prescribed) continue;
      rigid[b].velocity = report.velocity.template segment<twist_size<Dim>>(begin);
      rigid[b].pose = moved_pose<Dim>(where[b].start, rigid[b].velocity, dt);
      begin += twist_size<Dim>;
    }
    for (auto& s : soft) {
      s.state.v = report.velocity.segment(begin, s.body.size());
      s.state.u += dt * s.state.v;
      begin += s.body.size();
      REQUIRE(least_volume_ratio(s.body, s.state.u) > 0);
    }
  }

  // Kinetic, elastic and barrier energy of soft bodies (J), with the contact stiffness at the end of the last step.
  double energy() const {
    double sum = 0;
    for (const auto& s : soft) sum += kinetic_energy(s.body, s.state.v) + elastic_energy(s.body, s.state.u);
    const auto here = scene();
    const auto interval = contact::make_interval<Dim>(here.data(), motions(), 1);
    const auto at = contact::place<Dim>(
        here.data(), interval,
        contact::all_velocities<Dim>(here.data(), interval, Eigen::VectorXd::Zero(here.data().size), 0));
    const auto pairs = contact::find_candidates<Dim>(here.data(), at.points, at.points, options.reach);
    const contact::Weights weights{1, options.reach, report.stiffness, options.creep_speed};
    return sum + contact::contact_energy<Dim>(here.data(), interval, at, pairs, {}, weights);
  }

  int overlaps() const { return int(find_initial_overlaps<Dim>(scene(), motions(), 0).size()); }
};

}  // namespace seiche::testing
