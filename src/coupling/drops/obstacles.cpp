#include "coupling/drops/obstacles.h"

#include <algorithm>

#include "fluid/volume/neighbours.h"
#include "grid/interpolation.h"

namespace seiche {
namespace {

// Drops leave through these sides. An inflow side is closed where nothing enters.
bool lets_out(SideType side) {
  return side == SideType::outflow || side == SideType::waves;
}

}  // namespace

template <int Dim>
Obstacles<Dim>::Obstacles(const Domain<Dim>& domain, const std::vector<Body<Dim>>& bodies,
                          const StepGeometry<Dim>& geometry, std::vector<Placement> placed)
    : domain_(domain), bodies_(bodies), geometry_(geometry), placed_(std::move(placed)) {}

template <int Dim>
bool Obstacles<Dim>::has_left(const Vec<Dim>& x) const {
  const Geometry<Dim>& g = domain_.layout.geometry();
  for (int a = 0; a < Dim; ++a) {
    const double upper = g.lower[a] + g.h * g.cells[a];
    if (x[a] < g.lower[a] && lets_out(domain_.sides.type(a, 0))) return true;
    if (x[a] >= upper && lets_out(domain_.sides.type(a, 1))) return true;
  }
  return false;
}

// Distance (m) from its centre at which a drop touches a wall. Large drops are flat.
template <int Dim>
double Obstacles<Dim>::contact_distance(double volume) const {
  return std::min(radius_of_drop<Dim>(volume), 0.5 * domain_.layout.h());
}

template <int Dim>
void Obstacles<Dim>::keep_within_sides(Drop<Dim>& drop) const {
  const Geometry<Dim>& g = domain_.layout.geometry();
  const double gap = contact_distance(drop.volume);
  for (int a = 0; a < Dim; ++a) {
    const double extent = g.h * g.cells[a];
    double x = drop.place[a] - g.lower[a];
    if (g.periodic[a]) {
      x -= extent * std::floor(x / extent);
      drop.place[a] = g.lower[a] + (x < extent ? x : 0);
      continue;
    }
    if (x < gap && !lets_out(domain_.sides.type(a, 0)))
      drop.place[a] = g.lower[a] + gap, drop.velocity[a] = std::max(drop.velocity[a], 0.0);
    if (x > extent - gap && !lets_out(domain_.sides.type(a, 1)))
      drop.place[a] = g.lower[a] + extent - gap, drop.velocity[a] = std::min(drop.velocity[a], 0.0);
  }
}

template <int Dim>
double Obstacles<Dim>::distance(const Vec<Dim>& x) const {
  const Layout<Dim>& l = domain_.layout;
  return interpolate_linear<Dim>(l, geometry_.psi.data(), index_coordinates<Dim>(l, x, node_offset<Dim>()));
}

template <int Dim>
Vec<Dim> Obstacles<Dim>::normal(const Vec<Dim>& x) const {
  const double e = 0.25 * domain_.layout.h();
  Vec<Dim> n;
  for (int a = 0; a < Dim; ++a) n[a] = distance(x + e * Vec<Dim>::Unit(a)) - distance(x - e * Vec<Dim>::Unit(a));
  return n.norm() > 0 ? Vec<Dim>(n.normalized()) : Vec<Dim>(Vec<Dim>::Unit(1));
}

template <int Dim>
Vec<Dim> Obstacles<Dim>::wall_velocity(const Vec<Dim>& x) const {
  const Layout<Dim>& l = domain_.layout;
  IVec<Dim> node;
  for (int a = 0; a < Dim; ++a) node[a] = int(std::lround((x[a] - l.geometry().lower[a]) / l.h()));
  const int k = geometry_.body[l.site(node)];
  if (k < 0) return Vec<Dim>::Zero();
  auto& solid = met_[k];
  if (!solid) solid = place_solid(l, bodies_[std::size_t(k)], placed_[std::size_t(k)]);
  const Placement& placed = placed_[std::size_t(k)];
  if (!solid->deforms() || placed.velocity.size() == 0) return truncate<Dim>(placed.twist.at(extend<Dim>(x)));
  const SurfaceWeights weights = solid->weights_at(x);
  Vec<Dim> v;
  for (int a = 0; a < Dim; ++a) v[a] = velocity_at<Dim>(weights, a, placed.velocity);
  return v;
}

// The nearest centre of a cell outside of solids, where there is no way along their normals.
template <int Dim>
void Obstacles<Dim>::find_room(Drop<Dim>& drop) const {
  constexpr int reach = 2;
  const Layout<Dim>& l = domain_.layout;
  const IVec<Dim> cell = cell_around(l.geometry(), drop.place);
  double least = std::numeric_limits<double>::infinity();
  const Vec<Dim> from = drop.place;
  for (int n = 0; n < neighbour_count<Dim>(reach); ++n) {
    const IVec<Dim> there = cell + neighbour_offset<Dim>(n, reach);
    const Vec<Dim> x = l.position(there, cell_offset<Dim>());
    if (!lies_in_domain(l.geometry(), there) || distance(x) <= 0 || (x - from).norm() >= least) continue;
    least = (x - from).norm();
    drop.place = x;
  }
}

template <int Dim>
void Obstacles<Dim>::keep_out(Drop<Dim>& drop) const {
  constexpr int most_moves = 8;
  keep_within_sides(drop);
  if (bodies_.empty()) return;
  const double gap = contact_distance(drop.volume);
  for (int n = 0; n < most_moves; ++n) {
    const double d = distance(drop.place);
    if (d >= gap) return;
    const Vec<Dim> out = normal(drop.place);
    const double speed = (drop.velocity - wall_velocity(drop.place)).dot(out);
    if (speed < 0) drop.velocity -= speed * out;
    drop.place += (gap - d) * (1 + 1e-9) * out;
    keep_within_sides(drop);
  }
  if (distance(drop.place) <= 0) find_room(drop);
}

template <int Dim>
bool Obstacles<Dim>::touches(const Drop<Dim>& drop) const {
  constexpr double close = 1.05;
  const Geometry<Dim>& g = domain_.layout.geometry();
  const double gap = close * contact_distance(drop.volume);
  for (int a = 0; a < Dim; ++a) {
    if (g.periodic[a]) continue;
    const double x = drop.place[a] - g.lower[a];
    if (x < gap && !lets_out(domain_.sides.type(a, 0))) return true;
    if (x > g.h * g.cells[a] - gap && !lets_out(domain_.sides.type(a, 1))) return true;
  }
  return !bodies_.empty() && distance(drop.place) < gap;
}

template class Obstacles<2>;
template class Obstacles<3>;

}  // namespace seiche
