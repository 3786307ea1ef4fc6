#include "solid/elastic/potential.h"

#include <cassert>

#include "solid/elastic/mean_rotation.h"

namespace seiche {

VelocityPotential::~VelocityPotential() = default;

template <int Dim>
ElasticPotential<Dim>::ElasticPotential(std::vector<ElasticShare<Dim>> bodies, int size, double dt, double horizon)
    : bodies_(std::move(bodies)), size_(size), dt_(dt), horizon_(horizon) {}

// u = u_n + H w
template <int Dim>
Eigen::VectorXd ElasticPotential<Dim>::displacement(const ElasticShare<Dim>& share, const Eigen::VectorXd& v) const {
  return *share.displacement + horizon_ * v.segment(share.first_dof, share.body->size());
}

// Places of the nodes, m.
template <int Dim>
Eigen::VectorXd ElasticPotential<Dim>::points(const ElasticShare<Dim>& share, const Eigen::VectorXd& v) const {
  Eigen::VectorXd x = displacement(share, v);
  for (Eigen::Index n = 0; n < x.size() / Dim; ++n)
    x.template segment<Dim>(Dim * n) += share.body->mesh.nodes[std::size_t(n)];
  return x;
}

template <int Dim>
double ElasticPotential<Dim>::energy(const Eigen::VectorXd& v) const {
  assert(v.size() == size_);
  double sum = 0;
  for (const auto& share : bodies_) sum += elastic_energy(*share.body, displacement(share, v), share.held);
  return dt_ / horizon_ * sum;
}

template <int Dim>
void ElasticPotential<Dim>::add_gradient(const Eigen::VectorXd& v, Eigen::VectorXd& gradient) const {
  assert(v.size() == size_ && gradient.size() == size_);
  for (const auto& share : bodies_)
    gradient.segment(share.first_dof, share.body->size()) +=
        dt_ * elastic_gradient(*share.body, displacement(share, v), share.held);
}

// The stiffness of each body, times dt H, in the columns of its unknowns.
template <int Dim>
Eigen::SparseMatrix<double> ElasticPotential<Dim>::hessian(const Eigen::VectorXd& v,
                                                           HessianProjection curvature) const {
  Eigen::SparseMatrix<double> all(size_, size_);
  Eigen::Index entries = 0;
  for (const auto& share : bodies_) entries += share.body->pattern.nonZeros();
  all.reserve(entries);
  int column = 0;
  for (const auto& share : bodies_) {
    assert(share.first_dof >= column);
    SparseMatrix K = share.body->pattern;
    add_stiffness(*share.body, displacement(share, v), curvature, K, share.held);
    while (column < share.first_dof) all.startVec(column++);
    for (int c = 0; c < K.outerSize(); ++c, ++column) {
      all.startVec(column);
      for (SparseMatrix::InnerIterator entry(K, c); entry; ++entry)
        all.insertBack(share.first_dof + entry.row(), column) = dt_ * horizon_ * entry.value();
    }
  }
  all.finalize();
  return all;
}

template <int Dim>
double ElasticPotential<Dim>::step_bound(const Eigen::VectorXd& v, const Eigen::VectorXd& dv) const {
  double bound = 1;
  for (const auto& share : bodies_) {
    const Eigen::VectorXd d = horizon_ * dv.segment(share.first_dof, share.body->size());
    bound = std::min(bound, inversion_bound(*share.body, displacement(share, v), d));
  }
  return bound;
}

template <int Dim>
double ElasticPotential<Dim>::angle(const Eigen::VectorXd& v, const Eigen::VectorXd& dv) const {
  double largest = 0;
  for (const auto& share : bodies_) {
    if (!share.may_turn) continue;
    const MeanRotation<Dim> mean(points(share, v), horizon_ * dv.segment(share.first_dof, share.body->size()));
    largest = std::max(largest, mean.angle());
  }
  return largest;
}

template <int Dim>
void ElasticPotential<Dim>::turn(const Eigen::VectorXd& v, Eigen::VectorXd& dv) const {
  for (const auto& share : bodies_) {
    if (!share.may_turn) continue;
    auto own = dv.segment(share.first_dof, share.body->size());
    const Eigen::VectorXd x = points(share, v), d = horizon_ * own;
    own = MeanRotation<Dim>(x, d).along_arc(x, d) / horizon_;
  }
}

// Psi is a difference of terms of the order (lambda + 2 mu) times the volume.
template <int Dim>
double ElasticPotential<Dim>::round_off() const {
  constexpr double share_of_terms = 1e-15;  // a few units in the last place
  double sum = 0;
  for (const auto& share : bodies_) {
    const Lame& lame = share.body->properties.lame;
    double volume = 0;
    for (const double w : share.body->weights) volume += w;
    sum += (lame.lambda + 2 * lame.mu) * volume;
  }
  return share_of_terms * dt_ / horizon_ * sum;
}

template class ElasticPotential<2>;
template class ElasticPotential<3>;

}  // namespace seiche
