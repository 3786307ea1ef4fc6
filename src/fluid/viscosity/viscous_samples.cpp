#include "fluid/viscosity/viscous_samples.h"

#include "grid/loops.h"

namespace seiche {
namespace {

// Faces whose corners, and the corners of adjacent faces, are stored.
template <int Dim>
Box<Dim> sampled(const Layout<Dim>& layout) {
  Box<Dim> box = layout.grown(2);
  for (int a = 0; a < Dim; ++a) {
    box.lower[a] = std::max(box.lower[a], layout.padded().lower[a] + 1);
    box.upper[a] = std::min(box.upper[a], layout.padded().upper[a] - 2);
  }
  return box;
}

// Node at a corner of a face. Bit b - 1 of the corner's number is set if it is at the high end along axis + b.
template <int Dim>
Site corner_node(const Layout<Dim>& layout, int axis, Site f, int corner) {
  for (int b = 1; b < Dim; ++b) f += ((corner >> (b - 1)) & 1) * layout.stride((axis + b) % Dim);
  return f;
}

// psi at a face's centre minus the mean of its corners: the sum of (-a + 9b + 9c - d)/16 - (b + c)/2 over the face's
// axes. On a ball of radius R it is h^2/(8R) per axis, which would be an error of the radius. It is at most h/8 in
// magnitude if |grad psi| <= 1.
template <int Dim>
double curvature_part(const Layout<Dim>& layout, const NodeField<Dim>& psi, int axis, Site f) {
  constexpr int corners = 1 << (Dim - 1);
  double sum = 0;
  for (int b = 1; b < Dim; ++b) {
    const Site d = layout.stride((axis + b) % Dim);
    double part = 0;
    for (int k = 0; k < corners; ++k) {
      const Site node = corner_node(layout, axis, f, k);
      part += psi[node] - psi[((k >> (b - 1)) & 1) ? node + d : node - d];
    }
    sum += std::clamp(part * 2 / (16 * corners), -layout.h() / 8, layout.h() / 8);
  }
  return sum;
}

// For each axis, the side beyond which a face lies: 0 lower, 1 upper, -1 none.
template <int Dim>
std::array<int, Dim> sides_passed(const Layout<Dim>& layout, int axis, const IVec<Dim>& i) {
  std::array<int, Dim> r;
  for (int b = 0; b < Dim; ++b) {
    const int last = layout.geometry().cells[b] - (b == axis ? 0 : 1);
    r[b] = layout.geometry().periodic[b] ? -1 : i[b] < 0 ? 0 : i[b] > last ? 1 : -1;
  }
  return r;
}

template <int Dim>
class Sampling {
 public:
  Sampling(const ViscousInput<Dim>& in, ViscousSamples<Dim>& out) : in_(in), layout_(in.layout), out_(out) {}

  // Classifies faces that are not beyond a side. Rows decide later about unknowns in the halo.
  void classify(int axis, Site f, const IVec<Dim>& i) {
    std::tie(out_.psi.at(axis, f), out_.solid.at(axis, f)) = nearest_solid(layout_, in_.psi, in_.body, axis, f);
    if (is_beyond(sides_passed(layout_, axis, i))) return;
    const FaceKind kind = in_.faces.kind_at(axis, f);
    if (lies_in_solid(axis, f)) return set(axis, f, SampleKind::solid);
    if (kind == FaceKind::prescribed) return give(axis, f, in_.faces.prescribed.at(axis, f));
    set(axis, f, is_viscous(axis, f, i) || is_projected(axis, f) ? SampleKind::unknown : SampleKind::none);
  }

  // Classifies faces beyond sides. Must run on one thread, since their velocities may be formulas.
  void classify_beyond(int axis, Site f, const IVec<Dim>& i) {
    const auto passed = sides_passed(layout_, axis, i);
    if (is_beyond(passed)) beyond(axis, f, i, passed);
  }

  // True if the face is an unknown of the projection. Its centre may lie in a solid.
  bool is_projected(int axis, Site f) const {
    return in_.faces.is_unknown(axis, f) && in_.faces.open.at(axis, f) > 0 &&
           in_.rows.touch_pressure(f - layout_.stride(axis), f);
  }

 private:
  static bool is_beyond(const std::array<int, Dim>& passed) {
    return std::any_of(passed.begin(), passed.end(), [](int side) { return side >= 0; });
  }
  void set(int axis, Site f, SampleKind kind) { out_.kind.at(axis, f) = char(kind); }
  void give(int axis, Site f, double value) {
    out_.given.at(axis, f) = value;
    set(axis, f, SampleKind::given);
  }

  bool lies_in_solid(int axis, Site f) const {
    const int k = out_.solid.at(axis, f);
    if (k < 0 || !in_.solids[k].no_slip) return false;
    const bool closed = in_.faces.kind_at(axis, f) == FaceKind::closed || in_.faces.open.at(axis, f) == 0;
    return out_.psi.at(axis, f) <= 0 || closed;
  }

  // Walls and inflow give their velocity, outflow the velocity before the solve. Sides without shear give none.
  void beyond(int axis, Site f, const IVec<Dim>& i, const std::array<int, Dim>& passed) {
    bool outflow = false;
    for (int b = 0; b < Dim; ++b) {
      if (passed[b] < 0) continue;
      const SideType type = in_.sides.type(b, passed[b]);
      outflow = outflow || type == SideType::outflow;
      if (b == axis || type == SideType::outflow || in_.sides.slips(b, passed[b])) continue;
      Vec<Dim> x = layout_.position(i, face_offset<Dim>(axis));
      x[b] = layout_.geometry().lower[b] + (passed[b] == 0 ? 0 : layout_.h() * layout_.geometry().cells[b]);
      return give(axis, f, in_.sides.velocity(b, passed[b], axis, x, in_.time));
    }
    if (outflow) give(axis, f, in_.u_star.at(axis, f));
  }

  bool is_cell_inside(const IVec<Dim>& i) const {
    for (int a = 0; a < Dim; ++a)
      if (!layout_.geometry().periodic[a] && (i[a] < 0 || i[a] >= layout_.geometry().cells[a])) return false;
    return true;
  }

  // True if the face touches a cell or an edge's dual cell that contains viscous liquid. Edges on free-slip sides do
  // not count.
  bool is_viscous(int axis, Site f, const IVec<Dim>& i) const {
    const Site d = layout_.stride(axis);
    if (is_cell_inside(i) && out_.share.cell[f] > 0) return true;
    if (is_cell_inside(i - IVec<Dim>::Unit(axis)) && out_.share.cell[f - d] > 0) return true;
    for (int p = 0; p < planes<Dim>; ++p) {
      const auto [a, b] = plane_axes<Dim>(p);
      if (a != axis && b != axis) continue;
      const int other = a == axis ? b : a;
      for (int n = 0; n < 2; ++n) {
        const int side = side_at(layout_, other, i[other] + n);
        const bool slips = side >= 0 && in_.sides.slips(other, side);
        if (!slips && out_.share.edge[p][std::size_t(f + n * layout_.stride(other))] > 0) return true;
      }
    }
    return false;
  }

  const ViscousInput<Dim>& in_;
  const Layout<Dim>& layout_;
  ViscousSamples<Dim>& out_;
};

template <int Dim, class IsRow>
FaceRows<Dim> number(const ViscousInput<Dim>& in, const IsRow& is_row) {
  FaceRows<Dim> r;
  r.row = FaceField<Dim, std::int64_t>(in.layout, -1);
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(in.layout, in.layout.faces(a), [&](Site f, const IVec<Dim>&) {
      if (is_row(a, f)) r.faces.emplace_back(a, f);
    });
  const std::int64_t count = std::int64_t(r.faces.size());
  r.first = in.ranks.exclusive_prefix_sum(count);
  r.global = in.ranks.global_sum(count);
  for (std::int64_t n = 0; n < count; ++n) r.row.at(r.faces[n].first, r.faces[n].second) = r.first + n;
  in.halo.fill_ghosts(r.row);
  return r;
}

// True if all cells and edges that touch an unknown are full, on all ranks. Collective.
template <int Dim>
bool is_full(const ViscousInput<Dim>& in, const ViscousSamples<Dim>& s) {
  bool full = true;
  for (const auto& [axis, f] : s.rows.faces) {
    if (s.kind_at(axis, f) != SampleKind::unknown) continue;
    const Site d = in.layout.stride(axis);
    full = full && s.share.cell[f] == 1 && s.share.cell[f - d] == 1;
    for (int p = 0; p < planes<Dim>; ++p) {
      const auto [a, b] = plane_axes<Dim>(p);
      if (a != axis && b != axis) continue;
      const Site other = in.layout.stride(a == axis ? b : a);
      full = full && s.share.edge[p][std::size_t(f)] == 1 && s.share.edge[p][std::size_t(f + other)] == 1;
    }
  }
  return !in.ranks.any(!full);
}

}  // namespace

template <int Dim>
std::pair<double, std::int16_t> nearest_solid(const Layout<Dim>& layout, const NodeField<Dim>& psi,
                                              const NodeField<Dim, std::int16_t>& body, int axis, Site f) {
  constexpr int corners = 1 << (Dim - 1);
  double sum = 0, deepest = 1e300;
  std::int16_t solid = -1;
  for (int k = 0; k < corners; ++k) {
    const Site node = corner_node(layout, axis, f, k);
    sum += psi[node];
    if (psi[node] < deepest) deepest = psi[node], solid = body[node];
  }
  const double mean = sum / corners;
  if (std::abs(mean) > 3 * layout.h()) return {mean, solid};
  return {mean + curvature_part(layout, psi, axis, f), solid};
}

template <int Dim>
ViscousSamples<Dim> sample_faces(const ViscousInput<Dim>& in) {
  ViscousSamples<Dim> s;
  s.kind = FaceField<Dim, char>(in.layout, char(SampleKind::none));
  s.solid = FaceField<Dim, std::int16_t>(in.layout, -1);
  s.given = s.psi = FaceField<Dim>(in.layout);
  s.share = viscous_shares(in);
  Sampling<Dim> sampling(in, s);
  // The owners decide the rows of faces in the halo.
  const Box<Dim> box = sampled(in.layout);
  for (int a = 0; a < Dim; ++a) {
    for_each_index(in.layout, box, [&](Site f, const IVec<Dim>& i) { sampling.classify(a, f, i); });
    for_each_index_in_order(in.layout, box, [&](Site f, const IVec<Dim>& i) { sampling.classify_beyond(a, f, i); });
  }
  s.rows = number(in, [&](int a, Site f) {
    return s.kind_at(a, f) == SampleKind::unknown ||
           (s.kind_at(a, f) == SampleKind::solid && sampling.is_projected(a, f));
  });
  for (int a = 0; a < Dim; ++a)
    for_each_site(in.layout, sampled(in.layout), [&](Site f) {
      const bool has_row = s.rows.row.at(a, f) >= 0;
      const SampleKind kind = s.kind_at(a, f);
      if (kind == SampleKind::none && has_row) s.kind.at(a, f) = char(SampleKind::unknown);
      if (kind == SampleKind::unknown && !has_row) s.kind.at(a, f) = char(SampleKind::none);
    });
  s.plain = in.uniform_viscosity && is_full(in, s);
  return s;
}

template <int Dim>
FaceRows<Dim> number_faces(const ViscousInput<Dim>& in) {
  return sample_faces(in).rows;
}

template ViscousSamples<2> sample_faces<2>(const ViscousInput<2>&);
template ViscousSamples<3> sample_faces<3>(const ViscousInput<3>&);
template FaceRows<2> number_faces<2>(const ViscousInput<2>&);
template FaceRows<3> number_faces<3>(const ViscousInput<3>&);
template std::pair<double, std::int16_t> nearest_solid<2>(const Layout<2>&, const NodeField<2>&,
                                                          const NodeField<2, std::int16_t>&, int, Site);
template std::pair<double, std::int16_t> nearest_solid<3>(const Layout<3>&, const NodeField<3>&,
                                                          const NodeField<3, std::int16_t>&, int, Site);

}  // namespace seiche
