#include "fluid/viscosity/viscous_terms.h"

namespace seiche {

template <int Dim>
int ViscousTerm<Dim>::add(int axis, Site face, Reading reading) {
  slot[slots] = {axis, face, reading};
  for (int i = 0; i <= slots; ++i) Q[slots][i] = Q[i][slots] = 0;
  return slots++;
}

template <int Dim>
void ViscousTerm<Dim>::add_square(int i, int j, double c) {
  Q[i][i] += c, Q[j][j] += c;
  Q[i][j] -= c, Q[j][i] -= c;
}

template <int Dim>
void ViscousTerm<Dim>::add_product(int i, int j, int k, int l, double c) {
  Q[i][k] += c, Q[k][i] += c;
  Q[j][l] += c, Q[l][j] += c;
  Q[i][l] -= c, Q[l][i] -= c;
  Q[j][k] -= c, Q[k][j] -= c;
}

// The edge's own viscosity if given, else the harmonic mean over its four cells, which is exact for shear along layers.
template <int Dim>
double ViscousTerms<Dim>::edge_viscosity(int plane, Site e) const {
  if (in_.edge_viscosity) return (*in_.edge_viscosity)[plane][std::size_t(e)];
  if (in_.uniform_viscosity) return in_.viscosity[e];
  const auto [a, b] = plane_axes<Dim>(plane);
  const Site da = in_.layout.stride(a), db = in_.layout.stride(b);
  double sum = 0;
  for (Site c : {e, e - da, e - db, e - da - db}) {
    if (in_.viscosity[c] <= 0) return 0;
    sum += 1 / in_.viscosity[c];
  }
  return 4 / sum;
}

// theta: distance from a liquid sample to the wall towards a solid sample, in cells (Gibou et al. 2002). Its lower
// bound keeps matrix entries within a factor of 1000. A sample as near has the wall's velocity up to 1e-3 of the change
// over h.
template <int Dim>
double ViscousTerms<Dim>::wall_distance(const Slot& liquid, const Slot& solid) const {
  const double outside = s_.psi.at(liquid.axis, liquid.face), inside = s_.psi.at(solid.axis, solid.face);
  if (outside <= 0) return 1e-3;
  return std::clamp(outside / (outside + std::abs(inside)), 1e-3, 1.0);
}

// Chooses the term's frame. Returns false if the term contains no unknown or touches a face of kind none.
template <int Dim>
bool ViscousTerms<Dim>::settle(ViscousTerm<Dim>& t) const {
  bool any = false;
  t.frame = -1;
  for (int i = 0; i < t.slots; ++i) {
    const SampleKind k = kind(t.slot[i]);
    if (k == SampleKind::none) return false;
    any = any || k == SampleKind::unknown;
    if (k == SampleKind::solid && t.frame < 0) t.frame = s_.solid.at(t.slot[i].axis, t.slot[i].face);
  }
  return any;
}

// 1/theta
template <int Dim>
double ViscousTerms<Dim>::link_weight(const Slot& low, const Slot& high) const {
  const SampleKind l = kind(low), h = kind(high);
  if (l == SampleKind::unknown && h == SampleKind::solid) return 1 / wall_distance(low, high);
  if (h == SampleKind::unknown && l == SampleKind::solid) return 1 / wall_distance(high, low);
  return 1;
}

// Links each of two liquid samples to the thin solid between them.
template <int Dim>
void ViscousTerms<Dim>::link_both_sides(ViscousTerm<Dim>& t, int low, int high, double c) const {
  for (int n = 0; n < 2; ++n) {
    const Slot from = t.slot[n == 0 ? low : high], to = t.slot[n == 0 ? high : low];
    t.add_square(n == 0 ? low : high, t.add(from.axis, from.face, Reading::solid), c / wall_distance(from, to));
  }
}

// Weights of an edge's two squares on sides of the domain. Returns false if the edge has no term (free slip).
// - Walls and inflow: half a cell away from the liquid sample, so the weight is 2.
// - Outflow: half the dual cell is outside, and d_n u = 0 across the side. If products do not cancel, a link to the
//   velocity before the solve keeps V positive. With gas flow this link is left out: next to viscous liquid, it moves
//   light gas by mu dt/(rho_gas h^2) times its velocity, growing from step to step.
template <int Dim>
bool ViscousTerms<Dim>::weigh_by_sides(int plane, Site e, std::array<double, 2>& weight) const {
  const auto axes = plane_axes<Dim>(plane);
  const IVec<Dim> i = in_.layout.index(e);
  for (int n = 0; n < 2; ++n) {
    const int across = axes[1 - n], side = side_at(in_.layout, across, i[across]);
    if (side < 0) continue;
    switch (in_.sides.type(across, side)) {
      case SideType::free_slip:
      case SideType::waves:
        return false;
      case SideType::outflow:
        weight[n] *= s_.plain || in_.projection.has_gas() ? 0 : 2;
        weight[1 - n] *= 0.5;
        break;
      default:
        weight[n] *= 2;
    }
  }
  return true;
}

// mu h^(Dim-2) V [(s1 - s0)^2/theta + (s3 - s2)^2/theta + 2 (s1 - s0)(s3 - s2)], the differences being h d_b u_a and
// h d_a u_b.
template <int Dim>
bool ViscousTerms<Dim>::of_edge(int plane, Site e, ViscousTerm<Dim>& t) const {
  const auto [a, b] = plane_axes<Dim>(plane);
  const double c = s_.share.edge[plane][std::size_t(e)] * edge_viscosity(plane, e) * scale();
  if (c <= 0) return false;
  t.slots = 0;
  for (int n = 0; n < 2; ++n) {
    const int axis = n == 0 ? a : b, across = n == 0 ? b : a;
    t.add(axis, e - in_.layout.stride(across));
    t.add(axis, e);
  }
  if (!settle(t)) return false;
  std::array<double, 2> weight{1, 1};
  if (!weigh_by_sides(plane, e, weight)) return false;
  std::array<bool, 2> separated{};
  for (int n = 0; n < 2; ++n) {
    const int p = 2 * n, q = 2 - 2 * n;
    separated[n] = kind(t.slot[p]) == SampleKind::unknown && kind(t.slot[p + 1]) == SampleKind::unknown &&
                   kind(t.slot[q]) == SampleKind::solid && kind(t.slot[q + 1]) == SampleKind::solid;
  }
  const bool linked = s_.plain || (weight[0] > 0 && weight[1] > 0);
  if (!separated[0] && !separated[1] && linked) t.add_product(1, 0, 3, 2, c);
  for (int n = 0; n < 2; ++n) {
    if (separated[n])
      link_both_sides(t, 2 * n, 2 * n + 1, c);
    else if (weight[n] > 0)
      t.add_square(2 * n, 2 * n + 1, c * weight[n] * link_weight(t.slot[2 * n], t.slot[2 * n + 1]));
  }
  return true;
}

// mu h^(Dim-2) V [sum_a (s_2a+1 - s_2a)^2/theta - 2 sum_a<b (s_2a+1 - s_2a)(s_2b+1 - s_2b) + kappa (h div u)^2]
template <int Dim>
bool ViscousTerms<Dim>::of_cell(Site cell, ViscousTerm<Dim>& t) const {
  const double c = s_.share.cell[cell] * coefficient(cell);
  if (c <= 0) return false;
  t.slots = 0;
  for (int a = 0; a < Dim; ++a) {
    t.add(a, cell);
    t.add(a, cell + in_.layout.stride(a));
  }
  if (!settle(t)) return false;
  const IVec<Dim> i = in_.layout.index(cell);
  bool inside = true;
  for (int a = 0; a < Dim; ++a)
    inside = inside && (in_.layout.geometry().periodic[a] || (i[a] >= 0 && i[a] < in_.layout.geometry().cells[a]));
  if (!inside && !s_.plain) return false;  // products without squares: known values beyond exert unbounded forces
  for (int a = 0; a < Dim; ++a) {
    if (inside) t.add_square(2 * a, 2 * a + 1, c * link_weight(t.slot[2 * a], t.slot[2 * a + 1]));
    for (int b = a + 1; b < Dim; ++b) t.add_product(2 * a + 1, 2 * a, 2 * b + 1, 2 * b, -c);
  }
  if (!inside || s_.plain) return true;
  const double excess = in_.uniform_viscosity && s_.share.cell[cell] == 1 ? 0 : indefinite_part(t);
  if (excess > 0) add_differences_sum(t, c * excess);
  if (kappa(cell) > excess) add_divergence(t, cell, c * (kappa(cell) - excess));
  return true;
}

// Smallest r >= 0 for which a cell's squares outweigh (1 - r)(sum_a G_a)^2, G_a = s_2a+1 - s_2a: sum_a (1 + 1/theta_a)
// G_a^2 - (1 - r)(sum_a G_a)^2 is positive if (1 - r) sum_a 1/(1 + 1/theta_a) <= 1. Returns 0 in cells that no solid
// cuts, where the divergence term compensates it.
template <int Dim>
double ViscousTerms<Dim>::indefinite_part(const ViscousTerm<Dim>& t) const {
  double sum = 0;
  bool cut = false;
  for (int a = 0; a < Dim; ++a) {
    for (int n = 2 * a; n < 2 * a + 2; ++n) cut = cut || in_.faces.open.at(t.slot[n].axis, t.slot[n].face) < 1;
    sum += 1 / (1 + link_weight(t.slot[2 * a], t.slot[2 * a + 1]));
  }
  return cut ? std::max(0.0, 1 - 1 / sum) : 0;
}

template <int Dim>
void ViscousTerms<Dim>::add_differences_sum(ViscousTerm<Dim>& t, double c) const {
  for (int i = 0; i < 2 * Dim; ++i)
    for (int j = 0; j < 2 * Dim; ++j) t.Q[i][j] += i % 2 == j % 2 ? c : -c;
}

template <int Dim>
double ViscousTerms<Dim>::kappa(Site cell) const {
  const bool full = in_.uniform_viscosity && s_.share.cell[cell] == 1;
  return s_.plain ? 0 : full ? interior_kappa() : 1;
}

// Adds c (h div u)^2. h div u = sum +- (w s + (1 - w) s_solid) in cells where the projection makes it zero, else sum +-
// s.
template <int Dim>
void ViscousTerms<Dim>::add_divergence(ViscousTerm<Dim>& t, Site cell, double c) const {
  std::array<double, ViscousTerm<Dim>::most> d{};
  for (int n = 0; n < 2 * Dim; ++n) {
    const Slot slot = t.slot[n];
    const double sign = n % 2 == 0 ? -1 : 1, w = in_.faces.open.at(slot.axis, slot.face);
    const bool in_solid = kind(slot) == SampleKind::solid;
    if (!in_.rows.has_pressure(cell) || s_.solid.at(slot.axis, slot.face) < 0 || (!in_solid && w == 1)) {
      d[n] += sign;
      continue;
    }
    const bool slit = in_solid && s_.rows.row.at(slot.axis, slot.face) >= 0;
    d[slit ? t.add(slot.axis, slot.face, Reading::row) : n] += sign * w;
    d[in_solid ? n : t.add(slot.axis, slot.face, Reading::solid)] += sign * (1 - w);
  }
  for (int i = 0; i < t.slots; ++i)
    for (int j = 0; j < t.slots; ++j) t.Q[i][j] += c * d[i] * d[j];
}

// A slit is a partly open face whose centre lies in a solid. Its link to the wall has the length of the mean distance
// of its open part, half that of its farthest corner.
template <int Dim>
bool ViscousTerms<Dim>::of_slit(int axis, Site f, ViscousTerm<Dim>& t) const {
  double farthest = 0;
  for (int k = 0; k < 1 << (Dim - 1); ++k) {
    Site node = f;
    for (int b = 1; b < Dim; ++b) node += ((k >> (b - 1)) & 1) * in_.layout.stride((axis + b) % Dim);
    farthest = std::max(farthest, in_.psi[node]);
  }
  // Lower bound 0.05: slits this narrow have almost no flux, and smaller values would only worsen the conditioning.
  const double theta = std::clamp(farthest / (2 * in_.layout.h()), 0.05, 1.0);
  const double c = std::max(coefficient(f), coefficient(f - in_.layout.stride(axis)));
  if (c <= 0) return false;
  t.slots = 0;
  t.add(axis, f, Reading::row);
  t.add(axis, f, Reading::solid);
  t.frame = s_.solid.at(axis, f);
  t.add_square(0, 1, c / theta);
  return true;
}

template <int Dim>
Row ViscousTerms<Dim>::row(const Slot& slot) const {
  const bool reads =
      slot.reading == Reading::row || (slot.reading == Reading::sample && kind(slot) == SampleKind::unknown);
  return reads ? s_.rows.row.at(slot.axis, slot.face) : -1;
}

template <int Dim>
int ViscousTerms<Dim>::solid(const Slot& slot) const {
  const bool reads =
      slot.reading == Reading::solid || (slot.reading == Reading::sample && kind(slot) == SampleKind::solid);
  return reads ? s_.solid.at(slot.axis, slot.face) : -1;
}

template <int Dim>
Vec3 ViscousTerms<Dim>::position(const Slot& slot) const {
  return extend<Dim>(in_.layout.position(in_.layout.index(slot.face), face_offset<Dim>(slot.axis)));
}

// The point of the surface nearest to a face: x - psi grad psi/|grad psi|.
template <int Dim>
Vec3 ViscousTerms<Dim>::surface_point(const Slot& slot) const {
  constexpr int corners = 1 << (Dim - 1);
  Vec<Dim> gradient = Vec<Dim>::Zero();
  for (int k = 0; k < corners; ++k) {
    Site node = slot.face;
    for (int b = 1; b < Dim; ++b) node += ((k >> (b - 1)) & 1) * in_.layout.stride((slot.axis + b) % Dim);
    const Site d = in_.layout.stride(slot.axis);
    gradient[slot.axis] += (in_.psi[node + d] - in_.psi[node - d]) / (2 * corners);
    for (int b = 1; b < Dim; ++b)
      gradient[(slot.axis + b) % Dim] += (((k >> (b - 1)) & 1) ? 2 : -2) * in_.psi[node] / corners;
  }
  const double norm = gradient.norm();
  if (norm == 0) return position(slot);
  return position(slot) - s_.psi.at(slot.axis, slot.face) * extend<Dim>(gradient / norm);
}

// v += sign (v_k + omega_k x (x - c)) . e_axis
template <int Dim>
void ViscousTerms<Dim>::add_motion(int k, const Vec3& x, int axis, double sign, AffineVelocity& v) const {
  const ViscousSolid<Dim>& solid = in_.solids[k];
  v.known += sign * solid.frame.at(x)[axis];
  if (!solid.moves_freely() || !solid.rigid) return;
  const Vec3 r = x - solid.frame.center;
  v.columns.emplace_back(solid.first_unknown + axis, sign);
  for (int c = Dim == 2 ? 2 : 0; c < 3; ++c) {
    const double arm = Vec3::Unit(c).cross(r)[axis];
    if (arm != 0) v.columns.emplace_back(solid.first_unknown + Dim + (Dim == 2 ? 0 : c), sign * arm);
  }
}

template <int Dim>
void ViscousTerms<Dim>::add_surface(int k, const Slot& slot, AffineVelocity& v) const {
  const std::size_t begin = v.columns.size();
  in_.solids[k].surface(slot.axis, slot.face, v.columns);
  for (std::size_t n = begin; n < v.columns.size(); ++n) v.columns[n].first += in_.solids[k].first_unknown;
}

template <int Dim>
AffineVelocity ViscousTerms<Dim>::relative_velocity(const ViscousTerm<Dim>& t, int n) const {
  const Slot& slot = t.slot[n];
  AffineVelocity v;
  v.row = row(slot);
  const int k = solid(slot);
  const bool deforms = k >= 0 && in_.solids[k].surface;
  if (k >= 0 && k == t.frame && !deforms) return v;
  const Vec3 x = deforms ? surface_point(slot) : position(slot);
  if (deforms)
    add_surface(k, slot, v);
  else if (k >= 0)
    add_motion(k, x, slot.axis, 1, v);
  else if (v.row < 0)
    v.known = s_.given.at(slot.axis, slot.face);
  if (t.frame >= 0) add_motion(t.frame, x, slot.axis, -1, v);
  return v;
}

template struct ViscousTerm<2>;
template struct ViscousTerm<3>;
template class ViscousTerms<2>;
template class ViscousTerms<3>;

}  // namespace seiche
