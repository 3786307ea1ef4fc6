#pragma once
// Krylov methods for any operator and preconditioner. An operator provides
//   multiply(x, y)     y = A x
//   residual(b, x, r)  r = b - A x
// and a preconditioner apply(r, z), z = B r. All three are collective.
#include <string>

#include "linalg/core/vector_ops.h"

namespace seiche {

enum class Start { warm, cold };  // from the last solution, or from zero

struct KrylovLimits {
  double target = 0;  // stop at |r| <= target; r is the residual of the recurrence
  int iterations = 0;
};

struct KrylovResult {
  int iterations = 0;
  std::string failure;  // empty if the target is met
};

// Preconditioned conjugate gradients (Hestenes, Stiefel 1952). A and B are symmetric positive (semi-)definite.
template <class Operator, class Preconditioner>
KrylovResult conjugate_gradients(const Operator& A, Preconditioner& B, const Vector& b, Vector& x,
                                 const KrylovLimits& limits, const Communicator& ranks) {
  Vector r(b.size()), z(b.size()), p(b.size()), q(b.size());
  A.residual(b, x, r);
  double rz = 0;
  for (int k = 0;; ++k) {
    if (norm(r, ranks) <= limits.target) return {k, ""};
    if (k == limits.iterations) return {k, "iteration limit"};
    B.apply(r, z);
    const double rz_before = rz;
    rz = dot(r, z, ranks);
    if (!(rz > 0)) return {k, "preconditioner not positive definite"};
    if (k == 0)
      p = z;
    else
      scale_and_add(p, rz / rz_before, z);  // p = z + beta p
    A.multiply(p, q);
    const double pq = dot(p, q, ranks);
    if (!(pq > 0)) return {k, "matrix not positive definite"};
    add_scaled(x, rz / pq, p);
    add_scaled(r, -rz / pq, q);
  }
}

// Least-squares problem of GMRES, min |beta e1 - H y|; Givens rotations keep H triangular.
class HessenbergLeastSquares {
 public:
  explicit HessenbergLeastSquares(double beta) : rhs_{beta} {}
  // Appends a column of k + 2 entries, k the number of columns so far. Returns the residual norm.
  double append(std::vector<double> column);
  std::vector<double> solve() const;

 private:
  std::vector<std::vector<double>> columns_;
  std::vector<double> cosines_, sines_, rhs_;
};

// Preconditioned directions Z of GMRES: `kept` stores all; `summed` applies B once to V y, for linear preconditioners.
enum class Directions { kept, summed };

// x += Z y, or x += B V y if Z was not kept.
template <class Preconditioner>
void add_combination(const std::vector<double>& y, const std::vector<Vector>& v, const std::vector<Vector>& z,
                     Preconditioner& B, Vector& x) {
  for (std::size_t k = 0; k < z.size(); ++k) add_scaled(x, y[k], z[k]);
  if (!z.empty() || y.empty()) return;
  Vector sum(x.size(), 0.0), Bs(x.size());
  for (std::size_t k = 0; k < y.size(); ++k) add_scaled(sum, y[k], v[k]);
  B.apply(sum, Bs);
  add_scaled(x, 1, Bs);
}

// Right-preconditioned GMRES (Saad, Schultz 1986). With Directions::kept it is flexible (Saad 1993): B may vary
// slightly between applications. A and B need not be symmetric. Restarts every `restart` steps.
template <class Operator, class Preconditioner>
KrylovResult gmres(const Operator& A, Preconditioner& B, const Vector& b, Vector& x, const KrylovLimits& limits,
                   const Communicator& ranks, Directions directions, int restart = 40) {
  Vector r(b.size()), Br(b.size());
  int done = 0;
  while (true) {
    A.residual(b, x, r);
    const double beta = norm(r, ranks);
    if (beta <= limits.target) return {done, ""};
    if (done >= limits.iterations) return {done, "iteration limit"};
    if (!std::isfinite(beta)) return {done, "not finite"};
    HessenbergLeastSquares small(beta);
    std::vector<Vector> v, z;  // Krylov basis; preconditioned basis
    double residual = beta, length = beta;
    for (int k = 0; k < restart && done < limits.iterations && residual > limits.target && length > 0; ++k, ++done) {
      for (double& entry : r) entry /= length;
      v.push_back(r);
      B.apply(v[k], Br);
      A.multiply(Br, r);
      if (directions == Directions::kept) z.push_back(Br);
      std::vector<double> h;
      for (const Vector& u : v) {  // modified Gram-Schmidt
        h.push_back(dot(u, r, ranks));
        add_scaled(r, -h.back(), u);
      }
      length = norm(r, ranks);
      h.push_back(length);
      residual = small.append(std::move(h));
    }
    add_combination(small.solve(), v, z, B, x);
  }
}

template <class Operator, class Preconditioner>
KrylovResult flexible_gmres(const Operator& A, Preconditioner& B, const Vector& b, Vector& x,
                            const KrylovLimits& limits, const Communicator& ranks, int restart = 40) {
  return gmres(A, B, b, x, limits, ranks, Directions::kept, restart);
}

}  // namespace seiche
