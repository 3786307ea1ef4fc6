#include "coupling/thin/thin_solids.h"

#include "coupling/geometry/placed_solid.h"
#include "coupling/state/solids.h"
#include "fluid/boundary/domain.h"
#include "grid/loops.h"
#include "levelset/redistance.h"

namespace seiche {
namespace {

// Least |phi| (cells) of a cell that is made wet or dry.
constexpr double least_distance = 0.1;

struct Near {
  bool wet = false, dry = false;
};

// Phases in the cells around x that the thin body does not separate from x.
template <int Dim>
Near find_near(const Domain<Dim>& domain, const CellField<Dim>& phi, const PlacedSolid<Dim>& solid, const Vec<Dim>& x) {
  const Geometry<Dim>& g = domain.layout.geometry();
  constexpr int neighbours = Dim == 2 ? 9 : 27;
  Near near;
  for (int n = 0; n < neighbours && !(near.wet && near.dry); ++n) {
    IVec<Dim> i;
    bool within = true;
    for (int a = 0, left = n; a < Dim; ++a, left /= 3) {
      i[a] = int(std::floor((x[a] - g.lower[a]) / g.h)) + left % 3 - 1;
      within = within && (g.periodic[a] || (i[a] >= 0 && i[a] < g.cells[a]));
    }
    if (!within || !domain.layout.padded().contains(i)) continue;
    bool& present = phi[domain.layout.site(i)] < 0 ? near.wet : near.dry;
    present = present || !solid.lies_between(x, domain.layout.position(i, cell_offset<Dim>()));
  }
  return near;
}

template <int Dim>
struct ThinSolids {
  const Domain<Dim>& domain;
  const Solids<Dim>& solids;
  const CellField<Dim>& known;  // phi before, with what sources bring
  const StepGeometry<Dim>& g;
  std::vector<std::unique_ptr<PlacedSolid<Dim>>> now, earlier;  // null: not thin
  FaceField<Dim, char> sealed{domain.layout, 0};

  ThinSolids(const Domain<Dim>& on, const Solids<Dim>& all, const std::vector<Placement>& placed,
             const CellField<Dim>& phi, const StepGeometry<Dim>& geometry)
      : domain(on), solids(all), known(phi), g(geometry) {
    for (const SealedFace& f : g.sealed) sealed.at(f.axis, f.face) = 1;
    for (std::size_t k = 0; k < solids.bodies.size(); ++k) {
      now.push_back(place(k, g.placed[k]));
      earlier.push_back(place(k, placed[k]));
    }
  }

  std::unique_ptr<PlacedSolid<Dim>> place(std::size_t k, const Placement& placed) const {
    if (!solids.bodies[k].is_thin()) return nullptr;
    return place_solid(domain.layout, solids.bodies[k], placed);
  }

  // phi of a cell beside body k, its sign corrected to a phase that its own side held before.
  double allowed(int k, Site cell, double phi) const {
    const PlacedSolid<Dim>&solid = *now[std::size_t(k)], &then = *earlier[std::size_t(k)];
    const Vec<Dim> x = domain.layout.position(domain.layout.index(cell), cell_offset<Dim>());
    const double distance = solid.distance(x), least = std::max(distance, least_distance * domain.layout.h());
    if (distance <= 0) return phi;
    const Near near = find_near(domain, known, then, solid.carried_to(then, x));
    if (!near.wet && !near.dry) return phi;  // no cell tells: outside of the domain, or walled in
    if (phi < 0 && !near.wet) return least;
    if (phi >= 0 && !near.dry) return -least;
    return phi;
  }

  // phi of wet cell `wet` beside sealed face f, dry across it, or of the cell behind if that is deeper. `away`:
  // direction away from the face, +-1.
  double as_behind(const CellField<Dim>& phi, const SealedFace& f, Site wet, int away) const {
    const Site d = away * domain.layout.stride(f.axis), between = away > 0 ? wet + d : wet;
    return sealed.at(f.axis, between) ? phi[wet] : std::min(phi[wet], phi[wet + d]);
  }

  bool has_wet_neighbour(const CellField<Dim>& phi, Site cell) const {
    bool any = false;
    for_each_face_of(domain.layout, cell, [&](int a, Site face, int, Site across) {
      any = any || (!sealed.at(a, face) && phi[across] < 0);
    });
    return any;
  }
};

}  // namespace

template <int Dim>
bool has_thin(const Solids<Dim>& solids) {
  return std::any_of(solids.bodies.begin(), solids.bodies.end(), [](const Body<Dim>& b) { return b.is_thin(); });
}

template <int Dim>
void keep_sides_apart(const Domain<Dim>& domain, const Solids<Dim>& solids, const std::vector<Placement>& placed,
                      const CellField<Dim>& known_phi, const StepGeometry<Dim>& g, CellField<Dim>& phi) {
  if (!has_thin(solids)) return;
  const ThinSolids<Dim> thin(domain, solids, placed, known_phi, g);
  const auto for_both_cells = [&](const SealedFace& f, const auto& visit) {
    const Site low = f.face - domain.layout.stride(f.axis);
    if (domain.layout.cells().contains(domain.layout.index(low))) visit(low, f.face, -1);
    if (domain.layout.cells().contains(domain.layout.index(f.face))) visit(f.face, low, 1);
  };
  for (const SealedFace& f : g.sealed)
    for_both_cells(f, [&](Site c, Site, int) { phi[c] = thin.allowed(f.body, c, phi[c]); });
  fill_level_set_ghosts(domain.layout, domain.halo, phi);
  const CellField<Dim> known = phi;
  for (const SealedFace& f : g.sealed)
    for_both_cells(f, [&](Site c, Site across, int away) {
      if (known[c] < 0 && known[across] >= 0) phi[c] = std::min(phi[c], thin.as_behind(known, f, c, away));
      if (known[c] >= 0 && known[across] < 0 && !thin.has_wet_neighbour(known, c))
        phi[c] = std::max(phi[c], -thin.as_behind(known, f, across, -away));
    });
  fill_level_set_ghosts(domain.layout, domain.halo, phi);
}

template bool has_thin<2>(const Solids<2>&);
template void keep_sides_apart<2>(const Domain<2>&, const Solids<2>&, const std::vector<Placement>&,
                                  const CellField<2>&, const StepGeometry<2>&, CellField<2>&);
template bool has_thin<3>(const Solids<3>&);
template void keep_sides_apart<3>(const Domain<3>&, const Solids<3>&, const std::vector<Placement>&,
                                  const CellField<3>&, const StepGeometry<3>&, CellField<3>&);

}  // namespace seiche
