#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel_range.h"
#include "solid/elastic/body.h"
#include "solid/material/guard.h"

namespace seiche {
namespace {

constexpr double kept_volume = 0.1;  // share of det F that one step must keep
constexpr int a_batch = 1024;        // elements whose terms are found before they are added up, in order
constexpr std::size_t a_task = 16;   // elements that a thread takes at a time

// sum_a u_a g_a'
template <int Dim>
Gradient<Dim> gradient_of(const ElasticBody<Dim>& body, int e, const ShapeGradients<Dim>& g, const Eigen::VectorXd& u) {
  Gradient<Dim> D = Gradient<Dim>::Zero();
  const int* n = body.mesh.element(e);
  for (int a = 0; a < g.rows(); ++a) D.noalias() += u.segment<Dim>(Dim * n[a]) * g.row(a);
  return D;
}

// Kind of point at which det F is evaluated: a quadrature point, where the material has its energy, or (order 2) a
// node, where only the volume guard acts.
enum class Role { quadrature, node };

template <int Dim>
struct Point {
  int element, number;  // index among all quadrature points, or among the nodes of all elements
  Role role;
  double weight;  // volume assigned to the point, m^3
  const ShapeGradients<Dim>& g;

  Gradient<Dim> deformation(const ElasticBody<Dim>& body, const Eigen::VectorXd& u) const {
    return Gradient<Dim>::Identity() + gradient_of(body, element, g, u);
  }
  bool is_held(const HeldPressure<Dim>& held) const { return role == Role::quadrature && held.acts(number); }
};

// Visits f(point) over the points of an element.
template <int Dim, class Visit>
void over_points(const ElasticBody<Dim>& body, int e, Visit visit) {
  double volume = 0;
  for (int q = e * body.points_per_element; q < (e + 1) * body.points_per_element; ++q) {
    visit(Point<Dim>{e, q, Role::quadrature, body.weights[q], body.gradients[q]});
    volume += body.weights[q];
  }
  const int count = body.node_gradients.empty() ? 0 : body.mesh.nodes_per_element();
  for (int a = e * count; a < (e + 1) * count; ++a) {
    visit(Point<Dim>{e, a, Role::node, volume / count, body.node_gradients[a]});
  }
}

template <int Dim, class Visit>
void over_points(const ElasticBody<Dim>& body, int begin, int end, Visit visit) {
  for (int e = begin; e < end; ++e) over_points(body, e, visit);
}

// Threads call find(e) for a batch of elements, then add(e, what was found) runs in the order of the elements.
template <class Found, class Find, class Add>
void by_element(IndexRange elements, Find find, Add add) {
  std::vector<Found> found(std::size_t(std::min(elements.size(), a_batch)));
  for (int first = elements.begin; first < elements.end; first += a_batch) {
    const int count = std::min(a_batch, elements.end - first);
    parallel_pieces(std::size_t(count), a_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) found[n] = find(first + int(n));
    });
    for (int n = 0; n < count; ++n) add(first + n, found[std::size_t(n)]);
  }
}

// Column a: dPsi/du_a of the element.
template <int Dim>
using ElementForce = Eigen::Matrix<double, Dim, Eigen::Dynamic, Eigen::ColMajor, Dim, (Dim + 1) * (Dim + 2) / 2>;

// dPsi/du_a = integral of P g_a; the guard contributes b' dJ/dF to P.
template <int Dim>
ElementForce<Dim> force_of(const ElasticBody<Dim>& body, int e, const Eigen::VectorXd& u,
                           const HeldPressure<Dim>& held) {
  const Lame& lame = body.properties.lame;
  ElementForce<Dim> force = ElementForce<Dim>::Zero(Dim, body.mesh.nodes_per_element());
  over_points(body, e, [&](const Point<Dim>& p) {
    const Gradient<Dim> F = p.deformation(body, u);
    const double guard = elastic::volume_guard(lame, F.determinant()).slope;
    if (p.role == Role::node && guard == 0) return;
    Gradient<Dim> P = Gradient<Dim>::Zero();
    if (p.role == Role::quadrature) P = body.material.stress(lame, F);
    if (p.is_held(held)) P += held.stress(p.number, F);
    if (guard != 0) P += guard * elastic::cofactor<Dim>(F);
    force.noalias() += (p.weight * P) * p.g.transpose();
  });
  return force;
}

template <int Dim>
using ElementMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor,
                                    Dim*(Dim + 1) * (Dim + 2) / 2, Dim*(Dim + 1) * (Dim + 2) / 2>;

// Adds B' H B for B with dF = B du. Column (b, k) of B holds g_b in the entries of row k of F and zeros elsewhere:
//   (H B)_{r,bk} = sum_l H_{r,kl} g_bl,   K_{ai,bk} = sum_j g_aj (H B)_{ij,bk}.
template <int Dim>
void add_product(const ShapeGradients<Dim>& g, const Hessian<Dim>& H, ElementMatrix<Dim>& K) {
  constexpr int most = Dim * (Dim + 1) * (Dim + 2) / 2;
  Eigen::Matrix<double, Dim * Dim, Eigen::Dynamic, Eigen::RowMajor, Dim * Dim, most> HB(Dim * Dim, K.cols());
  for (int b = 0; b < g.rows(); ++b) {
    Eigen::Matrix<double, Dim * Dim, Dim> columns = H.template leftCols<Dim>() * g(b, 0);
    for (int l = 1; l < Dim; ++l) columns += H.template middleCols<Dim>(Dim * l) * g(b, l);
    HB.template middleCols<Dim>(Dim * b) = columns;
  }
  for (int a = 0; a < g.rows(); ++a) {
    for (int i = 0; i < Dim; ++i) {
      if constexpr (Dim == 2)
        K.row(Dim * a + i) += g(a, 0) * HB.row(i) + g(a, 1) * HB.row(i + Dim);
      else
        K.row(Dim * a + i) += g(a, 0) * HB.row(i) + g(a, 1) * HB.row(i + Dim) + g(a, 2) * HB.row(i + 2 * Dim);
    }
  }
}

// True if the element has unknowns among the columns.
template <int Dim>
bool touches(const ElasticBody<Dim>& body, int e, IndexRange columns) {
  const int* n = body.mesh.element(e);
  return std::any_of(n, n + body.mesh.nodes_per_element(),
                     [&](int node) { return Dim * node + Dim > columns.begin && Dim * node < columns.end; });
}

// Adds the element's matrix to the columns of its nodes, as far as K has them.
template <int Dim>
void scatter(const ElasticBody<Dim>& body, int e, const ElementMatrix<Dim>& Ke, IndexRange columns, SparseMatrix& K) {
  const int count = body.mesh.nodes_per_element();
  const int *n = body.mesh.element(e), *slot = body.slots.data() + size_t(e) * count * count;
  for (int b = 0; b < count; ++b) {
    for (int k = 0; k < Dim; ++k) {
      if (!columns.holds(Dim * n[b] + k)) continue;
      double* column = K.valuePtr() + K.outerIndexPtr()[Dim * n[b] + k - columns.begin];
      for (int a = 0; a < count; ++a) {
        for (int i = 0; i < Dim; ++i) column[slot[a * count + b] + i] += Ke(Dim * a + i, Dim * b + k);
      }
    }
  }
}

// K_e = integral of B' H B with H = d2Psi/dF2 plus the guard's b'' dJ/dF dJ/dF' + b' d2J/dF2.
template <int Dim>
ElementMatrix<Dim> stiffness_of(const ElasticBody<Dim>& body, int e, const Eigen::VectorXd& u,
                                HessianProjection curvature, const HeldPressure<Dim>& held) {
  const Lame& lame = body.properties.lame;
  const int size = Dim * body.mesh.nodes_per_element();
  ElementMatrix<Dim> Ke = ElementMatrix<Dim>::Zero(size, size);
  over_points(body, e, [&](const Point<Dim>& p) {
    const Gradient<Dim> F = p.deformation(body, u);
    const elastic::Guard guard = elastic::volume_guard(lame, F.determinant());
    if (p.role == Role::node && guard.slope == 0) return;
    Hessian<Dim> H = Hessian<Dim>::Zero();
    if (p.role == Role::quadrature) H = body.material.stiffness(lame, F);
    if (p.is_held(held)) H += held.stiffness(p.number, F);
    const elastic::Flat<Dim> c = elastic::flat<Dim>(elastic::cofactor<Dim>(F));
    if (guard.slope != 0) H += guard.curvature * c * c.transpose() + guard.slope * elastic::cofactor_derivative<Dim>(F);
    if (curvature == HessianProjection::convex) H = project_positive<Dim>(H);
    add_product<Dim>(p.g, p.weight * H, Ke);
  });
  return Ke;
}

// J(F + t D) = c_0 + c_1 t + c_2 t^2 + c_3 t^3
template <int Dim>
std::array<double, 4> volume_polynomial(const Gradient<Dim>& F, const Gradient<Dim>& D) {
  const double first = elastic::cofactor<Dim>(F).cwiseProduct(D).sum();
  if constexpr (Dim == 2) return {F.determinant(), first, D.determinant(), 0};
  return {F.determinant(), first, elastic::cofactor<Dim>(D).cwiseProduct(F).sum(), D.determinant()};
}

// Lower bound on the first t at which the polynomial has fallen to kept_volume c_0, at most `limit`. A step of the
// remaining value over the steepest slope within `window` cannot pass the root. The window adapts to the steps.
double step_until_kept(const std::array<double, 4>& c, double limit) {
  double t = 0, window = limit;
  for (int i = 0; i < 100; ++i) {  // further steps only come closer
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

}  // namespace

template <int Dim>
Gradient<Dim> deformation_at(const ElasticBody<Dim>& body, int q, const Eigen::VectorXd& u) {
  return Gradient<Dim>::Identity() + gradient_of(body, q / body.points_per_element, body.gradients[std::size_t(q)], u);
}

template <int Dim>
double elastic_energy(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, const HeldPressure<Dim>& held,
                      IndexRange elements) {
  const Lame& lame = body.properties.lame;
  return sum_of_pieces(std::size_t(elements.size()), a_task, [&](std::size_t begin, std::size_t end) {
    double Psi = 0;
    over_points(body, elements.begin + int(begin), elements.begin + int(end), [&](const Point<Dim>& p) {
      const Gradient<Dim> F = p.deformation(body, u);
      double density = p.role == Role::quadrature ? body.material.energy(lame, F) : 0;
      if (p.is_held(held)) density += held.energy(p.number, F);
      Psi += p.weight * (density + elastic::volume_guard(lame, F.determinant()).value);
    });
    return Psi;
  });
}

template <int Dim>
Eigen::VectorXd elastic_gradient(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, const HeldPressure<Dim>& held,
                                 IndexRange elements) {
  Eigen::VectorXd r = Eigen::VectorXd::Zero(body.size());
  by_element<ElementForce<Dim>>(
      elements, [&](int e) { return force_of(body, e, u, held); },
      [&](int e, const ElementForce<Dim>& force) {
        const int* n = body.mesh.element(e);
        for (int a = 0; a < force.cols(); ++a) r.segment<Dim>(Dim * n[a]) += force.col(a);
      });
  return r;
}

template <int Dim>
void add_stiffness(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, HessianProjection curvature,
                   const HeldPressure<Dim>& held, IndexRange elements, IndexRange columns, SparseMatrix& K) {
  by_element<ElementMatrix<Dim>>(
      elements,
      [&](int e) {
        return touches(body, e, columns) ? stiffness_of(body, e, u, curvature, held) : ElementMatrix<Dim>();
      },
      [&](int e, const ElementMatrix<Dim>& Ke) {
        if (Ke.size() > 0) scatter(body, e, Ke, columns, K);
      });
}

template <int Dim>
double least_volume_ratio(const ElasticBody<Dim>& body, const Eigen::VectorXd& u) {
  double least = std::numeric_limits<double>::infinity();
  over_points(body, 0, body.mesh.element_count(),
              [&](const Point<Dim>& p) { least = std::min(least, p.deformation(body, u).determinant()); });
  return least;
}

template <int Dim>
double inversion_bound(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, const Eigen::VectorXd& d,
                       IndexRange elements) {
  const auto count = std::size_t(elements.size());
  std::vector<double> bounds(count / a_task + 1, 1);
  parallel_pieces(count, a_task, [&](std::size_t begin, std::size_t end) {
    double& bound = bounds[begin / a_task];
    over_points(body, elements.begin + int(begin), elements.begin + int(end), [&](const Point<Dim>& p) {
      const Gradient<Dim> D = gradient_of(body, p.element, p.g, d);
      bound = step_until_kept(volume_polynomial<Dim>(p.deformation(body, u), D), bound);
    });
  });
  return *std::min_element(bounds.begin(), bounds.end());
}

#define SEICHE_INSTANTIATE(D)                                                                                         \
  template Gradient<D> deformation_at<D>(const ElasticBody<D>&, int, const Eigen::VectorXd&);                         \
  template double elastic_energy<D>(const ElasticBody<D>&, const Eigen::VectorXd&, const HeldPressure<D>&,            \
                                    IndexRange);                                                                      \
  template Eigen::VectorXd elastic_gradient<D>(const ElasticBody<D>&, const Eigen::VectorXd&, const HeldPressure<D>&, \
                                               IndexRange);                                                           \
  template void add_stiffness<D>(const ElasticBody<D>&, const Eigen::VectorXd&, HessianProjection,                    \
                                 const HeldPressure<D>&, IndexRange, IndexRange, SparseMatrix&);                      \
  template double least_volume_ratio<D>(const ElasticBody<D>&, const Eigen::VectorXd&);                               \
  template double inversion_bound<D>(const ElasticBody<D>&, const Eigen::VectorXd&, const Eigen::VectorXd&, IndexRange);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
