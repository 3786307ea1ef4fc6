#include "solid/elastic/excess.h"

#include <Eigen/Dense>
#include <algorithm>

#include "linalg/core/dense_factors.h"
#include "solid/elastic/step.h"

namespace seiche {
namespace {

// Other forces on the body may reach this share of the largest elastic force or load on a free node. It is above the
// tolerance of the solver and far below any relevant contact force.
constexpr double still_alone = 1e-4;

template <int Dim>
bool is_alone(const IncrementalPotential<Dim>& step, const Pins& pins, const ElasticEnds& ends) {
  for (const int dof : pins.dofs)
    if (ends.u[dof] != ends.u0[dof]) return false;
  const auto largest = [&](Eigen::VectorXd force) {  // on free nodes
    for (const int dof : pins.dofs) force[dof] = 0;
    return force.cwiseAbs().maxCoeff();
  };
  const double scale = std::max(largest(elastic_gradient(*step.body, ends.u)), largest(step.force));
  return largest(potential_gradient(step, ends.u)) <= still_alone * scale;
}

// Columns: translations along axes without pins.
template <int Dim>
Eigen::MatrixXd translations(const Pins& pins, Eigen::Index nodes) {
  std::vector<int> axes;
  for (int axis = 0; axis < Dim; ++axis)
    if (std::none_of(pins.dofs.begin(), pins.dofs.end(), [&](int dof) { return dof % Dim == axis; }))
      axes.push_back(axis);
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(Dim * nodes, Eigen::Index(axes.size()));
  for (std::size_t n = 0; n < axes.size(); ++n)
    for (Eigen::Index i = 0; i < nodes; ++i) B(Dim * i + axes[n], Eigen::Index(n)) = 1;
  return B;
}

// Columns: rotations of the deformed body about a fixed point.
template <int Dim>
Eigen::MatrixXd turns(const ElasticBody<Dim>& body, const Eigen::VectorXd& u) {
  const Eigen::Index nodes = u.size() / Dim;
  Eigen::MatrixXd B(u.size(), Dim == 2 ? 1 : 3);
  for (Eigen::Index n = 0; n < nodes; ++n) {
    const Vec<Dim> x = body.mesh.nodes[std::size_t(n)] + u.template segment<Dim>(Dim * n) - body.mesh.nodes[0];
    for (Eigen::Index turn = 0; turn < B.cols(); ++turn)
      B.template block<Dim, 1>(Dim * n, turn) =
          truncate<Dim>(Vec3(Vec3::Unit(Dim == 2 ? 2 : turn).cross(extend<Dim>(x))));
  }
  return B;
}

// v - B (B'MB)^-1 B'Mv: removes the momentum along the columns of B.
Eigen::VectorXd without(const Eigen::MatrixXd& B, const SparseMatrix& mass, const Eigen::VectorXd& v) {
  if (B.cols() == 0) return v;
  const Eigen::MatrixXd MB = mass * B;
  return v - B * DenseLdlt(B.transpose() * MB).solve(MB.transpose() * v);
}

// The rigid motions that are excluded from d.
template <int Dim>
Eigen::MatrixXd kept_motions(const ElasticBody<Dim>& body, const Pins& pins, const Eigen::MatrixXd& translations,
                             const Eigen::VectorXd& u) {
  if (!pins.dofs.empty()) return translations;
  const Eigen::MatrixXd R = turns(body, u);
  Eigen::MatrixXd B(u.size(), translations.cols() + R.cols());
  B << translations, R;
  return B;
}

}  // namespace

template <int Dim>
void remove_excess_energy(const IncrementalPotential<Dim>& step, const Pins& pins, const ElasticEnds& ends,
                          Eigen::VectorXd& v) {
  if (!step.constant || !is_alone(step, pins, ends)) return;
  const ElasticBody<Dim>& body = *step.body;
  const Eigen::MatrixXd B = translations<Dim>(pins, v.size() / Dim);
  const auto relative = [&](const Eigen::VectorXd& a) { return without(B, body.mass, a); };
  const auto kinetic = [&](const Eigen::VectorXd& a) { return kinetic_energy(body, a); };
  const double excess = kinetic(relative(v)) - kinetic(relative(ends.v0)) + elastic_energy(body, ends.u) -
                        elastic_energy(body, ends.u0) - step.force.dot(relative(ends.u - ends.u0));
  if (!(excess > 0)) return;
  const Eigen::VectorXd d = without(kept_motions(body, pins, B, ends.u), body.mass, v);
  const double available = kinetic(d);
  v -= (1 - (available > excess ? std::sqrt(1 - excess / available) : 0)) * d;
}

#define SEICHE_INSTANTIATE(D)                                                                            \
  template void remove_excess_energy<D>(const IncrementalPotential<D>&, const Pins&, const ElasticEnds&, \
                                        Eigen::VectorXd&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
