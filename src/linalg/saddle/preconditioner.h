#pragma once
// Preconditioners of saddle-point systems, built from velocity and pressure blocks.
#include "linalg/saddle/velocity.h"
#include "linalg/spd/schur_preconditioner.h"

namespace seiche {

// Vectors are packed by SaddleOperator.
class SaddlePreconditioner {
 public:
  // Keeps a reference to K; `pressure` is the name of the pressure preconditioner. Collective.
  SaddlePreconditioner(const SaddleOperator& K, const std::string& pressure, const AmgSettings& settings)
      : K_(K), settings_(settings), name_(pressure) {}

  // Updates for the current H of K. Returns the reason of a failure, else an empty string. Collective.
  [[nodiscard]] std::string refresh();
  // Block-diagonal; symmetric and positive. Collective.
  void apply(const Vector& r, Vector& z);
  // Block-triangular, pressure after velocity; not symmetric. Collective.
  void apply_triangular(const Vector& r, Vector& z);
  // Velocity block only, for vectors without pressures. Collective.
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
