#include "coupling/thin_weight.h"

#include <Eigen/Geometry>

#include "levelset/fractions.h"

namespace seiche {
namespace {

// Summed gaps of the cells beside a sealed face that are this rank's and have a row, m.
template <int Dim>
double wet_gaps(const Layout<Dim>& l, const PressureRows<Dim>& rows, const SealedFace& f) {
  const Site low = f.face - l.stride(f.axis);
  double sum = 0;
  if (l.cells().contains(l.index(low)) && rows.row[low] >= 0) sum += f.gaps[0];
  if (l.cells().contains(l.index(f.face)) && rows.row[f.face] >= 0) sum += f.gaps[1];
  return sum;
}

}  // namespace

template <int Dim>
Eigen::VectorXd mass_beside(const Setup<Dim>& s, const StepGeometry<Dim>& g, const PressureRows<Dim>& rows, int k) {
  const FaceShares& shares = *g.shares[std::size_t(k)];
  std::vector<double> mass(std::size_t(s.bodies[std::size_t(k)].elastic().body.size()));
  std::size_t n = 0;  // shares and sealed faces are in the same order
  for (const SealedFace& f : g.sealed) {
    if (f.body != k) continue;
    while (shares[n].axis != f.axis || shares[n].face != f.face) ++n;
    const double area = shares[n].closed * s.layout.geometry().face_area();
    const double of_face = area * s.density() * wet_gaps(s.layout, rows, f);
    for (const auto& [node, weight] : (*g.attached[std::size_t(k)])[n])
      mass[std::size_t(Dim * node + f.axis)] += of_face * weight;
  }
  s.ranks.global_sum(mass);
  return Eigen::Map<const Eigen::VectorXd>(mass.data(), Eigen::Index(mass.size()));
}

template <int Dim>
bool has_thin_elastic(const Setup<Dim>& s) {
  return std::any_of(s.bodies.begin(), s.bodies.end(),
                     [](const Body<Dim>& b) { return b.is_thin() && b.is_elastic(); });
}

template <int Dim>
double volume_beyond(const Setup<Dim>& s, const StepGeometry<Dim>& g, const CellField<Dim>& phi) {
  if (!has_thin_elastic(s)) return 0;
  const Layout<Dim>& l = s.layout;
  double sum = 0;
  for (const SealedFace& f : g.sealed) {
    const std::array<Site, 2> cells = {f.face - l.stride(f.axis), f.face};
    for (std::size_t side = 0; side < 2 && s.bodies[std::size_t(f.body)].is_elastic(); ++side) {
      const Site c = cells[side];
      if (!l.cells().contains(l.index(c)) || phi[c] >= 0) continue;
      const bool within = f.gaps[side] == 0;
      const double counted = 0.5 * l.h() * (within ? liquid_share(l, phi, g.psi, c) : 1);
      sum += f.weight * (counted - f.gaps[side]) * l.geometry().face_area();
    }
  }
  return s.ranks.global_sum(sum);
}

template <int Dim>
Eigen::VectorXd total_load(const ElasticSolid<Dim>& solid, const Eigen::VectorXd& u, const Eigen::VectorXd& forces) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(6);
  for (std::size_t n = 0; n < solid.body.mesh.nodes.size(); ++n) {
    const Eigen::Index i = Dim * Eigen::Index(n);
    const Vec3 x = extend<Dim>(Vec<Dim>(solid.body.mesh.nodes[n] + u.segment<Dim>(i)));
    const Vec3 f = extend<Dim>(Vec<Dim>(forces.segment<Dim>(i)));
    load.head<3>() += f;
    load.tail<3>() += x.cross(f);
  }
  return load;
}

#define SEICHE_INSTANTIATE(D)                                                                                    \
  template Eigen::VectorXd mass_beside<D>(const Setup<D>&, const StepGeometry<D>&, const PressureRows<D>&, int); \
  template bool has_thin_elastic<D>(const Setup<D>&);                                                            \
  template double volume_beyond<D>(const Setup<D>&, const StepGeometry<D>&, const CellField<D>&);                \
  template Eigen::VectorXd total_load<D>(const ElasticSolid<D>&, const Eigen::VectorXd&, const Eigen::VectorXd&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
