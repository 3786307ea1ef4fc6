#pragma once
// What the ways to solve a step have in common.
#include "coupling/solve/coupled_solve.h"
#include "coupling/solve/solids_minimum.h"

namespace seiche {

// The pressure's part of the problem.
template <int Dim>
struct PressureProblem {
  NullSpace closed;
  DistributedMatrix A;
  RowGrid grid;

  PressureProblem(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows)
      : closed(find_closed_components(in, rows)), A(assemble_pressure_matrix(in, rows)), grid(row_grid(in, rows)) {}
};

// Throw Error(cannot_continue) where a closed, full container cannot do what is asked of it: in components that bodies
// cannot make up for, before the solve; in chambers that bodies close off, which are no null space one by one but
// together may be, after it.
template <int Dim>
void refuse_impossible_motion(const CoupledInput<Dim>& input, const PressureProblem<Dim>& liquid,
                              const std::vector<int>& sensed, const CoupledSolution<Dim>& r);
template <int Dim>
void refuse_unbalanced_chambers(const CoupledInput<Dim>& input, const PressureProblem<Dim>& liquid,
                                const std::vector<int>& sensed, const CoupledSolution<Dim>& r);

// The first guess, in the order of the rows.
template <int Dim>
Vector guessed_pressure(const CoupledInput<Dim>& input, const PressureRows<Dim>& rows);

// Finds the velocities of the bodies and takes them and the counts over. Returns the velocities.
template <int Dim>
Eigen::VectorXd find_minimum(const CoupledInput<Dim>& input, const SolidCoupling<Dim>& coupling,
                             CoupledProblem<Dim>& problem, const InviscidLiquid<Dim>& inviscid,
                             CoupledSolution<Dim>& r);

// Into the field, ghosts filled.
template <int Dim>
void set_pressure(const CoupledInput<Dim>& input, const Vector& p, CoupledSolution<Dim>& r);

}  // namespace seiche
