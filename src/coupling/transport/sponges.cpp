#include "coupling/transport/sponges.h"

#include <fmt/format.h>

#include <cmath>

#include "base/domain_spec.h"
#include "base/error.h"
#include "coupling/transport/formula_checks.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// "" or the fault of a sponge at a point.
std::string fault_of_sponge(std::size_t index, double rate, double velocity, const Vec3& x, double t) {
  if (rate >= 0 && std::isfinite(rate) && std::isfinite(velocity)) return {};
  return fmt::format("liquid.sponge.{}: {} at ({:g}, {:g}, {:g}) and t = {:g} s", index,
                     rate < 0 ? "the rate is negative" : "rate or velocity is not finite", x[0], x[1], x[2], t);
}

}  // namespace

std::vector<Sponge> make_sponges(const LiquidSpec& liquid, const DomainSpec& domain) {
  std::vector<Sponge> sponges;
  for (const SpongeSpec& spec : liquid.sponges) {
    Sponge sponge{spec, Expression(spec.rate), VectorExpression(spec.velocity)};
    if (sponge.rate.is_constant()) sponge.steady_rate = sponge.rate(Vec3::Zero(), 0);
    if (sponge.velocity.is_constant()) sponge.steady_velocity = sponge.velocity(Vec3::Zero(), 0);
    if (spec.side) {
      sponge.axis = (*spec.side)[0] - 'x';
      const bool upper = spec.side->ends_with("upper");
      sponge.outer = (upper ? domain.upper : domain.lower)[sponge.axis];
      sponge.inner = sponge.outer + (upper ? -*spec.length : *spec.length);
    }
    sponges.push_back(std::move(sponge));
  }
  return sponges;
}

// Formulas are evaluated in order: two threads must not use one at once.
template <int Dim>
void absorb(const Domain<Dim>& domain, const std::vector<Sponge>& sponges, const Vec3& gravity, double t, double dt,
            FaceField<Dim>& u) {
  std::string fault;
  for (std::size_t k = 0; k < sponges.size(); ++k)
    for (int a = 0; a < Dim; ++a)
      for_each_index_in_order(domain.layout, domain.layout.faces(a), [&](Site f, const IVec<Dim>& i) {
        const Vec3 x = extend<Dim>(domain.layout.position(i, face_offset<Dim>(a)));
        const double rate = sponges[k].rate_at(x, t);
        if (rate == 0) return;
        const double v = sponges[k].velocity_at(a, x, t), fall = dt * gravity[a];
        if (fault.empty()) fault = fault_of_sponge(k, rate, v, x, t);
        u.at(a, f) = fall + v + std::exp(-rate * dt) * (u.at(a, f) - fall - v);
      });
  fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, u);
  if (!domain.ranks.any(!fault.empty())) return;
  for (const std::string& text : domain.ranks.all_gather(fault))
    if (!text.empty()) throw Error(ExitCode::cannot_continue, text);
}

template void absorb<2>(const Domain<2>&, const std::vector<Sponge>&, const Vec3&, double, double, FaceField<2>&);
template void absorb<3>(const Domain<3>&, const std::vector<Sponge>&, const Vec3&, double, double, FaceField<3>&);

}  // namespace seiche
