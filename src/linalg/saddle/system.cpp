#include "linalg/saddle/system.h"

#include <algorithm>

namespace seiche {

SaddleOperator::SaddleOperator(const SaddleSystem& s, const Communicator& ranks)
    : system_(s),
      F_(s.F, no_grid_, none_, ranks),
      A_(s.A, s.grid, s.closed, ranks),
      D_(s.D, s.F.first_row, s.F.rows(), ranks),
      Dt_(s.Dt, s.A.first_row, s.A.rows(), ranks),
      unknowns_(s.J.columns()) {}

Vector SaddleOperator::pack(const Vector& u, const Eigen::VectorXd& v, const Vector& p) const {
  Vector x(u);
  x.insert(x.end(), p.begin(), p.end());
  if (ranks().is_root()) x.insert(x.end(), v.begin(), v.end());
  return x;
}

void SaddleOperator::unpack(const Vector& x, Vector& u, Eigen::VectorXd& v, Vector& p) const {
  const auto faces = x.begin() + velocities(), cells = faces + pressures();
  u.assign(x.begin(), faces);
  p.assign(faces, cells);
  v.setZero(unknowns_);
  std::copy(cells, x.end(), v.begin());
  make_identical(v, ranks());
}

void SaddleOperator::multiply_velocity(const Vector& u, const Eigen::VectorXd& v, Vector& fu,
                                       Eigen::VectorXd& fv) const {
  fu.resize(u.size());
  F_.multiply(u, fu);
  fv.setZero(unknowns_);
  if (unknowns_ == 0) return;
  add_multiplied(system_.G, v, fu);
  fv = multiply_transposed(system_.G, u, ranks()) + H_->matrix() * v;
}

void SaddleOperator::add_gradient(const Vector& p, Vector& fu, Eigen::VectorXd& fv) const {
  Dt_.add_multiplied(p, fu);
  if (unknowns_ > 0) fv += multiply_transposed(system_.J, p, ranks());
}

void SaddleOperator::divergence(const Vector& u, const Eigen::VectorXd& v, Vector& flux) const {
  flux.assign(std::size_t(pressures()), 0.0);
  D_.add_multiplied(u, flux);
  add_multiplied(system_.J, v, flux);
}

void SaddleOperator::drop_multipliers(Eigen::VectorXd& fv) const {
  if (unknowns_ > 0 && !H_->constraints().empty()) fv = H_->constraints().without_multipliers(fv);
}

void SaddleOperator::multiply(const Vector& x, Vector& y) const {
  Vector u, p, fu, flux;
  Eigen::VectorXd v, fv;
  unpack(x, u, v, p);
  multiply_velocity(u, v, fu, fv);
  add_gradient(p, fu, fv);
  divergence(u, v, flux);
  drop_multipliers(fv);
  y = pack(fu, fv, flux);
}

void SaddleOperator::residual(const Vector& b, const Vector& x, Vector& r) const {
  multiply(x, r);
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = b[i] - r[i];
}

}  // namespace seiche
