#include "coupling/transport/formula_checks.h"

#include <fmt/format.h>

#include "base/domain_spec.h"
#include "base/error.h"
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/source.h"
#include "coupling/transport/liquid_viscosity.h"
#include "coupling/transport/sources.h"
#include "fluid/boundary/domain.h"
#include "grid/domain_faces.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Names a value that is not finite at a face of a side at time t; else empty. Checks all components, also those that do
// not act on the flow.
template <int Dim>
std::string fault_at_side(const Domain<Dim>& domain, const DomainSpec& extent, int axis, int side, const Vec<Dim>& x,
                          double t) {
  const SideSpec& spec = extent.sides[axis][side];
  const auto key = [&] { return fmt::format("domain.boundary.{}_{}", "xyz"[axis], side == 0 ? "lower" : "upper"); };
  if (domain.sides.is_outflow(axis, side)) {
    const double p = domain.sides.pressure(axis, side, x, t);
    return std::isfinite(p) ? "" : not_finite_text<Dim>(key() + ".pressure", spec.pressure, p, x, t);
  }
  for (int c = 0; c < Dim; ++c) {
    const double v = domain.sides.velocity(axis, side, c, x, t);
    if (!std::isfinite(v) && spec.type == SideType::waves)
      return fmt::format("{}.waves: the velocity of the waves at {} is not finite at t = {:g} s", key(),
                         place_text<Dim>(x), t);
    if (!std::isfinite(v))
      return not_finite_text<Dim>(fmt::format("{}.velocity[{}]", key(), c), spec.velocity[c], v, x, t);
  }
  return {};
}

// First fault of this rank on faces of the sides that solids leave open.
template <int Dim>
std::string fault_of_sides(const Domain<Dim>& domain, const DomainSpec& extent, const StepGeometry<Dim>& g, double t) {
  std::string fault;
  for (int a = 0; a < Dim; ++a)
    for (int side = 0; side < 2; ++side) {
      const SideType type = domain.sides.type(a, side);
      if (type != SideType::inflow && type != SideType::moving_wall && type != SideType::outflow &&
          type != SideType::waves)
        continue;
      for_each_index_in_order(domain.layout, faces_of_side(domain.layout, a, side), [&](Site f, const IVec<Dim>& i) {
        if (fault.empty() && g.faces.kind_at(a, f) != FaceKind::closed)
          fault = fault_at_side<Dim>(domain, extent, a, side, domain.layout.position(i, face_offset<Dim>(a)), t);
      });
    }
  return fault;
}

template <int Dim>
std::string fault_of_motions(const Solids<Dim>& solids, const StepGeometry<Dim>& g, double t) {
  for (std::size_t k = 0; k < solids.bodies.size(); ++k) {
    const Twist& v = g.placed[k].twist;
    if (!v.linear.allFinite() || !v.angular.allFinite() || !v.about.allFinite())
      return fmt::format("solid '{}': its motion is not finite at t = {:g} s", solids.bodies[k].spec().name, t);
  }
  return {};
}

void stop_where_any(const Communicator& ranks, const std::string& mine, double t0, double t1) {
  const std::string text = first_text(ranks, mine);
  if (text.empty()) return;
  throw Error(ExitCode::cannot_continue, fmt::format("step of {:.6g} s at time {:.6g} s: {}", t1 - t0, t0, text));
}

}  // namespace

template <int Dim>
std::string place_text(const Vec<Dim>& x) {
  std::string place = fmt::format("({:g}", x[0]);
  for (int a = 1; a < Dim; ++a) place += fmt::format(", {:g}", x[a]);
  return place + ")";
}

template <int Dim>
std::string not_finite_text(const std::string& key, const Formula& formula, double value, const Vec<Dim>& x, double t) {
  return fmt::format("{} = \"{}\" is {} at {}, t = {:g} s; it must be a finite number there", key, formula,
                     std::isnan(value) ? "nan" : "infinite", place_text<Dim>(x), t);
}

std::string first_text(const Communicator& ranks, const std::string& mine) {
  if (!ranks.any(!mine.empty())) return {};
  for (const std::string& text : ranks.all_gather(mine))
    if (!text.empty()) return text;
  return {};
}

template <int Dim>
void check_formulas_at_start(const Domain<Dim>& domain, const Fluids& fluids, const std::vector<Source<Dim>>& sources,
                             const DomainSpec& extent, const StepGeometry<Dim>& g, const std::string& fault) {
  std::string mine = fault.empty() ? fluids.gravity.fault(0) : fault;
  if (mine.empty()) mine = fault_of_sides(domain, extent, g, 0);
  if (mine.empty()) mine = fault_of_viscosity(domain, fluids, 0);
  for (std::size_t k = 0; mine.empty() && k < sources.size(); ++k)
    mine = fault_of_source(domain, sources, k, std::max(0.0, sources[k].spec.from));
  if (const std::string text = first_text(domain.ranks, mine); !text.empty()) throw Error(ExitCode::bad_input, text);
}

template <int Dim>
void check_forces_of_step(const Domain<Dim>& domain, const Fluids& fluids, const std::vector<Source<Dim>>& sources,
                          double t0, double t1) {
  std::string mine = fluids.gravity.fault(0.5 * (t0 + t1));
  if (mine.empty()) mine = fluids.gravity.fault(t1);
  if (mine.empty()) mine = fault_of_viscosity(domain, fluids, t1);
  for (std::size_t k = 0; mine.empty() && k < sources.size(); ++k)
    if (const auto open = open_in_step(sources[k].spec, t0, t1))
      mine = fault_of_source(domain, sources, k, open->begin);
  stop_where_any(domain.ranks, mine, t0, t1);
}

template <int Dim>
void check_geometry_of_step(const Domain<Dim>& domain, const Solids<Dim>& solids, const DomainSpec& extent,
                            const StepGeometry<Dim>& g, double t0, double t1) {
  const std::string motion = fault_of_motions(solids, g, t1);
  stop_where_any(domain.ranks, motion.empty() ? fault_of_sides(domain, extent, g, t1) : motion, t0, t1);
}

#define SEICHE_INSTANTIATE(D)                                                                                   \
  template std::string place_text<D>(const Vec<D>&);                                                            \
  template std::string not_finite_text<D>(const std::string&, const Formula&, double, const Vec<D>&, double);   \
  template void check_formulas_at_start<D>(const Domain<D>&, const Fluids&, const std::vector<Source<D>>&,      \
                                           const DomainSpec&, const StepGeometry<D>&, const std::string&);      \
  template void check_forces_of_step<D>(const Domain<D>&, const Fluids&, const std::vector<Source<D>>&, double, \
                                        double);                                                                \
  template void check_geometry_of_step<D>(const Domain<D>&, const Solids<D>&, const DomainSpec&,                \
                                          const StepGeometry<D>&, double, double);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
