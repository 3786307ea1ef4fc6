#pragma once
// Preconditioners of saddle-point systems, from their velocity and pressure blocks.
#include "linalg/saddle/velocity.h"
#include "linalg/spd/schur_preconditioner.h"

namespace seiche {

// Vectors as SaddleOperator packs them.
class SaddlePreconditioner {
 public:
  // Keeps the reference. Collective.
  SaddlePreconditioner(const SaddleOperator& K, const std::string& pressure, const AmgSettings& settings)
      : K_(K), settings_(settings), name_(pressure) {}

  // For the present H of K; why it failed, else empty. Collective.
  [[nodiscard]] std::string refresh();
  // Block diagonal: symmetric and positive. Collective.
  void apply(const Vector& r, Vector& z);
  // Block triangular, the pressure after the velocity: neither. Collective.
  void apply_triangular(const Vector& r, Vector& z);
  // The velocity block alone, of vectors without pressures. Collective.
  void apply_viscous(const Vector& r, Vector& z);
  [[nodiscard]] std::string refresh_velocity();

 private:
  void make_pressure();
  void apply_pressure(const Vector& r, Vector& z);

  const SaddleOperator& K_;
  AmgSettings settings_;
  std::string name_;
  std::unique_ptr<VelocityPreconditioner> velocity_;
  std::unique_ptr<SchurPreconditioner> pressure_;
};

}  // namespace seiche
