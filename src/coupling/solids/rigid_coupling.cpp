#include "coupling/solids/rigid_coupling.h"

#include <algorithm>

#include "base/domain_spec.h"
#include "base/scene.h"
#include "coupling/solids/coupled_step.h"
#include "coupling/solids/exposed_surface.h"
#include "coupling/solids/surface_load.h"
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "fluid/boundary/domain.h"
#include "linalg/core/matrix_entries.h"
#include "solid/body/mass_properties.h"

namespace seiche {
namespace {

template <int Dim>
using Generalised = Eigen::Matrix<double, twist_size<Dim>, 1>;

// Sums over the face shares of one body.
template <int Dim>
struct Sums {
  Vec<Dim> volume = Vec<Dim>::Zero();                    // sum_f s A h over the faces of each axis
  std::array<Vec3, Dim> moment;                          // sum_f s A h (x_f - X), X the centre of mass
  double wet = 0, surface = 0;                           // |net area| of wet cells, by density, and of all cells
  double dry = 0, level = 0, count = 0;                  // |net area| beyond phi = 0; heights of phi = 0, their number
  Generalised<Dim> missing = Generalised<Dim>::Zero();   // missing_load(), of bodies that others reach into
  std::vector<std::pair<Site, Generalised<Dim>>> cells;  // net area and moment of each cell, by site
  Sums() { moment.fill(Vec3::Zero()); }
};

// Derivatives of v_a + (omega x (x - X))_a, the velocity along an axis at x, by the body's unknowns. arm: x - X.
template <int Dim>
Generalised<Dim> face_mode(int axis, const Vec3& arm) {
  Vec3 e = Vec3::Zero();
  e[axis] = 1;
  return stacked<Dim>(e, arm.cross(e));
}

template <int Dim>
Sums<Dim> add_up(const Domain<Dim>& domain, const FaceShares& shares, const Vec3& center) {
  Sums<Dim> sums;
  const Layout<Dim>& l = domain.layout;
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

// Net areas below this are round-off. A body closes the cells inside it alike on all sides, and they have no row.
constexpr double smallest_face = 1e-12;

// Gravity and fields at a point, m/s^2: what liquid at rest there hangs on.
template <int Dim>
Vec3 pull_at(const CoupledStep<Dim>& step, const Vec3& x) {
  const double end = step.state.time;
  return pull_on_liquid(step.setup.fluids.gravity.of_step(end, step.dt), step.setup.forces, x, end - 0.5 * step.dt);
}

// Unit vector against gravity; zero without gravity.
Vec3 upwards(const Vec3& gravity) {
  return gravity.norm() > 0 ? Vec3(-gravity.normalized()) : Vec3(Vec3::Zero());
}

template <int Dim>
Vec3 center_of(const Layout<Dim>& l, Site cell) {
  return extend<Dim>(l.position(l.index(cell), cell_offset<Dim>()));
}

// Notes how a cell beside the body lies to the liquid's surface, whose height there is x.up - phi where it is level.
template <int Dim>
void look_at_surface(const Layout<Dim>& l, const CellField<Dim>& phi, Site cell, double area, const Vec3& up,
                     Sums<Dim>& sums) {
  if (phi[cell] >= 0) sums.dry += area;
  if (std::abs(phi[cell]) > l.h()) return;
  sums.level += up.dot(center_of(l, cell)) - phi[cell];
  sums.count += 1;
}

// The body's block of J. Also sets sums.surface and sums.wet; gas counts as wet by its density over the liquid's.
template <int Dim>
ColumnBlock make_block(const CoupledStep<Dim>& step, const Vec3& center, const Generalised<Dim>& mask,
                       Sums<Dim>& sums) {
  const Domain<Dim>& domain = step.setup.domain;
  const Fluids& fluids = step.setup.fluids;
  const CellField<Dim>& phi = step.state.phi;
  const PressureRows<Dim>& rows = step.rows;
  const Vec3 up = upwards(pull_at(step, center));
  const double dry = fluids.gas_density() / fluids.density();
  ColumnBlock block;
  block.width = twist_size<Dim>;
  std::vector<MatrixEntry> of_air;
  for (const auto& [cell, mode] : sums.cells) {
    const double area = mode.template head<Dim>().norm();
    const bool wet = rows.has_pressure(cell);
    if (area > smallest_face) {
      sums.surface += area;
      sums.wet += wet ? area * (phi[cell] < 0 ? 1 : dry) : 0;
      look_at_surface(domain.layout, phi, cell, area, up, sums);
    }
    for (int k = 0; k < block.width && rows.row[cell] >= 0; ++k)
      if (wet)
        block.add(int(rows.row[cell] - rows.first), k, mask[k] * mode[k]);
      else
        of_air.push_back({rows.row[cell], k, mask[k] * mode[k]});
  }
  if (rows.air)
    for (const MatrixEntry& e : send_sums_to_owner(of_air, rows.first, rows.cells.size(), domain.ranks))
      block.add(int(e.row - rows.first), int(e.column), e.value);
  return block;
}

// Packs the sums over the ranks into numbers; read_sums() unpacks them.
template <int Dim>
void append(const Sums<Dim>& s, std::vector<double>& all) {
  for (int a = 0; a < Dim; ++a) all.insert(all.end(), {s.volume[a], s.moment[a][0], s.moment[a][1], s.moment[a][2]});
  all.insert(all.end(), {s.wet, s.surface, s.dry, s.level, s.count});
  all.insert(all.end(), s.missing.begin(), s.missing.end());
}

template <int Dim>
Sums<Dim> read_sums(const double* next) {
  Sums<Dim> s;
  for (int a = 0; a < Dim; ++a, next += 4) s.volume[a] = next[0], s.moment[a] = Vec3(next[1], next[2], next[3]);
  s.wet = next[0], s.surface = next[1], s.dry = next[2], s.level = next[3], s.count = next[4];
  s.missing = Eigen::Map<const Generalised<Dim>>(next + 5);
  return s;
}

// The load of p over the pieces of body k's surface that no other solid covers (surface_load.h).
template <int Dim, class Pressure>
Generalised<Dim> load_on_surface(const CoupledStep<Dim>& step, const Body<Dim>& body, int k, const Vec3& center,
                                 const CellField<Dim, char>& open, const Pressure& p) {
  const SurfaceMesh& surface = body.contact_surface();
  const std::vector<Vec<Dim>> points = placed_points<Dim>(surface, step.geometry.placed[std::size_t(k)].pose);
  const JointedNeighbours<Dim> neighbours(step.setup.domain, step.setup.solids, step.geometry, k);
  const SolidLoad load =
      load_on_pieces(exposed_pieces(step.setup.domain, open, surface, points, neighbours), surface, points, center, p);
  return stacked<Dim>(load.force, load.torque);
}

// The load -rho int g.(x - x_c) n dA over the pieces of the surface that no other solid covers, and its moment about X:
// liquid at rest exerts it beyond J'p, which takes the pressure of the centre x_c of the cell that acts on a piece.
// This rank's part.
template <int Dim>
Generalised<Dim> missing_load(const CoupledStep<Dim>& step, const Body<Dim>& body, int k, const Vec3& center,
                              const CellField<Dim, char>& open) {
  const Vec3 gravity = pull_at(step, center);
  return load_on_surface(step, body, k, center, open, [&](Site cell, const Vec3& x) {
    return density_beside(step.setup.fluids, step.rows, step.state.phi, cell) *
           gravity.dot(x - center_of(step.setup.domain.layout, cell));
  });
}

// Load that J'p misses of p(x) = rho g.(x - x_0), x_0 at the `level` of the liquid (m along up): that of p
// on the wet pieces of the surface, less A J'p of its values at the wet cells' centres. It is exact for any shares of
// faces. Pieces and cells next to the level have p near 0, so which of them are wet matters to second order. Facets cut
// a little off round shapes; loads count by the ratio of the volumes. This rank's part.
template <int Dim>
Generalised<Dim> floating_load(const CoupledStep<Dim>& step, const Body<Dim>& body, int k, const Vec3& center,
                               double level, const CellField<Dim, char>& open) {
  const Domain<Dim>& domain = step.setup.domain;
  const Vec3 gravity = pull_at(step, center), origin = level * upwards(gravity);
  const auto pressure = [&](Site cell, const Vec3& x) {
    return density_beside(step.setup.fluids, step.rows, step.state.phi, cell) * gravity.dot(x - origin);
  };
  Generalised<Dim> missing = body.facet_ratio() * load_on_surface(step, body, k, center, open, pressure);
  const double face = domain.layout.geometry().cell_volume() / domain.layout.h();
  for (const auto& [cell, mode] : add_up(domain, *step.geometry.shares[std::size_t(k)], center).cells)
    missing -= face * pressure(cell, center_of(domain.layout, cell)) * mode;
  return missing;
}

// Pressure rho g.x + const on the face shares gives the force -rho g_a V_a along each axis and the torque
// -rho sum_a g_a m_a x e_a. On the body itself it gives -rho g V at the centre of the volume, `arm` from that of mass.
// The difference, times the wet part of the surface.
template <int Dim>
Generalised<Dim> buoyancy_difference(const Sums<Dim>& sums, double volume, const Vec3& arm,
                                     const Vec3& weight_of_liquid) {
  const double wet = sums.surface > 0 ? sums.wet / sums.surface : 0;
  Vec3 force = Vec3::Zero(), torque = -volume * arm.cross(weight_of_liquid);
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

// Fixed axes keep their diagonal entry and lose their coupling to the others.
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
void couple_rigid_body(const CoupledStep<Dim>& step, const Body<Dim>& body, const RigidState& r, int block,
                       CouplingParts<Dim>& parts) {
  constexpr int n = twist_size<Dim>;
  const Setup<Dim>& s = step.setup;
  SolidCoupling<Dim>& c = parts.coupling;
  const int first = c.first[std::size_t(block)];
  const Generalised<Dim> mask = freedom_mask<Dim>(body.spec().rigid);
  for (int i = 0; i < n; ++i) c.freedom[std::size_t(first + i)] = mask[i] != 0 ? Freedom::free : Freedom::fixed;
  Sums<Dim> sums = add_up(s.domain, *step.geometry.shares[std::size_t(c.bodies[std::size_t(block)])], r.center);
  c.J.blocks[std::size_t(block)] = make_block(step, r.center, mask, sums);
  const int k = c.bodies[std::size_t(block)];
  if (step.rows.global > 0 && !jointed_neighbours(s.solids, step.geometry.placed, k).empty()) {
    if (!parts.open) parts.open = open_cells(s.domain, step.geometry.faces);
    sums.missing = missing_load(step, body, k, r.center, *parts.open);
  }
  append(sums, parts.sums);
  add_mass<Dim>(s.perturbation.rigid_mass * mass_block<Dim>(body.mass().mass, world_inertia(body, r)), mask, first,
                parts.mass);
  const Twist v = free_twist(body, r, s.fluids.gravity.of_step(step.state.time, step.dt), step.dt, step.horizon);
  c.free.template segment<n>(first) = stacked<Dim>(v.linear, v.angular);
}

template <int Dim>
void add_buoyancy(const CoupledStep<Dim>& step, const Body<Dim>& body, const RigidState& r, int block,
                  const double* sums, CouplingParts<Dim>& parts) {
  constexpr double trace = 1e-9;  // of the surface: round-off
  const Setup<Dim>& s = step.setup;
  SolidCoupling<Dim>& c = parts.coupling;
  const int k = c.bodies[std::size_t(block)], first = c.first[std::size_t(block)];
  if (step.rows.global == 0) return;  // no pressure acts
  const Pose& pose = step.geometry.placed[std::size_t(k)].pose;
  if (!lies_within(s.domain.layout.geometry(), placed_points<Dim>(body.contact_surface(), pose))) return;
  const Sums<Dim> all = read_sums<Dim>(sums);
  const bool jointed = !jointed_neighbours(s.solids, step.geometry.placed, k).empty();
  if (!jointed && all.wet > 0 && all.dry > trace * all.surface && all.count > 0) {
    if (!parts.open) parts.open = open_cells(s.domain, step.geometry.faces);
    if (parts.missing.size() == 0) parts.missing.setZero(c.size());
    parts.missing.template segment<twist_size<Dim>>(first) =
        floating_load(step, body, k, r.center, all.level / all.count, *parts.open);
    return;
  }
  const Vec3 arm = pose.rotation * Vec3(body.mass().centroid - body.mass().center);
  const Vec3 weight = s.fluids.density() * pull_at(step, r.center);
  const Generalised<Dim> missing = jointed ? all.missing : buoyancy_difference(all, body.mass().volume, arm, weight);
  c.buoyancy_correction.template segment<twist_size<Dim>>(first) = missing;
}

#define SEICHE_INSTANTIATE(D)                                                                                 \
  template Eigen::Matrix<double, twist_size<D>, 1> stacked<D>(const Vec3&, const Vec3&);                      \
  template Twist unstacked<D>(const Eigen::VectorXd&, int, const Vec3&);                                      \
  template void couple_rigid_body<D>(const CoupledStep<D>&, const Body<D>&, const RigidState&, int,           \
                                     CouplingParts<D>&);                                                      \
  template void add_buoyancy<D>(const CoupledStep<D>&, const Body<D>&, const RigidState&, int, const double*, \
                                CouplingParts<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
