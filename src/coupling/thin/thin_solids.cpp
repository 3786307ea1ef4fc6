#include "coupling/thin/thin_solids.h"

#include "coupling/geometry/placed_solid.h"
#include "grid/loops.h"
#include "levelset/redistance.h"

namespace seiche {
namespace {

// Cells: how far from the surface a cell counts at least that is made wet or dry.
constexpr double least_distance = 0.1;

struct Near {
  bool wet = false, dry = false;
};

// What stood next to x on its side of a thin body.
template <int Dim>
Near find_near(const Setup<Dim>& s, const CellField<Dim>& phi, const PlacedSolid<Dim>& solid, const Vec<Dim>& x) {
  const Geometry<Dim>& g = s.layout.geometry();
  constexpr int neighbours = Dim == 2 ? 9 : 27;
  Near near;
  for (int n = 0; n < neighbours && !(near.wet && near.dry); ++n) {
    IVec<Dim> i;
    bool within = true;
    for (int a = 0, left = n; a < Dim; ++a, left /= 3) {
      i[a] = int(std::floor((x[a] - g.lower[a]) / g.h)) + left % 3 - 1;
      within = within && (g.periodic[a] || (i[a] >= 0 && i[a] < g.cells[a]));
    }
    if (!within || !s.layout.padded().contains(i)) continue;
    bool& present = phi[s.layout.site(i)] < 0 ? near.wet : near.dry;
    present = present || !solid.lies_between(x, s.layout.position(i, cell_offset<Dim>()));
  }
  return near;
}

template <int Dim>
struct ThinSolids {
  const Setup<Dim>& s;
  const State<Dim>& before;
  const StepGeometry<Dim>& g;
  std::vector<std::unique_ptr<PlacedSolid<Dim>>> now, earlier;  // null: not thin
  FaceField<Dim, char> sealed{s.layout, 0};

  ThinSolids(const Setup<Dim>& setup, const State<Dim>& state, const StepGeometry<Dim>& geometry)
      : s(setup), before(state), g(geometry) {
    for (const SealedFace& f : g.sealed) sealed.at(f.axis, f.face) = 1;
    const std::vector<Placement> placed = place_bodies(s, before);
    for (std::size_t k = 0; k < s.bodies.size(); ++k) {
      now.push_back(place(k, g.placed[k]));
      earlier.push_back(place(k, placed[k]));
    }
  }

  std::unique_ptr<PlacedSolid<Dim>> place(std::size_t k, const Placement& placed) const {
    if (!s.bodies[k].is_thin()) return nullptr;
    return place_solid(s.layout, s.bodies[k], placed);
  }

  // phi of a cell beside body k as its own side allows.
  double allowed(int k, Site cell, double phi) const {
    const PlacedSolid<Dim>&solid = *now[std::size_t(k)], &then = *earlier[std::size_t(k)];
    const Vec<Dim> x = s.layout.position(s.layout.index(cell), cell_offset<Dim>());
    const double distance = solid.distance(x), least = std::max(distance, least_distance * s.layout.h());
    if (distance <= 0) return phi;
    const Near near = find_near(s, before.phi, then, solid.carried_to(then, x));
    if (phi < 0 && !near.wet) return least;
    if (phi >= 0 && !near.dry) return -least;
    return phi;
  }

  // Of a wet cell before face f, dry across it: as deep as the cell behind it.
  double as_behind(const CellField<Dim>& phi, const SealedFace& f, Site wet, int away) const {
    const Site d = away * s.layout.stride(f.axis), between = away > 0 ? wet + d : wet;
    return sealed.at(f.axis, between) ? phi[wet] : std::min(phi[wet], phi[wet + d]);
  }

  bool has_wet_neighbour(const CellField<Dim>& phi, Site cell) const {
    bool any = false;
    for_each_face_of(s.layout, cell, [&](int a, Site face, int, Site across) {
      any = any || (!sealed.at(a, face) && phi[across] < 0);
    });
    return any;
  }
};

}  // namespace

template <int Dim>
void keep_sides_apart(const Setup<Dim>& s, const State<Dim>& before, const StepGeometry<Dim>& g, CellField<Dim>& phi) {
  if (std::none_of(s.bodies.begin(), s.bodies.end(), [](const auto& b) { return b.is_thin(); })) return;
  const ThinSolids<Dim> thin(s, before, g);
  const auto for_both_cells = [&](const SealedFace& f, const auto& visit) {
    const Site low = f.face - s.layout.stride(f.axis);
    if (s.layout.cells().contains(s.layout.index(low))) visit(low, f.face, -1);
    if (s.layout.cells().contains(s.layout.index(f.face))) visit(f.face, low, 1);
  };
  for (const SealedFace& f : g.sealed)
    for_both_cells(f, [&](Site c, Site, int) { phi[c] = thin.allowed(f.body, c, phi[c]); });
  fill_level_set_ghosts(s.layout, s.halo, phi);
  const CellField<Dim> known = phi;
  for (const SealedFace& f : g.sealed)
    for_both_cells(f, [&](Site c, Site across, int away) {
      if (known[c] < 0 && known[across] >= 0) phi[c] = std::min(phi[c], thin.as_behind(known, f, c, away));
      if (known[c] >= 0 && known[across] < 0 && !thin.has_wet_neighbour(known, c))
        phi[c] = std::max(phi[c], -thin.as_behind(known, f, across, -away));
    });
  fill_level_set_ghosts(s.layout, s.halo, phi);
}

template void keep_sides_apart<2>(const Setup<2>&, const State<2>&, const StepGeometry<2>&, CellField<2>&);
template void keep_sides_apart<3>(const Setup<3>&, const State<3>&, const StepGeometry<3>&, CellField<3>&);

}  // namespace seiche
