#include "solid/contact/deformable.h"

namespace seiche::contact {
namespace {

// The body of one side (-1: a wall) and the range of its points within the pair.
struct Side {
  int body, begin, end;
};

template <int Dim>
std::array<Side, 2> sides_of(const Candidate& pair) {
  const int split = points_of_first(pair.kind);
  return {Side{pair.first, 0, split},
          Side{pair.kind == PairKind::point_wall ? -1 : pair.second, split, points_of(pair.kind, Dim)}};
}

// Hessian part from the curvature of rotations, f . d2x = sym(f r') - (f . r) 1, summed over the points of one rigid
// side (2D: -f . r).
template <int Dim>
Eigen::Matrix<double, turn_size<Dim>, turn_size<Dim>> turning(const Side& side, const Vec<Dim>& center,
                                                              const PairPoints<Dim>& x,
                                                              const Eigen::Matrix<double, Dim, 4>& forces) {
  Eigen::Matrix<double, turn_size<Dim>, turn_size<Dim>> sum;
  sum.setZero();
  for (int i = side.begin; i < side.end; ++i) {
    const Vec<Dim> r = x[i] - center, f = forces.col(i);
    sum.diagonal().array() -= f.dot(r);
    if constexpr (Dim == 3) sum += 0.5 * (f * r.transpose() + r * f.transpose());
  }
  return sum;
}

}  // namespace

template <int Dim>
PairDofs<Dim> pair_dofs(const typename ContactScene<Dim>::Data& scene, const Interval<Dim>& interval,
                        const Candidate& pair) {
  PairDofs<Dim> r;
  r.prescribed.setZero(PairDofs<Dim>::most);
  r.lengths.setOnes(PairDofs<Dim>::most);
  const auto sides = sides_of<Dim>(pair);
  for (int s = 0; s < 2; ++s) {
    const Side& side = sides[s];
    r.begin[s] = r.count;
    if (side.body < 0) continue;
    if (scene.deforms(side.body)) {
      for (int i = side.begin; i < side.end; ++i)
        for (int axis = 0; axis < Dim; ++axis) r.dof[r.count++] = scene.point_dof[pair.points[i]] + axis;
      continue;
    }
    const int first = scene.first_dof[side.body];
    if (first < 0) r.prescribed.template segment<twist_size<Dim>>(r.count) = interval.prescribed[side.body];
    r.lengths.template segment<turn_size<Dim>>(r.count + Dim).setConstant(interval.radius[side.body]);
    for (int k = 0; k < twist_size<Dim>; ++k) r.dof[r.count++] = first < 0 ? -1 : first + k;
  }
  r.prescribed.conservativeResize(r.count);
  r.lengths.conservativeResize(r.count);
  return r;
}

// Point velocities: dx = H dv at a node, dx = H (dv + (J_l d omega) x r) on a rigid body.
template <int Dim>
PairTerms<Dim> pair_terms(const typename ContactScene<Dim>::Data& scene, const Interval<Dim>& interval,
                          const Placement<Dim>& at, const Candidate& pair, const PairDofs<Dim>& dofs,
                          const PairPoints<Dim>& x, const PairEnergy<Dim>& energy) {
  constexpr int turn = turn_size<Dim>;
  typename PairDofs<Dim>::Jacobian J = PairDofs<Dim>::Jacobian::Zero(4 * Dim, dofs.count);
  typename PairDofs<Dim>::Matrix turns = PairDofs<Dim>::Matrix::Zero(dofs.count, dofs.count);
  const auto sides = sides_of<Dim>(pair);
  for (int s = 0; s < 2; ++s) {
    const Side& side = sides[s];
    if (side.body < 0) continue;
    const int begin = dofs.begin[s];
    if (scene.deforms(side.body)) {
      J.block(Dim * side.begin, begin, Dim * (side.end - side.begin), Dim * (side.end - side.begin)).setIdentity();
      continue;
    }
    const auto left = left_jacobian<Dim>(interval.horizon * at.velocities.twists[side.body].template tail<turn>());
    const Vec<Dim>& center = at.centers[side.body];
    for (int i = side.begin; i < side.end; ++i) {
      J.template block<Dim, Dim>(Dim * i, begin).setIdentity();
      for (int k = 0; k < turn; ++k)
        J.template block<Dim, 1>(Dim * i, begin + Dim + k) = turned<Dim>(Turn<Dim>(left.col(k)), x[i] - center);
    }
    turns.template block<turn, turn>(begin + Dim, begin + Dim) =
        left.transpose() * turning<Dim>(side, center, x, energy.gradient) * left;
  }
  const Eigen::Map<const Eigen::Matrix<double, 4 * Dim, 1>> forces(energy.gradient.data());
  return {J.transpose() * forces, J.transpose() * energy.hessian * J + turns};
}

template <int Dim>
typename PairDofs<Dim>::SlipDerivative slip_derivative(const FrictionPoint<Dim>& f, const PairDofs<Dim>& dofs) {
  typename PairDofs<Dim>::SlipDerivative r(dofs.count, Dim - 1);
  const auto sides = sides_of<Dim>(f.pair);
  for (int s = 0; s < 2; ++s) {
    if (sides[s].body < 0) continue;
    const int begin = dofs.begin[s], sign = s == 0 ? 1 : -1;
    const bool deforms = s == 0 ? f.first_deforms : f.second_deforms;
    for (int k = 0; k < Dim - 1; ++k) {
      const Vec<Dim> t = f.tangent.col(k);
      for (int i = sides[s].begin; deforms && i < sides[s].end; ++i)
        r.template block<Dim, 1>(begin + Dim * (i - sides[s].begin), k) = f.weight[i] * t;
      if (deforms) continue;
      r.template block<Dim, 1>(begin, k) = sign * t;
      r.template block<turn_size<Dim>, 1>(begin + Dim, k) = sign * moment<Dim>(s == 0 ? f.arm_first : f.arm_second, t);
    }
  }
  return r;
}

#define SEICHE_INSTANTIATE(Dim)                                                                                        \
  template PairDofs<Dim> pair_dofs<Dim>(const ContactScene<Dim>::Data&, const Interval<Dim>&, const Candidate&);       \
  template PairTerms<Dim> pair_terms<Dim>(const ContactScene<Dim>::Data&, const Interval<Dim>&, const Placement<Dim>&, \
                                          const Candidate&, const PairDofs<Dim>&, const PairPoints<Dim>&,              \
                                          const PairEnergy<Dim>&);                                                     \
  template PairDofs<Dim>::SlipDerivative slip_derivative<Dim>(const FrictionPoint<Dim>&, const PairDofs<Dim>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)
#undef SEICHE_INSTANTIATE

}  // namespace seiche::contact
