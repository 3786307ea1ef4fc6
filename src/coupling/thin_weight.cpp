#include "coupling/thin_weight.h"

#include <Eigen/Geometry>

#include "levelset/fractions.h"

namespace seiche {
namespace {
const double FLOOR = std::getenv("FLOOR") ? std::atof(std::getenv("FLOOR")) : 0.25;
const double DRAG = std::getenv("DRAG") ? std::atof(std::getenv("DRAG")) : 1;
const int SHUT = std::getenv("SHUT") ? std::atoi(std::getenv("SHUT")) : 1;
const int MODE = std::getenv("MODE") ? std::atoi(std::getenv("MODE")) : 1;

template <int Dim>
bool is_shut_in(const Setup<Dim>& s, const StepGeometry<Dim>& g, const CellField<Dim>& phi, Site cell) {
  bool shut = phi[cell] < 0;
  for_each_face_of(s.layout, cell, [&](int a, Site f, int, Site) { shut = shut && !g.faces.is_unknown(a, f); });
  return shut;
}

// Summed gaps of the cells beside a sealed face that are this rank's and have a row, each at least `least`, m.
template <int Dim>
double wet_gaps(const Setup<Dim>& s, const StepGeometry<Dim>& g, const PressureRows<Dim>& rows, const CellField<Dim>& phi, const SealedFace& f, double least) {
  const Layout<Dim>& l = s.layout;
  const std::array<Site, 2> cells = {f.face - l.stride(f.axis), f.face};
  double sum = 0;
  for (std::size_t side = 0; side < 2; ++side) {
    const Site c = cells[side];
    if (!l.cells().contains(l.index(c))) continue;
    if (rows.row[c] >= 0)
      sum += std::max(f.gaps[side], least);
    else if (SHUT && is_shut_in(s, g, phi, c))
      sum += 0.5 * l.h();
  }
  return sum;
}

}  // namespace

template <int Dim>
LiquidBeside liquid_beside(const Setup<Dim>& s, const StepGeometry<Dim>& g, const PressureRows<Dim>& rows,
                           const CellField<Dim>& phi, const FaceField<Dim>& u, const Eigen::VectorXd& w, double dt, int k) {
  const FaceShares& shares = *g.shares[std::size_t(k)];
  const auto size = std::size_t(s.bodies[std::size_t(k)].elastic().body.size());
  std::vector<double> sums(3 * size);  // mass that weighs, mass, momentum
  std::size_t n = 0;  // shares and sealed faces are in the same order
  for (const SealedFace& f : g.sealed) {
    if (f.body != k) continue;
    while (shares[n].axis != f.axis || shares[n].face != f.face) ++n;
    const double area = shares[n].closed * s.layout.geometry().face_area();
    const double heavy = area * s.density() * wet_gaps(s, g, rows, phi, f, 0);
    const double mass = area * s.density() * wet_gaps(s, g, rows, phi, f, FLOOR * s.layout.h());
    const SurfaceWeights& hung = (*g.attached[std::size_t(k)])[n];
    const double mean = velocity_at<Dim>(hung, f.axis, w), flow = u.at(f.axis, f.face);
    for (const auto& [node, weight] : hung) {
      const auto i = std::size_t(Dim * node + f.axis);
      const double apart = w[Eigen::Index(i)] - mean;
      const double kept = MODE == 0 ? w[Eigen::Index(i)] : MODE == 1 ? flow : flow + apart * std::max(0., 1 - DRAG * dt * std::abs(apart) / s.layout.h());
      sums[i] += heavy * weight;
      sums[size + i] += mass * weight;
      sums[2 * size + i] += mass * weight * kept;
    }
  }
  s.ranks.global_sum(sums);
  const auto part = [&](std::size_t n) {
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(sums.data() + n * size, Eigen::Index(size)));
  };
  return {part(0), part(1), part(2)};
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
  template LiquidBeside liquid_beside<D>(const Setup<D>&, const StepGeometry<D>&, const PressureRows<D>&, const CellField<D>&, const FaceField<D>&, const Eigen::VectorXd&, double, int); \
  template bool has_thin_elastic<D>(const Setup<D>&);                                                            \
  template double volume_beyond<D>(const Setup<D>&, const StepGeometry<D>&, const CellField<D>&);                \
  template Eigen::VectorXd total_load<D>(const ElasticSolid<D>&, const Eigen::VectorXd&, const Eigen::VectorXd&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
