#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solid/elastic_body.h"
#include "solid/elastic_invariants.h"

namespace seiche {
namespace {

constexpr double kept_volume = 0.1;  // share of det F that one step must leave

// sum_a u_a g_a'
template <int Dim>
Gradient<Dim> gradient_of(const ElasticBody<Dim>& body, int e, const ShapeGradients<Dim>& g, const Eigen::VectorXd& u) {
  Gradient<Dim> D = Gradient<Dim>::Zero();
  const int* n = body.mesh.element(e);
  for (int a = 0; a < g.rows(); ++a) D.noalias() += u.segment<Dim>(Dim * n[a]) * g.row(a);
  return D;
}

// F = 1 + sum_a u_a g_a'
template <int Dim>
Gradient<Dim> deformation(const ElasticBody<Dim>& body, int point, const Eigen::VectorXd& u) {
  return Gradient<Dim>::Identity() + gradient_of(body, point / body.points_per_element, body.gradients[point], u);
}

// B, dF = B du: column Dim a + i holds g_a in the entries of row i of F.
template <int Dim>
using Strain =
    Eigen::Matrix<double, Dim * Dim, Eigen::Dynamic, Eigen::ColMajor, Dim * Dim, Dim*(Dim + 1) * (Dim + 2) / 2>;

template <int Dim>
Strain<Dim> strain_of(const ShapeGradients<Dim>& g) {
  Strain<Dim> B = Strain<Dim>::Zero(Dim * Dim, Dim * g.rows());
  for (int a = 0; a < g.rows(); ++a) {
    for (int i = 0; i < Dim; ++i) {
      for (int j = 0; j < Dim; ++j) B(i + Dim * j, Dim * a + i) = g(a, j);
    }
  }
  return B;
}

// Adds the element's matrix to the columns of its nodes.
template <int Dim, class Matrix>
void scatter(const ElasticBody<Dim>& body, int e, const Matrix& Ke, SparseMatrix& K) {
  const int count = body.mesh.nodes_per_element();
  const int *n = body.mesh.element(e), *slot = body.slots.data() + size_t(e) * count * count;
  for (int b = 0; b < count; ++b) {
    for (int k = 0; k < Dim; ++k) {
      double* column = K.valuePtr() + K.outerIndexPtr()[Dim * n[b] + k];
      for (int a = 0; a < count; ++a) {
        for (int i = 0; i < Dim; ++i) column[slot[a * count + b] + i] += Ke(Dim * a + i, Dim * b + k);
      }
    }
  }
}

// J(F + t D) = c_0 + c_1 t + c_2 t^2 + c_3 t^3
template <int Dim>
std::array<double, 4> volume_polynomial(const Gradient<Dim>& F, const Gradient<Dim>& D) {
  const double first = elastic::cofactor<Dim>(F).cwiseProduct(D).sum();
  if constexpr (Dim == 2) return {F.determinant(), first, D.determinant(), 0};
  return {F.determinant(), first, elastic::cofactor<Dim>(D).cwiseProduct(F).sum(), D.determinant()};
}

// A bound from below on the first t at which the polynomial has fallen to kept_volume c_0, at most `limit`: a step of
// what is left over the steepest slope within `window` cannot pass the root. The window follows the steps.
double step_until_kept(const std::array<double, 4>& c, double limit) {
  double t = 0, window = limit;
  for (int i = 0; i < 100; ++i) {  // more steps only come closer
    const double left = (1 - kept_volume) * c[0] + t * (c[1] + t * (c[2] + t * c[3]));
    if (left < 1e-3 * c[0]) break;  // close enough: a step bound need not be sharp
    const double end = std::min(limit, t + window);
    const double slope = std::abs(c[1]) + 2 * std::abs(c[2]) * end + 3 * std::abs(c[3]) * end * end;
    const bool passes = left >= slope * (end - t);
    if (passes && end == limit) return limit;
    const double step = passes ? end - t : left / slope;
    window = passes ? 2 * window : 2 * step;
    t += step;
  }
  return t;
}

// Visits f(element, shape gradients) at all points where det F is watched.
template <int Dim, class Visit>
void over_watched(const ElasticBody<Dim>& body, Visit visit) {
  for (size_t q = 0; q < body.gradients.size(); ++q) visit(int(q) / body.points_per_element, body.gradients[q]);
  for (size_t a = 0; a < body.node_gradients.size(); ++a) {
    visit(int(a) / body.mesh.nodes_per_element(), body.node_gradients[a]);
  }
}

}  // namespace

template <int Dim>
double elastic_energy(const ElasticBody<Dim>& body, const Eigen::VectorXd& u) {
  double Psi = 0;
  for (size_t q = 0; q < body.weights.size(); ++q) {
    Psi += body.weights[q] * body.material.energy(body.properties.lame, deformation(body, int(q), u));
  }
  return Psi;
}

// dPsi/du_a = integral of P g_a
template <int Dim>
Eigen::VectorXd elastic_gradient(const ElasticBody<Dim>& body, const Eigen::VectorXd& u) {
  Eigen::VectorXd r = Eigen::VectorXd::Zero(body.size());
  for (size_t q = 0; q < body.weights.size(); ++q) {
    const Gradient<Dim> P = body.weights[q] * body.material.stress(body.properties.lame, deformation(body, int(q), u));
    const int* n = body.mesh.element(int(q) / body.points_per_element);
    const auto& g = body.gradients[q];
    for (int a = 0; a < g.rows(); ++a) r.segment<Dim>(Dim * n[a]).noalias() += P * g.row(a).transpose();
  }
  return r;
}

// K = integral of B' d2Psi/dF2 B
template <int Dim>
void add_stiffness(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, Curvature curvature, SparseMatrix& K) {
  constexpr int most = Dim * (Dim + 1) * (Dim + 2) / 2;
  const int size = Dim * body.mesh.nodes_per_element();
  for (int e = 0; e < body.mesh.element_count(); ++e) {
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most, most> Ke(size, size);
    Ke.setZero();
    for (int q = e * body.points_per_element; q < (e + 1) * body.points_per_element; ++q) {
      Hessian<Dim> H = body.material.stiffness(body.properties.lame, deformation(body, q, u));
      if (curvature == Curvature::projected) H = project_positive<Dim>(H);
      const Strain<Dim> B = strain_of<Dim>(body.gradients[q]);
      const Strain<Dim> HB = body.weights[q] * H * B;
      Ke.noalias() += B.transpose() * HB;
    }
    scatter(body, e, Ke, K);
  }
}

template <int Dim>
double least_volume_ratio(const ElasticBody<Dim>& body, const Eigen::VectorXd& u) {
  double least = std::numeric_limits<double>::infinity();
  over_watched(body, [&](int e, const ShapeGradients<Dim>& g) {
    const Gradient<Dim> F = Gradient<Dim>::Identity() + gradient_of(body, e, g, u);
    least = std::min(least, F.determinant());
  });
  return least;
}

template <int Dim>
double inversion_bound(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, const Eigen::VectorXd& d) {
  double bound = 1;
  over_watched(body, [&](int e, const ShapeGradients<Dim>& g) {
    const Gradient<Dim> F = Gradient<Dim>::Identity() + gradient_of(body, e, g, u);
    bound = step_until_kept(volume_polynomial<Dim>(F, gradient_of(body, e, g, d)), bound);
  });
  return bound;
}

#define SEICHE_INSTANTIATE(Dim)                                                                                \
  template double elastic_energy<Dim>(const ElasticBody<Dim>&, const Eigen::VectorXd&);                        \
  template Eigen::VectorXd elastic_gradient<Dim>(const ElasticBody<Dim>&, const Eigen::VectorXd&);             \
  template void add_stiffness<Dim>(const ElasticBody<Dim>&, const Eigen::VectorXd&, Curvature, SparseMatrix&); \
  template double least_volume_ratio<Dim>(const ElasticBody<Dim>&, const Eigen::VectorXd&);                    \
  template double inversion_bound<Dim>(const ElasticBody<Dim>&, const Eigen::VectorXd&, const Eigen::VectorXd&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
