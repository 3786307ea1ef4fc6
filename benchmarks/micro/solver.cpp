// Set-up and solve times of the preconditioners on a full box and on a splash, with a cold start and with a warm one.
//   solver [cells a side ..]            e.g. mpirun -n 2 solver 64 96
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <string>

#include "linalg/krylov/krylov.h"
#include "linalg/precond/hypre_adapter.h"
#include "unit/linalg/cases.h"

using namespace seiche;

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Projected {
  Preconditioner& preconditioner;
  const LinearSystem& system;
  void apply(const Vector& r, Vector& z) {
    preconditioner.apply(r, z);
    system.project(z);
  }
};

struct Timing {
  double system = 0, setup = 0, cold = 0, warm = 0;
  int cold_iterations = 0, warm_iterations = 0;
};

// Cold: x = 0. Warm: from that solution, after a tenth of the right-hand side changed.
template <class Make>
Timing time_solver(const cases::System& s, Make make, const Communicator& ranks) {
  Timing t;
  const double start = now();
  const LinearSystem system(s.A, s.grid, s.null_space, ranks);
  t.system = now() - start;
  const PreconditionerOrFailure made = make(system);
  t.setup = now() - start - t.system;
  if (!made.preconditioner) return t;
  Projected B{*made.preconditioner, system};
  Vector x(s.A.rows(), 0.0), b = cases::noise_vector(s.A, 1), change = cases::noise_vector(s.A, 2);
  system.project(b);
  double before = now();
  t.cold_iterations = conjugate_gradients(system, B, b, x, {1e-8 * norm(b, ranks), 300}, ranks).iterations;
  t.cold = now() - before;
  add_scaled(b, 0.1, change);
  system.project(b);
  before = now();
  t.warm_iterations = conjugate_gradients(system, B, b, x, {1e-8 * norm(b, ranks), 300}, ranks).iterations;
  t.warm = now() - before;
  return t;
}

struct Candidate {
  std::string name;
  PreconditionerOrFailure (*make)(const LinearSystem&);
};

PreconditionerOrFailure amg(const LinearSystem& s, AmgSettings settings) {
  return make_boomeramg(s, settings);
}

std::vector<Candidate> candidates() {
  using System = const LinearSystem&;
  return {
      {"none", [](System s) { return make_preconditioner("none", s); }},
      {"boomeramg", [](System s) { return amg(s, {}); }},
      {"boomeramg relax 8", [](System s) { return amg(s, {.relax_down = 8, .relax_up = 8}); }},
      {"boomeramg relax 18", [](System s) { return amg(s, {.relax_down = 18, .relax_up = 18}); }},
      {"boomeramg relax 6", [](System s) { return amg(s, {.relax_down = 6, .relax_up = 6}); }},
      {"boomeramg PMIS", [](System s) { return amg(s, {.coarsening = 8}); }},
      {"boomeramg aggressive 0", [](System s) { return amg(s, {.aggressive_levels = 0}); }},
      {"boomeramg aggressive 2", [](System s) { return amg(s, {.aggressive_levels = 2}); }},
      {"boomeramg strength 0.1", [](System s) { return amg(s, {.strength = 0.1}); }},
      {"boomeramg strength 0.5", [](System s) { return amg(s, {.strength = 0.5}); }},
      {"boomeramg elements 3", [](System s) { return amg(s, {.elements_per_row = 3}); }},
      {"boomeramg elements 6", [](System s) { return amg(s, {.elements_per_row = 6}); }},
      {"multigrid", [](System s) { return make_pfmg(s); }},
      {"multigrid, every relax", [](System s) { return make_pfmg(s, {.skip_relax = 0}); }},
      {"multigrid Jacobi", [](System s) { return make_pfmg(s, {.relax = 1}); }},
  };
}

// By name, the shapes measured.
std::vector<std::pair<std::string, cases::Poisson>> shapes(int n) {
  using cases::Cell, cases::Kind;
  const std::array<int, 3> size{n, n, n};
  std::vector<std::pair<std::string, cases::Poisson>> all;
  const auto add = [&](const std::string& name, Kind outside) -> cases::Poisson& {
    cases::Poisson p;
    p.size = size;
    p.outside = outside;
    return all.emplace_back(name, p).second;
  };
  add("full box, open", Kind::air);
  add("full box, closed", Kind::wall);
  add("splash", Kind::wall).kind = [size](Cell c) { return cases::splash(size, c); };
  cases::Poisson& cut = add("splash with cut cells and ghost-fluid surface", Kind::wall);
  cut.kind = [size](Cell c) { return cases::splash(size, c); };
  cut.weight = [size](Cell c, int axis) { return cases::cut_weight(size, c, axis); };
  for (const double share : {0.05, 0.1, 0.2, 0.4}) {
    add(fmt::format("pool, {} of the box", share), Kind::wall).kind = [size, share](Cell c) {
      return c[1] + 0.5 < share * size[1] ? Kind::liquid : Kind::air;
    };
  }
  add("pores, a third of the cells solid", Kind::wall).kind = [size](Cell c) {
    return cases::noise(c[0] + 1000 * (c[1] + 1000 * c[2])) < -0.33 ? Kind::wall : Kind::liquid;
  };
  return all;
}

void run(const std::string& shape, const cases::Poisson& p, const Communicator& ranks) {
  const cases::System s = cases::build(p, ranks);
  if (ranks.is_root()) {
    fmt::print("\n{} {}x{}x{}, {} rows, {} ranks\n{:26} {:>7} {:>7} {:>9} {:>9} {:>9} {:>10}\n", shape, p.size[0],
               p.size[1], p.size[2], s.A.global_rows, ranks.size(), "", "system", "set-up", "cold", "warm", "set+warm",
               "rows/s");
  }
  for (const Candidate& c : candidates()) {
    const Timing t = time_solver(s, c.make, ranks);
    const double sum = t.setup + t.warm;
    if (!ranks.is_root()) continue;
    fmt::print("{:26} {:7.3f} {:7.3f} {:5.2f} {:3} {:5.2f} {:3} {:9.3f} {:10.0f}\n", c.name, t.system, t.setup, t.cold,
               t.cold_iterations, t.warm, t.warm_iterations, sum, double(s.A.global_rows) / sum);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const MpiSession session(argc, argv);
  const Communicator ranks;
  for (int i = 1; i < argc; ++i) {
    for (const auto& [name, problem] : shapes(std::stoi(argv[i]))) run(name, problem, ranks);
  }
  return 0;
}
