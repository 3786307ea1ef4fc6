#include "coupling/exterior/exteriors.h"

namespace seiche {

template <int Dim>
OwnedExterior<Dim> make_exterior(const Fluids& fluids, const Domain<Dim>& domain) {
  if (fluids.has_gas()) return OwnedExterior<Dim>(flowing_gas<Dim>());
  if (fluids.keeps_air()) return OwnedExterior<Dim>(enclosed_air(domain));
  return {};
}

template OwnedExterior<2> make_exterior<2>(const Fluids&, const Domain<2>&);
template OwnedExterior<3> make_exterior<3>(const Fluids&, const Domain<3>&);

}  // namespace seiche
