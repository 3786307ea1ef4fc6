#include "fluid/boundary/domain.h"

#include "base/domain_spec.h"

namespace seiche {
namespace {

constexpr int reach_of_stencils = 3;  // cells; four-point interpolation and one-sided slopes

template <int Dim>
Geometry<Dim> grid_geometry(const DomainSpec& spec) {
  Geometry<Dim> g;
  g.lower = truncate<Dim>(spec.lower);
  g.h = spec.cell_size;
  for (int a = 0; a < Dim; ++a) {
    g.cells[a] = spec.cells[a];
    g.periodic[a] = spec.sides[a][0].type == SideType::periodic;
  }
  return g;
}

}  // namespace

template <int Dim>
Domain<Dim>::Domain(const DomainSpec& spec, WallFlow flow, int reach, const Communicator& r,
                    std::vector<Box<Dim>> chosen, const Vec3& gravity)
    : ranks(r),
      blocks(chosen.empty() ? partition(grid_geometry<Dim>(spec), r.size()) : std::move(chosen)),
      layout(grid_geometry<Dim>(spec), blocks[std::size_t(r.rank())], reach + reach_of_stencils),
      halo(layout, blocks, r),
      sides(spec, flow, gravity) {}

template struct Domain<2>;
template struct Domain<3>;

}  // namespace seiche
