#pragma once
// Kinds of sides of the domain.

namespace seiche {

enum class SideType { free_slip, no_slip, periodic, inflow, outflow, moving_wall, waves };

}  // namespace seiche
