#include "linalg/saddle/preconditioner.h"

#include "linalg/saddle/lsc_preconditioner.h"

namespace seiche {
namespace {

// Traces of F - M and M: mu dt/(rho h^2) of about 7 in 3D. Below, what mass leaves to be done the mass-weighted model
// does as well, in half the time.
bool viscosity_prevails(const SaddleOperator& K) {
  constexpr double much = 40;
  std::array<double, 2> sums{0, 0};
  for (int i = 0; i < K.velocities(); ++i) sums[0] += K.faces().diagonal(i), sums[1] += K.system().mass[std::size_t(i)];
  K.ranks().global_sum(sums);
  return sums[0] - sums[1] > much * sums[1];
}

}  // namespace

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
  if (name_ == "auto" && !K_.system().J.any_deforms() && (velocity_->is_multigrid() || viscosity_prevails(K_)))
    pressure_->set_liquid(std::make_unique<LscPreconditioner>(K_, velocity_->pressure_free_rows(), settings_));
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
