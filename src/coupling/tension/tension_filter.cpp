#include "coupling/tension/tension_filter.h"

#include <numbers>

#include "coupling/tension/surface_graph.h"
#include "fluid/boundary/domain.h"
#include "linalg/krylov/krylov.h"

namespace seiche {
namespace {

// The operator 1 + l^4 K^2, and Jacobi's preconditioner for it. K: Laplacian of the graph.
template <int Dim>
class Filter {
 public:
  Filter(const SurfaceGraph<Dim>& graph, double length) : graph_(graph), weight_(std::pow(length, 4)) {}

  void multiply(const Vector& x, Vector& y) const {
    Vector bent(x.size());
    graph_.laplacian(x, bent);
    graph_.laplacian(bent, y);
    for (std::size_t n = 0; n < x.size(); ++n) y[n] = x[n] + weight_ * y[n];
  }
  void residual(const Vector& b, const Vector& x, Vector& r) const {
    multiply(x, r);
    for (std::size_t n = 0; n < b.size(); ++n) r[n] = b[n] - r[n];
  }
  void apply(const Vector& r, Vector& z) const {
    for (std::size_t n = 0; n < r.size(); ++n) {
      const double degree = graph_.degree(n);
      z[n] = r[n] / (1 + weight_ * degree * (degree + 1));
    }
  }

 private:
  const SurfaceGraph<Dim>& graph_;
  double weight_;
};

// Mean of kappa over the crossed links of each cell.
template <int Dim>
Vector mean_at_cells(const Layout<Dim>& layout, const std::vector<Site>& cells, const FaceField<Dim, char>& crossed,
                     const FaceField<Dim>& kappa) {
  Vector mean(cells.size());
  for (std::size_t n = 0; n < cells.size(); ++n) {
    int count = 0;
    for (int a = 0; a < Dim; ++a)
      for (Site f : {cells[n], cells[n] + layout.stride(a)})
        if (crossed.at(a, f)) mean[n] += kappa.at(a, f), ++count;
    mean[n] /= count;
  }
  return mean;
}

}  // namespace

// s^2 = 1.4. On surfaces along grid diagonals the graph's Laplacian is half that of the surface. The largest (omega
// dt)^2, that of s^2 x^3/(1 + x^4/4) with x = l k, is then 1.5^2.
double filter_length(double sigma, double density, double h, double dt) {
  if (dt * dt * 4 * std::numbers::pi * sigma <= density * h * h * h) return 0;
  return std::cbrt(sigma * dt * dt / (1.4 * density)) / h;
}

template <int Dim>
void filter_curvature(const Domain<Dim>& domain, const CellField<Dim>& phi, const FaceField<Dim, char>& crossed,
                      double length, FaceField<Dim>& kappa) {
  const SurfaceGraph<Dim> graph(domain, crossed);
  const Vector before = mean_at_cells(domain.layout, graph.cells(), crossed, kappa);
  Vector after = before;
  Filter<Dim> filter(graph, length);
  constexpr double tolerance = 1e-10;  // relative; far below the error of curvature
  constexpr int most = 2000;           // iterations; an unconverged result is still a curvature, only less smooth
  conjugate_gradients(filter, filter, before, after, {tolerance * norm(before, domain.ranks), most}, domain.ranks);
  // Differences between the links of one cell are the shortest waves of all, so interpolation drops them too.
  const CellField<Dim>& smooth = graph.spread(after);
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) {
      if (!crossed.at(a, f)) return;
      const Site low = f - domain.layout.stride(a);
      const double t = phi[low] / (phi[low] - phi[f]);
      kappa.at(a, f) = (1 - t) * smooth[low] + t * smooth[f];
    });
}

template void filter_curvature<2>(const Domain<2>&, const CellField<2>&, const FaceField<2, char>&, double,
                                  FaceField<2>&);
template void filter_curvature<3>(const Domain<3>&, const CellField<3>&, const FaceField<3, char>&, double,
                                  FaceField<3>&);

}  // namespace seiche
