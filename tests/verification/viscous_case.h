#pragma once
// The viscous operator on one grid, and its saddle-point system, solved by a direct method.

#include "base/scene.h"
#include "coupling/geometry/step_geometry.h"
#include "fluid/viscosity/no_slip_flux.h"
#include "grid/loops.h"
#include "grid/partition.h"
#include "levelset/redistance.h"
#include "lu_solves.h"
#include "scenes.h"

namespace seiche::test {

template <int Dim>
class ViscousCase {
 public:
  struct Settings {
    int cells = 16;
    double size = 1;
    SideType sides = SideType::no_slip;
    double density = 1, viscosity = 1, dt = 1;
    std::vector<SolidSpec> solids;
    std::function<double(const Vec<Dim>&)> phi = [](const Vec<Dim>&) { return -1.0; };
  };

  explicit ViscousCase(
      const Settings& settings, std::function<void(Scene&)> change = [](Scene&) {})
      : settings_(settings),
        scene_(make_scene(settings, change)),
        layout_(geometry(), partition(geometry(), ranks_.size())[std::size_t(ranks_.rank())], 4),
        halo_(layout_, partition(geometry(), ranks_.size()), ranks_),
        sides_(scene_.domain),
        bodies_(make_bodies()),
        solids_(layout_, sides_, bodies_),
        step(solids_.measure(std::vector<Placement>(bodies_.size()), 0)),
        phi(layout_),
        viscosity(layout_, settings.viscosity),
        pressure(layout_),
        u_star(layout_),
        u(layout_),
        projection_{layout_, halo_, ranks_, phi, step.faces, settings.density, settings.dt, nullptr} {
    for (const SolidSpec& s : settings.solids) solids.emplace_back().no_slip = s.slip == Slip::no_slip;
    for_each_index(layout_, layout_.cells(),
                   [&](Site s, const IVec<Dim>& i) { phi[s] = settings.phi(layout_.position(i, cell_offset<Dim>())); });
    fill_level_set_ghosts(layout_, halo_, phi);
  }

  // A body with a prescribed rigid motion.
  void move(int body, const RigidField& motion) {
    solids[body].frame = motion;
    set_twist(layout_, body, {motion.linear, motion.angular, motion.center}, step);
  }
  // A body with an unknown twist.
  void release(int body, const Vec3& center) {
    solids[body].frame = {Vec3::Zero(), Vec3::Zero(), center};
    solids[body].first_unknown = unknowns;
    solids[body].rigid = true;
    unknowns += Dim == 2 ? 3 : 6;
  }
  void set(FaceField<Dim>& field, const std::function<double(int, const Vec<Dim>&)>& value) const {
    for (int a = 0; a < Dim; ++a)
      for_each_index_in_order(layout_, layout_.padded(), [&](Site f, const IVec<Dim>& i) {
        field.at(a, f) = value(a, layout_.position(i, face_offset<Dim>(a)));
      });
  }

  // Keeps a reference.
  void let_part(const Separation<Dim>& separation) { projection_.separation = &separation; }

  void assemble() {
    rows = number_rows(projection_);
    system = assemble_viscosity(input());
  }
  ViscousInput<Dim> input() const {
    return {layout_,           halo_,        ranks_, sides_,   phi,         step.faces,
            step.psi,          step.body,    solids, unknowns, viscosity,   uniform,
            settings_.density, settings_.dt, 0.0,    u_star,   projection_, rows};
  }

  // Solves [F D'; D 0] with one multiplier a closed component, and sets u.
  void solve() {
    const NullSpace closed = find_closed_components(projection_, rows);
    const int n = system.F.rows(), m = system.D.rows(), size = n + m + closed.count;
    std::vector<Eigen::Triplet<double>> t;
    visit(system.F, [&](int i, int j, double v) { t.emplace_back(i, j, v); });
    visit(system.D, [&](int i, int j, double v) { t.emplace_back(n + i, j, v), t.emplace_back(j, n + i, v); });
    for (int i = 0; i < m; ++i)
      if (closed.component[i] >= 0) {
        t.emplace_back(n + i, n + m + closed.component[i], 1);
        t.emplace_back(n + m + closed.component[i], n + i, 1);
      }
    Eigen::SparseMatrix<double> K(size, size);
    K.setFromTriplets(t.begin(), t.end());
    Eigen::VectorXd b = Eigen::VectorXd::Zero(size);
    for (int i = 0; i < n; ++i) b[i] = system.f[i];
    for (int i = 0; i < m; ++i) b[n + i] = system.q[i];
    const Eigen::VectorXd x = testing::sparse_lu_solve(K, b);
    solved = x.size() == size && (K * x - b).norm() <= 1e-8 * (b.norm() + 1e-300);
    pressure.fill(0);
    for (int i = 0; i < m; ++i) pressure[rows.cells[i]] = -x[n + i] / settings_.dt;
    u = u_star;
    for (int i = 0; i < n; ++i) u.at(system.rows.faces[i].first, system.rows.faces[i].second) = x[i];
    for (int a = 0; a < Dim; ++a)
      for_each_site(layout_, layout_.faces(a), [&](Site f) {
        if (step.faces.kind_at(a, f) == FaceKind::prescribed) u.at(a, f) = step.faces.prescribed.at(a, f);
      });
    halo_.fill_ghosts(u);
  }

  // Repeats the solve with the fluxes of cut faces from the solve before. Returns the last relative change of u.
  double solve_with_flux(int turns) {
    assemble();
    solve();
    double change = 0;
    const PagedFaceField<Dim> closed = step.faces.closed_flux;
    std::vector<RigidField> motion;
    for (const auto& s : solids) motion.push_back(s.frame);
    for (int n = 0; n < turns; ++n) {
      const FaceField<Dim> before = u;
      step.faces.closed_flux = closed;
      FaceField<Dim> added(layout_);
      add_no_slip_flux(input(), *system.samples, motion, u, added);
      for (int a = 0; a < Dim; ++a)
        for_each_index_in_order(layout_, layout_.grown(1),
                                [&](Site f, const IVec<Dim>&) { step.faces.closed_flux.add(a, f, added.at(a, f)); });
      assemble();
      solve();
      change = difference(before);
    }
    step.faces.closed_flux = closed;
    return change;
  }
  double difference(const FaceField<Dim>& v) const {
    double most = 0, scale = 0;
    for (const auto& [a, f] : system.rows.faces) {
      most = std::max(most, std::abs(u.at(a, f) - v.at(a, f)));
      scale = std::max(scale, std::abs(u.at(a, f)));
    }
    return most / scale;
  }

  template <class Visit>
  static void visit(const DistributedMatrix& m, const Visit& f) {
    for (int i = 0; i < m.rows(); ++i)
      for (int k = m.row_start[i]; k < m.row_start[i + 1]; ++k) f(i, int(m.column[k]), m.value[k]);
  }
  // [F G; G' Hvv] as a dense matrix, without the mass if asked.
  Eigen::MatrixXd dense(bool with_mass) const {
    const int n = system.F.rows(), k = unknowns;
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n + k, n + k);
    visit(system.F, [&](int i, int j, double v) { K(i, j) += v; });
    system.G.for_each([&](int i, int c, double v) { K(i, n + c) += v, K(n + c, i) += v; });
    K.bottomRightCorner(k, k) = Eigen::MatrixXd(system.Hvv);
    for (int i = 0; i < n && !with_mass; ++i) K(i, i) -= system.mass[i];
    return K;
  }

  // Torque of the pressure on a body about a point.
  Vec3 pressure_torque(int body, const Vec3& about) const {
    Vec3 sum = Vec3::Zero();
    for (const FaceShare& s : *step.shares[body]) {
      if (!layout_.faces(s.axis).contains(layout_.index(s.face))) continue;
      const double push =
          s.closed * geometry().face_area() * (pressure[s.face - layout_.stride(s.axis)] - pressure[s.face]);
      sum += (extend<Dim>(position(s.axis, s.face)) - about).cross(push * Vec3::Unit(s.axis));
    }
    return sum;
  }

  // Root mean square of the error over the liquid's own faces.
  double error(const std::function<double(int, const Vec<Dim>&)>& exact) const {
    double sum = 0;
    int count = 0;
    for (const auto& [a, f] : system.rows.faces) {
      if (face_psi(a, f) <= 0) continue;
      const double e = u.at(a, f) - exact(a, position(a, f));
      sum += e * e, ++count;
    }
    return std::sqrt(Dim * sum / count);
  }
  double face_psi(int a, Site f) const {
    double sum = 0;
    for (int k = 0; k < 1 << (Dim - 1); ++k) {
      Site node = f;
      for (int b = 1; b < Dim; ++b) node += ((k >> (b - 1)) & 1) * layout_.stride((a + b) % Dim);
      sum += step.psi[node];
    }
    return sum / (1 << (Dim - 1));
  }
  Vec<Dim> position(int a, Site f) const { return layout_.position(layout_.index(f), face_offset<Dim>(a)); }
  const ProjectionInput<Dim>& projection() const { return projection_; }
  const Layout<Dim>& layout() const { return layout_; }

 private:
  static Scene make_scene(const Settings& s, const std::function<void(Scene&)>& change) {
    Scene scene = box_scene(Dim, s.cells, s.size);
    for (int a = 0; a < Dim; ++a)
      for (SideSpec& side : scene.domain.sides[a]) side.type = s.sides;
    change(scene);
    return scene;
  }
  Geometry<Dim> geometry() const {
    Geometry<Dim> g;
    g.h = scene_.domain.cell_size;
    for (int a = 0; a < Dim; ++a) {
      g.cells[a] = scene_.domain.cells[a];
      g.periodic[a] = scene_.domain.sides[a][0].type == SideType::periodic;
    }
    return g;
  }
  std::vector<Body<Dim>> make_bodies() {
    std::vector<Body<Dim>> bodies;
    for (const SolidSpec& spec : settings_.solids)
      bodies.emplace_back(spec, ShapeOptions{layout_.h(), nullptr}, Vec<Dim>::Zero(),
                          truncate<Dim>(scene_.domain.upper));
    return bodies;
  }

  Settings settings_;
  Communicator ranks_;
  Scene scene_;
  Layout<Dim> layout_;
  Halo<Dim> halo_;
  DomainBoundary<Dim> sides_;
  std::vector<Body<Dim>> bodies_;
  SolidGeometry<Dim> solids_;

 public:
  StepGeometry<Dim> step;
  CellField<Dim> phi, viscosity, pressure;
  FaceField<Dim> u_star, u;
  std::vector<ViscousSolid<Dim>> solids;
  int unknowns = 0;
  bool uniform = true, solved = false;
  PressureRows<Dim> rows;
  ViscousSystem<Dim> system;

 private:
  ProjectionInput<Dim> projection_;
};

inline SolidSpec viscous_solid(const std::string& kind, Slip slip = Slip::no_slip) {
  SolidSpec s;
  s.name = kind;
  s.kind = SolidKind::kinematic;
  s.slip = slip;
  s.shape.kind = kind;
  s.shape.where = "test";
  return s;
}

inline SolidSpec viscous_ball(const Vec3& center, double radius, bool container = false) {
  SolidSpec s = viscous_solid("sphere");
  s.shape.center = center;
  s.shape.radius = radius;
  s.shape.invert = container;
  return s;
}

}  // namespace seiche::test
