#include "coupling/solids/prescribed_loads.h"

#include "coupling/geometry/seams.h"
#include "coupling/solids/surface_load.h"
#include "coupling/state/dry.h"

namespace seiche {
namespace {

constexpr double touching = 1e-2;  // cells: no liquid between surfaces that are nearer to each other

template <int Dim>
Vec<Dim> center_of_cell(const Domain<Dim>& domain, Site cell) {
  return domain.layout.position(domain.layout.index(cell), cell_offset<Dim>());
}

template <int Dim>
bool is_counted(const Body<Dim>& body) {
  return !body.is_free() && !body.deforms() && !body.is_thin();
}

// Surroundings of a solid, summed over the ranks: cells with liquid, with gas that has a pressure, with nothing; the
// area of its exposed pieces and their area vector, m^(Dim-1).
template <int Dim>
struct Beside {
  Eigen::Matrix<double, 4 + Dim, 1> sums = Eigen::Matrix<double, 4 + Dim, 1>::Zero();

  double& liquid() { return sums[0]; }
  double& gas() { return sums[1]; }
  double& nothing() { return sums[2]; }
  double& area() { return sums[3]; }
  // True if one fluid surrounds it.
  bool is_surrounded() const {
    constexpr double rounding = 1e-9;
    return sums[2] == 0 && (sums[0] == 0 || sums[1] == 0) && sums.template tail<Dim>().norm() <= rounding * sums[3];
  }
};

// A linear pressure: value + slope.(x - at).
template <int Dim>
struct LinearPressure {
  double value = 0;
  Vec<Dim> slope, at;
  double operator()(const Vec<Dim>& x) const { return value + slope.dot(x - at); }
};

// The part of a segment or convex polygon where p is positive.
template <int Dim>
std::vector<Vec<Dim>> positive_part(const std::vector<Vec<Dim>>& corners, const LinearPressure<Dim>& p) {
  std::vector<Vec<Dim>> part;
  for (std::size_t n = 0; n < corners.size(); ++n) {
    const double here = p(corners[n]);
    if (here >= 0) part.push_back(corners[n]);
    if (Dim == 2 && n + 1 == corners.size()) break;
    const Vec<Dim>& next = corners[(n + 1) % corners.size()];
    const double there = p(next);
    if (here * there < 0) part.push_back(corners[n] + here / (here - there) * (next - corners[n]));
  }
  return part;
}

// Load of a pressure on the faces that a solid closes: F = sum_f s A (p_low - p_high) e_f. This rank's part.
template <int Dim, class Pressure>
SolidLoad load_on_faces(const Domain<Dim>& domain, const FaceShares& shares, const Vec3& about, const Pressure& p) {
  const Layout<Dim>& l = domain.layout;
  SolidLoad load;
  for (const FaceShare& share : shares) {
    IVec<Dim> cell = l.index(share.face);
    const Vec3 arm = extend<Dim>(l.position(cell, face_offset<Dim>(share.axis))) - about;
    const double area = share.closed * l.geometry().face_area();
    for (const int side : {-1, 1}) {  // the cell above, then the cell below
      if (l.cells().contains(cell)) {
        const Site c = l.site(cell);
        const Vec3 force =
            side * area * p(c, center_of_cell(domain, c)) * extend<Dim>(Vec<Dim>(Vec<Dim>::Unit(share.axis)));
        load.force += force;
        load.torque += arm.cross(force);
      }
      cell[share.axis] -= 1;
    }
  }
  return load;
}

template <int Dim>
std::vector<PlacedPiece<Dim>> placed_pieces(const Domain<Dim>& domain, const SurfaceMesh& surface,
                                            const std::vector<Vec<Dim>>& points) {
  std::vector<PlacedPiece<Dim>> pieces;
  for (const FacetPiece<Dim>& piece :
       cut_at_cells(domain.layout.geometry(), domain.layout.grown(reach_of_pieces), surface, points)) {
    PlacedPiece<Dim> placed{piece.cell, piece.normal, corners_of(piece, surface, points)};
    for_each_point_on(placed.corners, [&](const auto&, double weight) { placed.area += weight; });
    pieces.push_back(std::move(placed));
  }
  return pieces;
}

// Drops pieces of solid k that another solid n covers, of those with covers(n). pose(n): its pose.
template <int Dim, class Covers, class Poses>
void drop_covered(double h, const std::vector<Body<Dim>>& bodies, int k, const Covers& covers, const Poses& pose,
                  std::vector<PlacedPiece<Dim>>& pieces) {
  for (std::size_t n = 0; n < bodies.size() && !pieces.empty(); ++n) {
    if (int(n) == k || !covers(int(n))) continue;
    const Pose there = pose(int(n));
    const auto covered = [&](const PlacedPiece<Dim>& piece) {
      Vec<Dim> middle = Vec<Dim>::Zero();
      for (const Vec<Dim>& corner : piece.corners) middle += corner / double(piece.corners.size());
      return bodies[n].distance_in(there, middle) < touching * h;
    };
    pieces.erase(std::remove_if(pieces.begin(), pieces.end(), covered), pieces.end());
  }
}

// Inputs of the loads of all solids.
template <int Dim>
class PrescribedLoads {
 public:
  PrescribedLoads(const Setup<Dim>& setup, const StepGeometry<Dim>& geometry, const State<Dim>& state)
      : setup_(setup),
        domain_(setup.domain),
        fluids_(setup.fluids),
        solids_(setup.solids),
        geometry_(geometry),
        state_(state),
        gravity_(setup.fluids.gravity.of_step(state.time, state.dt_now)),
        seen_(setup.solids.bodies.size()),
        open_(open_cells(setup.domain, geometry.faces)) {}

  // Finds the pieces of solid k that count, and what lies beside it on this rank.
  Beside<Dim> look(int k) {
    Beside<Dim> b;
    Seen& seen = seen_.at(std::size_t(k));
    const Body<Dim>& body = solids_.bodies[std::size_t(k)];
    if (!is_counted(body)) return b;
    const std::vector<Vec<Dim>> points = placed_points<Dim>(body.contact_surface(), pose_at_solve(k));
    seen.counts = domain_touches(points) && !crosses_periodic_side(points);
    if (!seen.counts) return b;
    find_pieces(k, points, seen);
    for (const auto& [cell, piece] : seen.acted_on) {
      b.area() += piece->area;
      b.sums.template tail<Dim>() += piece->area * piece->normal;
    }
    load_on_faces(domain_, *geometry_.shares[std::size_t(k)], Vec3(0, 0, 0), [&](Site c, const auto&) {
      if (open_[c]) (state_.pressure[c] == 0 ? b.nothing() : state_.phi[c] < 0 ? b.liquid() : b.gas()) += 1;
      return 0.0;
    });
    return b;
  }

  // This rank's part.
  SolidLoad of(int k, const Beside<Dim>& beside) const {
    if (!seen_[std::size_t(k)].counts) return {};
    const FaceShares& shares = *geometry_.shares[std::size_t(k)];
    const Vec3 about = geometry_.pivots[std::size_t(k)];
    if (!beside.is_surrounded())
      return less(on_pieces(k, [&](Site c) { return near_cell(c); }),
                  load_on_faces(domain_, shares, about, [&](Site c, const auto&) { return state_.pressure[c]; }));
    const LinearPressure<Dim> p{0, pull_at(about), truncate<Dim>(about)};
    const auto weighted = [&](Site c) { return LinearPressure<Dim>{0, density(c) * p.slope, p.at}; };
    return less(on_pieces(k, [&](Site c) { return std::pair(weighted(c), false); }),
                load_on_faces(domain_, shares, about, [&](Site c, const Vec<Dim>& x) { return weighted(c)(x); }));
  }

 private:
  // Pieces of a solid's surface on which this rank's cells act. `own`: those of the step, where still_pieces do not do.
  struct Seen {
    bool counts = false;
    std::vector<PlacedPiece<Dim>> own;
    std::vector<std::pair<Site, const PlacedPiece<Dim>*>> acted_on;
  };

  // Pose at the last solve.
  Pose pose_at_solve(int k) const {
    const Body<Dim>& body = solids_.bodies[std::size_t(k)];
    return body.is_prescribed() ? body.pose(state_.time - state_.since_solve) : geometry_.placed[std::size_t(k)].pose;
  }

  double density(Site c) const {
    return state_.pressure[c] == 0 ? 0 : state_.phi[c] < 0 ? fluids_.density() : fluids_.gas_density();
  }
  // Gravity and fields, m/s^2.
  Vec<Dim> pull_at(const Vec3& x) const {
    return truncate<Dim>(pull_on_liquid(gravity_, setup_.forces, x, state_.time - 0.5 * state_.dt_now));
  }
  static SolidLoad less(const SolidLoad& a, const SolidLoad& b) { return {a.force - b.force, a.torque - b.torque}; }

  // The pressure p_c + rho g.(x - x_c) near a cell, and true if it ends where it is 0. Cells that the surface crosses
  // may have no pressure: that of the neighbour deepest in the liquid goes on.
  std::pair<LinearPressure<Dim>, bool> near_cell(Site c) const {
    Site wet = c;
    bool surface = state_.pressure[c] == 0;
    for_each_face_of(domain_.layout, c, [&](int, Site, int, Site next) {
      surface = surface || state_.pressure[next] == 0;
      if (state_.pressure[c] == 0 && state_.pressure[next] != 0 && state_.phi[next] < state_.phi[wet]) wet = next;
    });
    const Vec<Dim> center = center_of_cell(domain_, wet);
    return {{state_.pressure[wet], density(wet) * pull_at(extend<Dim>(center)), center},
            surface && std::abs(state_.phi[wet]) < 1.5 * domain_.layout.h()};
  }

  bool domain_touches(const std::vector<Vec<Dim>>& points) const {
    Eigen::AlignedBox<double, Dim> box, domain;
    for (const Vec<Dim>& x : points) box.extend(x);
    const Geometry<Dim>& g = domain_.layout.geometry();
    domain.extend(g.lower).extend(g.lower + g.h * g.cells.template cast<double>());
    return !points.empty() && domain.intersects(box);
  }

  // True if solid n may touch a surface with these points.
  bool near(const std::vector<Vec<Dim>>& points, int n) const {
    const double slack = domain_.layout.h();
    Eigen::AlignedBox<double, Dim> box;
    for (const Vec<Dim>& x : points) box.extend(x);
    const Eigen::AlignedBox<double, Dim> other =
        placed_box(solids_.bodies[std::size_t(n)], {pose_at_solve(n), {}, {}, {}});
    return other.isEmpty() || box.exteriorDistance(other) < slack;
  }

  // Pieces beyond a periodic side have no cell.
  bool crosses_periodic_side(const std::vector<Vec<Dim>>& points) const {
    Geometry<Dim> open_ends = domain_.layout.geometry();
    for (int a = 0; a < Dim; ++a)
      if (!open_ends.periodic[a]) {
        constexpr int far = 1 << 24;
        open_ends.lower[a] -= far * open_ends.h;
        open_ends.cells[a] = 2 * far;
      }
    return !lies_within(open_ends, points, reach_of_pieces);
  }

  // pressure_of(cell): a LinearPressure, and true if only its positive part acts.
  template <class Pressures>
  SolidLoad on_pieces(int k, const Pressures& pressure_of) const {
    const double ratio = solids_.bodies[std::size_t(k)].facet_ratio();
    const Vec3 about = geometry_.pivots[std::size_t(k)];
    SolidLoad load;
    for (const auto& [cell, piece] : seen_[std::size_t(k)].acted_on) {
      const auto [p, ends_at_surface] = pressure_of(cell);
      if (p.value == 0 && p.slope.isZero(0)) continue;
      const auto add = [&, &p = p, &piece = piece](const Vec<Dim>& x, double weight) {
        const Vec3 force = -ratio * p(x) * weight * extend<Dim>(piece->normal);
        load.force += force;
        load.torque += (extend<Dim>(x) - about).cross(force);
      };
      if (!ends_at_surface)
        for_each_point_on(piece->corners, add);
      else if (const auto part = positive_part(piece->corners, p); part.size() >= Dim)
        for_each_point_on(part, add);
    }
    return load;
  }

  // Finds the pieces that no other prescribed solid covers, and the cells that act on them.
  void find_pieces(int k, const std::vector<Vec<Dim>>& points, Seen& seen) const {
    const std::vector<Body<Dim>>& bodies = solids_.bodies;
    const Body<Dim>& body = bodies[std::size_t(k)];
    std::vector<char> covering(bodies.size(), 0);
    for (std::size_t n = 0; n < bodies.size(); ++n)
      covering[n] = int(n) != k && is_counted(bodies[n]) && (body.moves() || bodies[n].moves()) && near(points, int(n));
    const bool as_cut = !body.moves() && std::find(covering.begin(), covering.end(), 1) == covering.end();
    if (!as_cut) {
      seen.own =
          body.moves() ? placed_pieces(domain_, body.contact_surface(), points) : solids_.still_pieces[std::size_t(k)];
      drop_covered(
          domain_.layout.h(), bodies, k, [&](int n) { return covering[std::size_t(n)] != 0; },
          [&](int n) { return pose_at_solve(n); }, seen.own);
    }
    for (const PlacedPiece<Dim>& piece : as_cut ? solids_.still_pieces[std::size_t(k)] : seen.own)
      if (const auto c = acting_cell(domain_, open_, piece.cell, piece.normal)) seen.acted_on.emplace_back(*c, &piece);
  }

  const Setup<Dim>& setup_;
  const Domain<Dim>& domain_;
  const Fluids& fluids_;
  const Solids<Dim>& solids_;
  const StepGeometry<Dim>& geometry_;
  const State<Dim>& state_;
  Vec3 gravity_;
  std::vector<Seen> seen_;
  CellField<Dim, char> open_;
};

}  // namespace

template <int Dim>
std::vector<SolidLoad> loads_beyond_faces(const Setup<Dim>& setup, const StepGeometry<Dim>& geometry,
                                          const State<Dim>& state) {
  const Domain<Dim>& domain = setup.domain;
  const Solids<Dim>& solids = setup.solids;
  std::vector<SolidLoad> loads(solids.bodies.size());
  const auto counted = [](const Body<Dim>& body) { return is_counted(body); };
  if (is_dry(setup) || std::none_of(solids.bodies.begin(), solids.bodies.end(), counted)) return loads;
  PrescribedLoads<Dim> prescribed(setup, geometry, state);
  std::vector<double> beside, sums;
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const Beside<Dim> b = prescribed.look(int(k));
    beside.insert(beside.end(), b.sums.begin(), b.sums.end());
  }
  domain.ranks.global_sum(beside);
  for (std::size_t k = 0; k < loads.size(); ++k) {
    Beside<Dim> b;
    std::copy_n(&beside[k * std::size_t(b.sums.size())], b.sums.size(), b.sums.begin());
    loads[k] = prescribed.of(int(k), b);
    for (const Vec3& v : {loads[k].force, loads[k].torque}) sums.insert(sums.end(), v.begin(), v.end());
  }
  domain.ranks.global_sum(sums);
  for (std::size_t k = 0; k < loads.size(); ++k) loads[k] = {Vec3(&sums[6 * k]), Vec3(&sums[6 * k + 3])};
  return loads;
}

template <int Dim>
std::vector<std::vector<PlacedPiece<Dim>>> pieces_of_still_solids(const Domain<Dim>& domain,
                                                                  const std::vector<Body<Dim>>& bodies) {
  std::vector<std::vector<PlacedPiece<Dim>>> pieces(bodies.size());
  const auto still = [&](int k) { return is_counted(bodies[std::size_t(k)]) && !bodies[std::size_t(k)].moves(); };
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (!still(int(k))) continue;
    const SurfaceMesh& surface = bodies[k].contact_surface();
    pieces[k] = placed_pieces(domain, surface, placed_points<Dim>(surface, Pose()));
    drop_covered(
        domain.layout.h(), bodies, int(k), still, [&](int) { return Pose(); }, pieces[k]);
  }
  return pieces;
}

#define SEICHE_INSTANTIATE(D)                                                                                      \
  template std::vector<SolidLoad> loads_beyond_faces<D>(const Setup<D>&, const StepGeometry<D>&, const State<D>&); \
  template std::vector<std::vector<PlacedPiece<D>>> pieces_of_still_solids<D>(const Domain<D>&,                    \
                                                                              const std::vector<Body<D>>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
