#pragma once
// Sponges: du/dt = -rate (u - velocity), solved exactly within the step for what the flow carries.
#include <vector>

#include "coupling/state/sponge.h"
#include "fluid/boundary/domain.h"

namespace seiche {

struct LiquidSpec;
struct DomainSpec;

std::vector<Sponge> make_sponges(const LiquidSpec& liquid, const DomainSpec& domain);

// u - dt g := v + exp(-rate dt) (u - dt g - v) on all faces, with the rate and the velocity v at time t, the end of the
// step. Gravity g (m/s^2) stays out: its part of u is balanced by pressure where liquid rests. Throws
// Error(cannot_continue) on all ranks if a rate or a velocity is not finite or a rate is negative. Fills ghosts.
// Collective.
template <int Dim>
void absorb(const Domain<Dim>& domain, const std::vector<Sponge>& sponges, const Vec3& gravity, double t, double dt,
            FaceField<Dim>& u);

}  // namespace seiche
