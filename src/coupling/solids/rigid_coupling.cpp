#include "coupling/solids/rigid_coupling.h"

#include <algorithm>

#include "linalg/core/matrix_entries.h"

namespace seiche {
namespace {

template <int Dim>
using Generalised = Eigen::Matrix<double, twist_size<Dim>, 1>;

// What the faces of one body add up to.
template <int Dim>
struct Sums {
  Vec<Dim> volume = Vec<Dim>::Zero();                    // sum_f s A h over the faces of each axis
  std::array<Vec3, Dim> moment;                          // the same times (x_f - X)
  double wet = 0, surface = 0;                           // |net area| of cells with a row, and of all
  std::vector<std::pair<Site, Generalised<Dim>>> cells;  // net area and moment a cell, by site
  Sums() { moment.fill(Vec3::Zero()); }
};

// Generalised coordinates of the velocity along an axis at x: v_a + (omega x (x - X))_a.
template <int Dim>
Generalised<Dim> face_mode(int axis, const Vec3& arm) {
  Vec3 e = Vec3::Zero();
  e[axis] = 1;
  return stacked<Dim>(e, arm.cross(e));
}

template <int Dim>
Sums<Dim> add_up(const Setup<Dim>& s, const FaceShares& shares, const Vec3& center) {
  Sums<Dim> sums;
  const Layout<Dim>& l = s.layout;
  const double cell_volume = l.geometry().cell_volume();
  for (const FaceShare& share : shares) {
    const IVec<Dim> i = l.index(share.face);
    const Vec3 arm = extend<Dim>(l.position(i, face_offset<Dim>(share.axis))) - center;
    if (l.faces(share.axis).contains(i)) {
      sums.volume[share.axis] += share.closed * cell_volume;
      sums.moment[share.axis] += share.closed * cell_volume * arm;
    }
    const Generalised<Dim> mode = share.closed * face_mode<Dim>(share.axis, arm);
    IVec<Dim> low = i;
    low[share.axis] -= 1;
    if (l.cells().contains(i)) sums.cells.emplace_back(share.face, -mode);
    if (l.cells().contains(low)) sums.cells.emplace_back(share.face - l.stride(share.axis), mode);
  }
  std::stable_sort(sums.cells.begin(), sums.cells.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::size_t kept = 0;
  for (std::size_t n = 0; n < sums.cells.size(); ++n) {
    if (kept > 0 && sums.cells[kept - 1].first == sums.cells[n].first)
      sums.cells[kept - 1].second += sums.cells[n].second;
    else
      sums.cells[kept++] = sums.cells[n];
  }
  sums.cells.resize(kept);
  return sums;
}

template <int Dim>
Generalised<Dim> freedom_mask(const RigidSpec& spec) {
  Vec3 linear, angular;
  for (int a = 0; a < 3; ++a) linear[a] = !spec.fixed_position[a], angular[a] = !spec.fixed_rotation[a];
  return stacked<Dim>(linear, angular);
}

// Cells inside a body see it on all sides alike: their net area is rounding, and they have no row.
constexpr double rounding = 1e-12;

// Gas counts as wet by its density.
template <int Dim>
ColumnBlock make_block(const Setup<Dim>& s, const CellField<Dim>& phi, const PressureRows<Dim>& rows,
                       const Generalised<Dim>& mask, Sums<Dim>& sums) {
  const double dry = s.gas_density() / s.density();
  ColumnBlock block;
  block.width = twist_size<Dim>;
  std::vector<MatrixEntry> of_air;
  for (const auto& [cell, mode] : sums.cells) {
    const double area = mode.template head<Dim>().norm();
    const bool wet = rows.has_pressure(cell);
    if (area > rounding) sums.surface += area, sums.wet += wet ? area * (phi[cell] < 0 ? 1 : dry) : 0;
    for (int k = 0; k < block.width && rows.row[cell] >= 0; ++k)
      if (wet)
        block.add(int(rows.row[cell] - rows.first), k, mask[k] * mode[k]);
      else
        of_air.push_back({rows.row[cell], k, mask[k] * mode[k]});
  }
  if (rows.air)
    for (const MatrixEntry& e : bring_home_sums(of_air, rows.first, rows.cells.size(), s.ranks))
      block.add(int(e.row - rows.first), int(e.column), e.value);
  return block;
}

// Sums over the ranks of all bodies' volumes, moments and surfaces.
template <int Dim>
void sum_over_ranks(std::vector<Sums<Dim>>& sums, const Communicator& ranks) {
  std::vector<double> all;
  for (const Sums<Dim>& s : sums) {
    for (int a = 0; a < Dim; ++a) all.insert(all.end(), {s.volume[a], s.moment[a][0], s.moment[a][1], s.moment[a][2]});
    all.insert(all.end(), {s.wet, s.surface});
  }
  if (!all.empty()) ranks.global_sum(all);
  const double* next = all.data();
  for (Sums<Dim>& s : sums) {
    for (int a = 0; a < Dim; ++a, next += 4) s.volume[a] = next[0], s.moment[a] = Vec3(next[1], next[2], next[3]);
    s.wet = *next++, s.surface = *next++;
  }
}

template <int Dim>
bool lies_within(const DomainSpec& d, const Body<Dim>& body, const Pose& pose) {
  const auto& points = body.contact_surface().points;
  return std::all_of(points.begin(), points.end(), [&](const Vec3& X) {
    const Vec3 x = pose.apply(X);
    for (int a = 0; a < Dim; ++a)
      if (x[a] < d.lower[a] || x[a] > d.upper[a]) return false;
    return true;
  });
}

// Pressure rho g.x + const on the face shares gives the force -rho g_a V_a along each axis and the torque
// -rho sum_a g_a m_a x e_a; on the body itself -rho g V and none. The difference, for the wet part of the surface.
template <int Dim>
Generalised<Dim> buoyancy_difference(const Sums<Dim>& sums, double volume, const Vec3& weight_of_liquid) {
  const double wet = sums.surface > 0 ? sums.wet / sums.surface : 0;
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  for (int a = 0; a < Dim; ++a) {
    const double weight = weight_of_liquid[a];  // rho g_a
    Vec3 e = Vec3::Zero();
    e[a] = 1;
    force[a] = -weight * (volume - sums.volume[a]);
    torque += weight * sums.moment[a].cross(e);
  }
  return wet * stacked<Dim>(force, torque);
}

template <int Dim>
Eigen::Matrix<double, twist_size<Dim>, twist_size<Dim>> mass_block(double mass, const Eigen::Matrix3d& inertia) {
  constexpr int n = twist_size<Dim>;
  Eigen::Matrix<double, n, n> M = Eigen::Matrix<double, n, n>::Zero();
  M.template topLeftCorner<Dim, Dim>().diagonal().setConstant(mass);
  if constexpr (Dim == 2) M(2, 2) = inertia(2, 2);
  if constexpr (Dim == 3) M.template bottomRightCorner<3, 3>() = inertia;
  return M;
}

// Fixed axes keep their own mass and no links to the others.
template <int Dim>
void add_mass(const Eigen::Matrix<double, twist_size<Dim>, twist_size<Dim>>& M, const Generalised<Dim>& mask, int first,
              std::vector<Eigen::Triplet<double>>& entries) {
  for (int i = 0; i < M.rows(); ++i)
    for (int j = 0; j < M.cols(); ++j)
      if (M(i, j) != 0 && (i == j || (mask[i] != 0 && mask[j] != 0)))
        entries.emplace_back(first + i, first + j, M(i, j));
}

}  // namespace

template <int Dim>
Eigen::Matrix<double, twist_size<Dim>, 1> stacked(const Vec3& linear, const Vec3& angular) {
  Generalised<Dim> v;
  if constexpr (Dim == 2)
    v << linear[0], linear[1], angular[2];
  else
    v << linear, angular;
  return v;
}

template <int Dim>
Twist unstacked(const Eigen::VectorXd& v, int first, const Vec3& about) {
  if constexpr (Dim == 2) return {{v[first], v[first + 1], 0}, {0, 0, v[first + 2]}, about};
  return {v.segment<3>(first), v.segment<3>(first + 3), about};
}

template <int Dim>
void couple_rigid_bodies(const Setup<Dim>& s, const StepGeometry<Dim>& g, const PressureRows<Dim>& rows,
                         const State<Dim>& state, double dt, double horizon, CouplingParts<Dim>& parts) {
  constexpr int n = twist_size<Dim>;
  SolidCoupling<Dim>& c = parts.coupling;
  const std::vector<RigidState>& rigid = state.rigid;
  const Vec3 gravity = s.gravity.of_step(state.time, dt);
  std::vector<Sums<Dim>> sums;
  std::vector<std::size_t> places;
  for (std::size_t b = 0; b < c.bodies.size(); ++b) {
    const Body<Dim>& body = s.bodies[c.bodies[b]];
    const RigidState& r = rigid[c.bodies[b]];
    if (!body.is_rigid()) continue;
    const Generalised<Dim> mask = freedom_mask<Dim>(body.spec().rigid);
    for (int i = 0; i < n; ++i) c.freedom[c.first[b] + i] = mask[i] != 0 ? Freedom::free : Freedom::fixed;
    sums.push_back(add_up(s, *g.shares[c.bodies[b]], r.center));
    places.push_back(b);
    c.J.blocks[b] = make_block(s, state.phi, rows, mask, sums.back());
    add_mass<Dim>(s.tampering.rigid_mass * mass_block<Dim>(body.mass().mass, world_inertia(body, r)), mask, c.first[b],
                  parts.mass);
  }
  sum_over_ranks(sums, s.ranks);
  for (std::size_t m = 0; m < places.size(); ++m) {
    const int k = c.bodies[places[m]], first = c.first[places[m]];
    const Body<Dim>& body = s.bodies[k];
    const Twist v = free_twist(body, rigid[k], gravity, dt, horizon);
    c.free.template segment<n>(first) = stacked<Dim>(v.linear, v.angular);
    if (lies_within<Dim>(s.scene.domain, body, g.placed[std::size_t(k)].pose))
      c.buoyancy_correction.template segment<n>(first) =
          buoyancy_difference(sums[m], body.mass().volume, s.density() * gravity)
              .cwiseProduct(freedom_mask<Dim>(body.spec().rigid));
  }
}

// L += I (omega - omega*): what liquid and contact added to the free rotation.
template <int Dim>
void set_rigid_velocity(const Setup<Dim>& s, const SolidCoupling<Dim>& c, int k, int first, const Eigen::VectorXd& v,
                        StepGeometry<Dim>& g, RigidState& r) {
  const Twist now = unstacked<Dim>(v, first, r.center), free = unstacked<Dim>(c.free, first, r.center);
  const Eigen::Matrix3d inertia = world_inertia(s.bodies[k], r);
  r.angular_momentum = turns_freely(s.bodies[k].spec().rigid)
                           ? Vec3(r.angular_momentum + inertia * (now.angular - free.angular))
                           : Vec3(inertia * now.angular);
  r.velocity = now.linear;
  r.angular_velocity = now.angular;
  const Twist extra = unstacked<Dim>(c.buoyancy_correction, first, r.center);
  r.extra_force = extra.linear;
  r.extra_torque = extra.angular;
  set_twist(s.layout, k, now, g);
}

#define SEICHE_INSTANTIATE(D)                                                                                     \
  template Eigen::Matrix<double, twist_size<D>, 1> stacked<D>(const Vec3&, const Vec3&);                          \
  template Twist unstacked<D>(const Eigen::VectorXd&, int, const Vec3&);                                          \
  template void couple_rigid_bodies<D>(const Setup<D>&, const StepGeometry<D>&, const PressureRows<D>&,           \
                                       const State<D>&, double, double, CouplingParts<D>&);                       \
  template void set_rigid_velocity<D>(const Setup<D>&, const SolidCoupling<D>&, int, int, const Eigen::VectorXd&, \
                                      StepGeometry<D>&, RigidState&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
