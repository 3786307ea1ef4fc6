#include "solid/joint/patch.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>

#include "base/error.h"

namespace seiche {
namespace {

template <int Dim>
bool any_pinned(const ElasticSolid<Dim>& solid, const std::vector<int>& nodes) {
  return std::any_of(solid.pins.begin(), solid.pins.end(), [&](const PinnedNodes& pin) {
    std::vector<int> both;
    std::set_intersection(nodes.begin(), nodes.end(), pin.nodes.begin(), pin.nodes.end(), std::back_inserter(both));
    return !both.empty();
  });
}

// True if the nodes fix a rotation: two points in 2D, three that are not on a line in 3D.
template <int Dim>
bool has_rotation(const JointPatch<Dim>& patch) {
  constexpr double flat = 1e-9;
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (std::size_t n = 0; n < patch.nodes.size(); ++n)
    moment += patch.weight[n] * patch.arm[n] * patch.arm[n].transpose();
  const Eigen::Vector3d spread = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moment).eigenvalues();
  return spread[2] > 0 && (Dim == 2 || spread[1] > flat * spread[2]);
}

template <int Dim>
JointPatch<Dim> weighted(const ElasticBody<Dim>& body, std::vector<int> nodes) {
  JointPatch<Dim> patch;
  double sum = 0;
  for (const int n : nodes) sum += body.lumped_mass[Dim * n];
  for (const int n : nodes) {
    patch.weight.push_back(body.lumped_mass[Dim * n] / sum);
    patch.center += patch.weight.back() * extend<Dim>(body.mesh.nodes[std::size_t(n)]);
  }
  for (const int n : nodes) patch.arm.push_back(extend<Dim>(body.mesh.nodes[std::size_t(n)]) - patch.center);
  patch.nodes = std::move(nodes);
  return patch;
}

// R of A = R S with S symmetric, det R = 1.
template <int Dim>
Eigen::Matrix3d rotation_in(const Eigen::Matrix3d& A) {
  if constexpr (Dim == 2) {
    const double angle = std::atan2(A(1, 0) - A(0, 1), A(0, 0) + A(1, 1));
    return Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d sign(1, 1, 1);
  sign[2] = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  return svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
}

// The map from sum w_n R X_n x v_n to the angular velocity.
template <int Dim>
Eigen::Matrix3d inverse_inertia(const Eigen::Matrix3d& B) {
  if constexpr (Dim == 2) return Vec3(0, 0, 1 / B.trace()).asDiagonal();
  return (B.trace() * Eigen::Matrix3d::Identity() - B).inverse();
}

}  // namespace

template <int Dim>
JointPatch<Dim> make_patch(const ElasticSolid<Dim>& solid, const ShapeSpec& region, const ShapeOptions& options,
                           const std::string& joint, const std::string& name) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ExitCode::bad_input, fmt::format("{}: the region of joint '{}' {}", region.where, joint, why));
  };
  double nearest = 0;
  std::vector<int> nodes = nodes_within(solid.body.mesh, region, options, nearest);
  if (nodes.empty())
    refuse(fmt::format("contains none of the {} nodes of solid '{}'; the nearest lies {:.4g} m outside",
                       solid.body.mesh.nodes.size(), name, nearest));
  if (any_pinned(solid, nodes))
    refuse(fmt::format("holds pinned nodes of solid '{}'; separate it from the pins", name));
  JointPatch<Dim> patch = weighted(solid.body, std::move(nodes));
  if (!has_rotation(patch))
    refuse(fmt::format("holds only {} node(s) of solid '{}'{}; enlarge it", patch.nodes.size(), name,
                       Dim == 3 ? ", all on a line" : ""));
  return patch;
}

// With A = sum w x X' = R S, B = A R', velocities v: R' = [w] R keeps A R' symmetric if
//   (tr(B) - B) w = sum w_n R X_n x v_n.
template <int Dim>
PlacedPatch<Dim> place_patch(const JointPatch<Dim>& patch, const Eigen::VectorXd& u) {
  const auto moved = [&](std::size_t n) { return extend<Dim>(Vec<Dim>(u.segment<Dim>(Dim * patch.nodes[n]))); };
  Vec3 shift = Vec3::Zero();
  for (std::size_t n = 0; n < patch.nodes.size(); ++n) shift += patch.weight[n] * moved(n);
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  for (std::size_t n = 0; n < patch.nodes.size(); ++n)
    A += patch.weight[n] * (patch.arm[n] + moved(n) - shift) * patch.arm[n].transpose();
  const Eigen::Matrix3d R = rotation_in<Dim>(A), to_spin = inverse_inertia<Dim>(A * R.transpose());
  PlacedPatch<Dim> placed{{{R, patch.center, shift}, patch.center + shift}, {}};
  for (std::size_t n = 0; n < patch.nodes.size(); ++n)
    for (int axis = 0; axis < Dim; ++axis) {
      const Vec3 v = patch.weight[n] * Vec3::Unit(axis);
      auto& [unknown, rate] = placed.rates.emplace_back();
      unknown = Dim * patch.nodes[n] + axis;
      rate << v, to_spin * Vec3(R * patch.arm[n]).cross(v);
    }
  return placed;
}

template JointPatch<2> make_patch<2>(const ElasticSolid<2>&, const ShapeSpec&, const ShapeOptions&, const std::string&,
                                     const std::string&);
template JointPatch<3> make_patch<3>(const ElasticSolid<3>&, const ShapeSpec&, const ShapeOptions&, const std::string&,
                                     const std::string&);
template PlacedPatch<2> place_patch<2>(const JointPatch<2>&, const Eigen::VectorXd&);
template PlacedPatch<3> place_patch<3>(const JointPatch<3>&, const Eigen::VectorXd&);

}  // namespace seiche
