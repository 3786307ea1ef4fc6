#pragma once
// The terms of the dissipation rate z'Vz: one per cell, one per edge, one per slit (a partly open face whose centre
// lies in a solid).
#include "fluid/viscosity/viscous_samples.h"
#include "grid/loops.h"

namespace seiche {

// Source of the velocity at a face. sample: its sample; solid: the velocity of the nearest solid there; row: the face's
// unknown, even if its centre lies in a solid.
enum class Reading : char { sample, solid, row };

struct Slot {
  int axis;
  Site face;
  Reading reading;
};

// sum_ij Q_ij s_i s_j over velocities s relative to the motion of solid `frame` (-1: at rest).
template <int Dim>
struct ViscousTerm {
  static constexpr int most = 4 * Dim;
  int slots = 0;
  std::array<Slot, most> slot;
  std::array<std::array<double, most>, most> Q;
  int frame = -1;

  int add(int axis, Site face, Reading reading = Reading::sample);
  // Q += c (s_i - s_j)^2 and Q += 2 c (s_i - s_j)(s_k - s_l).
  void add_square(int i, int j, double c);
  void add_product(int i, int j, int k, int l, double c);
};

// A velocity as the sum of an unknown face velocity (`row`, -1: none), weighted body unknowns and a known part.
struct AffineVelocity {
  Row row = -1;
  double known = 0;
  std::vector<std::pair<int, double>> columns;
};

template <int Dim>
class ViscousTerms {
 public:
  ViscousTerms(const ViscousInput<Dim>& in, const ViscousSamples<Dim>& samples) : in_(in), s_(samples) {}

  // Set t to the term of a cell, edge or slit. Return false if it does not exist or contains no unknown.
  bool of_cell(Site cell, ViscousTerm<Dim>& t) const;
  bool of_edge(int plane, Site edge, ViscousTerm<Dim>& t) const;
  bool of_slit(int axis, Site face, ViscousTerm<Dim>& t) const;
  // Calls visit(term) for the terms that contain a face's row.
  template <class Visit>
  void for_each_of_row(int axis, Site face, const Visit& visit) const;
  // Calls visit(term) for this rank's terms. Each term belongs to one rank.
  template <class Visit>
  void for_each_owned(const Visit& visit) const;

  // Velocity s of a term's slot relative to the term's frame.
  AffineVelocity relative_velocity(const ViscousTerm<Dim>& t, int slot) const;
  // Row of a slot, or -1.
  Row row(const Slot& slot) const;
  // The solid whose velocity a slot reads, or -1.
  int solid(const Slot& slot) const;
  Vec3 position(const Slot& slot) const;
  double coefficient(Site cell) const { return in_.viscosity[cell] * scale(); }
  // Factor kappa of (div u)^2 in full cells of uniform viscosity. It keeps V positive semi-definite without the
  // divergence constraint: 2 D:D - (div u)^2 is negative for expansion in 3D, which a free surface permits.
  double interior_kappa() const { return s_.plain || Dim == 2 ? 0 : 1.0 / 3; }

 private:
  double scale() const { return std::pow(in_.layout.h(), Dim - 2); }
  SampleKind kind(const Slot& slot) const { return s_.kind_at(slot.axis, slot.face); }
  double edge_viscosity(int plane, Site edge) const;
  double wall_distance(const Slot& liquid, const Slot& solid) const;
  bool settle(ViscousTerm<Dim>& t) const;
  double link_weight(const Slot& low, const Slot& high) const;
  bool weigh_by_sides(int plane, Site edge, std::array<double, 2>& weight) const;
  void link_both_sides(ViscousTerm<Dim>& t, int low, int high, double c) const;
  void add_divergence(ViscousTerm<Dim>& t, Site cell, double c) const;
  double kappa(Site cell) const;
  double indefinite_part(const ViscousTerm<Dim>& t) const;
  void add_differences_sum(ViscousTerm<Dim>& t, double c) const;
  void add_motion(int solid, const Vec3& x, int axis, double sign, AffineVelocity& v) const;
  void add_surface(int solid, const Slot& slot, AffineVelocity& v) const;
  Vec3 surface_point(const Slot& slot) const;

  const ViscousInput<Dim>& in_;
  const ViscousSamples<Dim>& s_;
};

template <int Dim>
template <class Visit>
void ViscousTerms<Dim>::for_each_of_row(int axis, Site face, const Visit& visit) const {
  ViscousTerm<Dim> t;
  if (s_.kind_at(axis, face) == SampleKind::solid) {
    if (of_slit(axis, face, t)) visit(t);
  }
  for (Site cell : {face - in_.layout.stride(axis), face})
    if (of_cell(cell, t)) visit(t);
  for (int p = 0; p < planes<Dim>; ++p) {
    const auto [a, b] = plane_axes<Dim>(p);
    if (a != axis && b != axis) continue;
    for (Site edge : {face, face + in_.layout.stride(a == axis ? b : a)})
      if (of_edge(p, edge, t)) visit(t);
  }
}

template <int Dim>
template <class Visit>
void ViscousTerms<Dim>::for_each_owned(const Visit& visit) const {
  const Layout<Dim>& layout = in_.layout;
  ViscousTerm<Dim> t;
  Box<Dim> cells = layout.cells();
  for_each_index_in_order(layout, cells, [&](Site c, const IVec<Dim>&) {
    if (of_cell(c, t)) visit(t);
  });
  for (int p = 0; p < planes<Dim>; ++p) {
    const auto [a, b] = plane_axes<Dim>(p);
    Box<Dim> edges = layout.cells();
    if (layout.at_upper(a)) ++edges.upper[a];
    if (layout.at_upper(b)) ++edges.upper[b];
    for_each_index_in_order(layout, edges, [&](Site e, const IVec<Dim>&) {
      if (of_edge(p, e, t)) visit(t);
    });
  }
  for (const auto& [axis, f] : s_.rows.faces)
    if (s_.kind_at(axis, f) == SampleKind::solid && of_slit(axis, f, t)) visit(t);
}

}  // namespace seiche
