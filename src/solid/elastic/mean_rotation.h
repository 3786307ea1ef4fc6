#pragma once
// The rigid part of a step of many points.
#include <Eigen/Dense>

#include "base/vec.h"

namespace seiche {

// Displacements d of points x (stacked, Dim each), m: d = t + a x r + q, with r = x - mean(x), t = mean(d), and the
// angles a (rad) of least squares: sum |r|^2 a - r (r.a) = sum r x d.
template <int Dim>
class MeanRotation {
 public:
  MeanRotation(const Eigen::VectorXd& x, const Eigen::VectorXd& d);
  double angle() const;  // |a|
  // t + (exp(a) - 1) r + exp(a) q
  Eigen::VectorXd along_arc(const Eigen::VectorXd& x, const Eigen::VectorXd& d) const;

 private:
  Vec<Dim> center_, shift_;
  Eigen::Matrix<double, Dim, Dim> spin_;  // a x r = spin r
};

}  // namespace seiche
