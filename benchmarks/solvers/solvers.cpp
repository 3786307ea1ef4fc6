// Our multigrid against hypre's on pressure systems: set-up and conjugate gradients from a cold start, on one core.
//   solvers [--only SOLVER] [--problem NAME] [--repeat N] cells a side ..
#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "base/thread_limit.h"
#include "linalg/krylov/krylov.h"
#include "linalg/precond/geometric_multigrid.h"
#include "linalg/precond/hypre_adapter.h"
#include "problems.h"

using namespace seiche;

namespace {

// Seconds of processor: other programs on the machine count less than on the clock at the wall.
double now() {
  return double(std::clock()) / CLOCKS_PER_SEC;
}

double allocated() {
  const auto info = mallinfo2();
  return double(info.uordblks + info.hblkhd);
}

struct Projected {
  Preconditioner& preconditioner;
  const LinearSystem& system;
  void apply(const Vector& r, Vector& z) {
    preconditioner.apply(r, z);
    system.project(z);
  }
};

struct Measured {
  double setup = 1e300, solve = 1e300, bytes = 0;
  int iterations = -1;
};

struct Candidate {
  const char* name;
  PreconditionerOrFailure (*make)(const LinearSystem&);
};

constexpr Candidate candidates[] = {
    {"geometric", [](const LinearSystem& s) { return make_geometric_multigrid(s); }},
    {"PFMG", [](const LinearSystem& s) { return make_pfmg(s); }},
    {"BoomerAMG", [](const LinearSystem& s) { return make_boomeramg(s); }},
};

struct Options {
  std::string only, problem;  // names, or all
  int repeat = 2;
  std::vector<int> sizes;
};

void measure(const LinearSystem& system, const Candidate& candidate, double tolerance, Measured& m) {
  Vector x(std::size_t(system.rows()), 0.0), b(x.size());
  std::uint64_t state = 1;
  for (double& v : b) v = double((state = state * 6364136223846793005ull + 1442695040888963407ull) >> 40) / 8388608 - 1;
  system.project(b);
  const double before = allocated(), start = now();
  const PreconditionerOrFailure made = candidate.make(system);
  const double set_up = now();
  m.bytes = allocated() - before;
  if (!made.preconditioner) return;
  Projected B{*made.preconditioner, system};
  const double target = tolerance * norm(b, system.ranks());
  const KrylovResult result = conjugate_gradients(system, B, b, x, {target, 100}, system.ranks());
  m.setup = std::min(m.setup, set_up - start);
  m.solve = std::min(m.solve, now() - set_up);
  Vector r(b.size());
  system.residual(b, x, r);
  const bool solved = result.failure.empty() && norm(r, system.ranks()) < 1.05 * target;
  m.iterations = solved ? result.iterations : -result.iterations;
}

void run(const problems::Problem& problem, const Options& options) {
  const problems::System s = problems::build(problem);
  const Communicator ranks;
  const LinearSystem system(s.A, s.grid, s.null_space, ranks);
  const double rows = double(system.rows()), cells = double(box_of_rows(system).cells());
  for (const double tolerance : {1e-6, 1e-10}) {
    std::vector<Measured> all(std::size(candidates));
    for (int n = 0; n < options.repeat; ++n)
      for (std::size_t c = 0; c < all.size(); ++c)
        if (options.only.empty() || options.only == candidates[c].name)
          measure(system, candidates[c], tolerance, all[c]);
    for (std::size_t c = 0; c < all.size(); ++c) {
      if (all[c].iterations == -1 && all[c].setup > 1e100) continue;
      const double sum = all[c].setup + all[c].solve, ours = all[0].setup + all[0].solve;
      fmt::print("{:14} {:3}x{:3}x{:3} {:9.0f} {:6.0e} {:10} {:4} {:7.3f} {:7.3f} {:6.2f} {:6.2f} {:6.0f}\n",
                 problem.name, problem.cells[0], problem.cells[1], problem.cells[2], rows, tolerance,
                 candidates[c].name, all[c].iterations, all[c].setup, all[c].solve, 1e-6 * rows / sum, sum / ours,
                 all[c].bytes / cells);
    }
    std::fflush(stdout);
  }
}

Options parse(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--only")
      o.only = argv[++i];
    else if (word == "--problem")
      o.problem = argv[++i];
    else if (word == "--repeat")
      o.repeat = std::atoi(argv[++i]);
    else
      o.sizes.push_back(std::atoi(word.c_str()));
  }
  return o;
}

}  // namespace

int main(int argc, char** argv) {
  const MpiSession session(argc, argv);
  const ThreadLimit one(1);
  const Options options = parse(argc, argv);
  fmt::print("{:14} {:>11} {:>9} {:>6} {:10} {:>4} {:>7} {:>7} {:>6} {:>6} {:>6}\n", "problem", "cells", "rows", "tol",
             "", "iter", "set-up", "solve", "M/s", "ratio", "B/cell");
  for (const int n : options.sizes) {
    const std::array<int, 3> cube{n, n, n};
    using namespace problems;
    for (const Problem& p : {sloping_surface(cube), with_balls(sloping_surface(cube), 20, 0.08), drop_in_gas(cube),
                             with_balls(drop_in_gas(cube), 20, 0.08), with_balls(full_box(cube), 20, 0.1),
                             with_pores(full_box(cube)), with_balls(full_box({n, n, 1}), 200, 0.02)})
      if (options.problem.empty() || options.problem == p.name) run(p, options);
  }
  return 0;
}
