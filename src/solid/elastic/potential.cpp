#include "solid/elastic/potential.h"

#include <algorithm>
#include <cassert>

#include "solid/elastic/mean_rotation.h"

namespace seiche {
namespace {

// Eigen's middleCols() allocates up to twice as much.
SparseMatrix columns_of(const SparseMatrix& M, IndexRange columns) {
  if (columns.size() == M.cols()) return M;
  SparseMatrix part(M.rows(), columns.size());
  part.reserve(M.outerIndexPtr()[columns.end] - M.outerIndexPtr()[columns.begin]);
  for (int k = columns.begin; k < columns.end; ++k) {
    part.startVec(k - columns.begin);
    for (SparseMatrix::InnerIterator it(M, k); it; ++it) part.insertBack(it.row(), k - columns.begin) = it.value();
  }
  part.finalize();
  return part;
}

}  // namespace

VelocityPotential::~VelocityPotential() = default;

template <int Dim>
ElasticPotential<Dim>::ElasticPotential(std::vector<ElasticShare<Dim>> bodies, int size, double dt, double horizon,
                                        std::shared_ptr<const WorkShare> work)
    : bodies_(std::move(bodies)), size_(size), dt_(dt), horizon_(horizon), work_(std::move(work)) {}

// Sums over the processes of fewer elements take longer than the elements.
template <int Dim>
bool ElasticPotential<Dim>::is_shared(const ElasticBody<Dim>& body) const {
  constexpr int worth_sharing = 500;
  return work_ && work_->processes() > 1 && body.mesh.element_count() >= worth_sharing;
}

template <int Dim>
IndexRange ElasticPotential<Dim>::own_elements(const ElasticBody<Dim>& body) const {
  return is_shared(body) ? work_->of(body.mesh.element_count()) : body.all_elements();
}

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
  for (const auto& share : bodies_) {
    double own = elastic_energy(*share.body, displacement(share, v), share.held, own_elements(*share.body));
    if (is_shared(*share.body)) work_->add_up({&own, 1});
    sum += own;
  }
  return dt_ / horizon_ * sum;
}

template <int Dim>
void ElasticPotential<Dim>::add_gradient(const Eigen::VectorXd& v, Eigen::VectorXd& gradient) const {
  assert(v.size() == size_ && gradient.size() == size_);
  for (const auto& share : bodies_) {
    Eigen::VectorXd own = elastic_gradient(*share.body, displacement(share, v), share.held, own_elements(*share.body));
    if (is_shared(*share.body)) work_->add_up({own.data(), std::size_t(own.size())});
    gradient.segment(share.first_dof, share.body->size()) += dt_ * own;
  }
}

// The given columns of a body's stiffness, N/m. whole: all processes ask for the whole Hessian and share the elements.
// Else each takes the elements that touch its columns.
template <int Dim>
SparseMatrix ElasticPotential<Dim>::stiffness(const ElasticShare<Dim>& share, const Eigen::VectorXd& v,
                                              HessianProjection curvature, IndexRange columns, bool whole) const {
  const ElasticBody<Dim>& body = *share.body;
  const bool sums = whole && is_shared(body);
  SparseMatrix K = columns_of(body.pattern, columns);
  add_stiffness(body, displacement(share, v), curvature, share.held, sums ? own_elements(body) : body.all_elements(),
                columns, K);
  if (sums) work_->add_up({K.valuePtr(), std::size_t(K.nonZeros())});
  return K;
}

// The stiffness of each body, times dt H, in the columns of its unknowns.
template <int Dim>
Eigen::SparseMatrix<double> ElasticPotential<Dim>::hessian(const Eigen::VectorXd& v, HessianProjection curvature,
                                                           IndexRange columns) const {
  Eigen::SparseMatrix<double> all(size_, size_);
  int column = 0;
  for (const auto& share : bodies_) {
    assert(share.first_dof >= column);
    const int first = share.first_dof, end = first + share.body->size();
    const IndexRange own{std::clamp(columns.begin, first, end), std::clamp(columns.end, first, end)};
    const SparseMatrix K =
        stiffness(share, v, curvature, {own.begin - first, own.end - first}, columns.size() == size_);
    all.reserve(K.nonZeros());  // more than now
    while (column < own.begin) all.startVec(column++);
    for (int c = 0; c < K.outerSize(); ++c, ++column) {
      all.startVec(column);
      for (SparseMatrix::InnerIterator entry(K, c); entry; ++entry)
        all.insertBack(first + entry.row(), column) = dt_ * horizon_ * entry.value();
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
    const double own = inversion_bound(*share.body, displacement(share, v), d, own_elements(*share.body));
    bound = std::min(bound, is_shared(*share.body) ? work_->least(own) : own);
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
