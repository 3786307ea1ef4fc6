#include "linalg/saddle_preconditioner.h"

namespace seiche {

std::string SaddlePreconditioner::refresh_velocity() {
  if (!velocity_) velocity_ = std::make_unique<VelocityPreconditioner>(K_, settings_);
  return velocity_->refresh() ? "" : "the velocity part of the bodies could not be factored";
}

std::string SaddlePreconditioner::refresh() {
  if (std::string failure = refresh_velocity(); !failure.empty()) return failure;
  if (!pressure_) make_pressure();
  return pressure_->refresh(K_.bodies(), velocity_->direction_energies());
}

// S = schur_scale (A + ...); directions push Jd = J m - D W.
void SaddlePreconditioner::make_pressure() {
  const double scale = K_.system().schur_scale;
  Vector mass = K_.system().schur_mass;
  for (double& entry : mass) entry *= scale;
  pressure_ =
      std::make_unique<SchurPreconditioner>(K_.liquid(), K_.system().J, 1 / scale, std::move(mass), name_, settings_);
  std::vector<Vector> Jd;
  for (const Direction& d : velocity_->directions()) {
    Vector w(std::size_t(K_.velocities()), 0.0);
    add_scaled(w, -1, d.W);
    K_.divergence(w, d.m, Jd.emplace_back());
  }
  pressure_->set_directions(std::move(Jd));
}

void SaddlePreconditioner::apply_pressure(const Vector& r, Vector& z) {
  pressure_->apply(r, z);
  for (double& entry : z) entry /= K_.system().schur_scale;
}

void SaddlePreconditioner::apply(const Vector& r, Vector& z) {
  Vector ru, rp, zu, zp;
  Eigen::VectorXd rv, zv;
  K_.unpack(r, ru, rv, rp);
  velocity_->apply(ru, rv, zu, zv);
  apply_pressure(rp, zp);
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
  apply_pressure(flux, zp);
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
