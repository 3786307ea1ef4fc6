#include "linalg/saddle_preconditioner.h"

namespace seiche {

std::string SaddlePreconditioner::refresh_velocity() {
  if (!velocity_) velocity_ = std::make_unique<VelocityPreconditioner>(K_, settings_);
  return velocity_->refresh() ? "" : "the velocity part of the bodies could not be factored";
}

std::string SaddlePreconditioner::refresh() {
  if (std::string failure = refresh_velocity(); !failure.empty()) return failure;
  if (!pressure_) pressure_ = std::make_unique<PressurePreconditioner>(K_, *velocity_, name_, settings_);
  return pressure_->refresh();
}

void SaddlePreconditioner::apply(const Vector& r, Vector& z) {
  Vector ru, rp, zu, zp;
  Eigen::VectorXd rv, zv;
  K_.unpack(r, ru, rv, rp);
  velocity_->apply(ru, rv, zu, zv);
  pressure_->apply(rp, zp);
  z = K_.pack(zu, zv, zp);
}

// [V 0; D J -S]^-1
void SaddlePreconditioner::apply_triangular(const Vector& r, Vector& z) {
  Vector ru, rp, zu, zp, flux;
  Eigen::VectorXd rv, zv;
  K_.unpack(r, ru, rv, rp);
  velocity_->apply(ru, rv, zu, zv);
  K_.divergence(zu, zv, flux);
  for (std::size_t i = 0; i < rp.size(); ++i) flux[i] -= rp[i];
  pressure_->apply(flux, zp);
  z = K_.pack(zu, zv, zp);
}

void SaddlePreconditioner::apply_viscous(const Vector& r, Vector& z) {
  Vector ru(r.begin(), r.begin() + K_.velocities()), zu;
  Eigen::VectorXd rv = Eigen::VectorXd::Zero(K_.unknowns()), zv;
  std::copy(r.begin() + K_.velocities(), r.end(), rv.begin());
  make_identical(rv, K_.ranks());
  velocity_->apply(ru, rv, zu, zv);
  z = K_.pack(zu, zv, {});
}

}  // namespace seiche
