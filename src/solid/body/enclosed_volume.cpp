#include "solid/body/enclosed_volume.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>

namespace seiche {
namespace {

template <int Dim>
using Facet = std::array<int, Dim>;
template <int Dim>
using Corners = std::array<Vec<Dim>, Dim>;

// Signed volume of the cone from the origin to a facet. Below: its derivative by corner i.
double cone(const Corners<2>& p) {
  return 0.5 * (p[0][0] * p[1][1] - p[0][1] * p[1][0]);
}
double cone(const Corners<3>& p) {
  return p[0].dot(p[1].cross(p[2])) / 6;
}
Vec<2> cone_gradient(const Corners<2>& p, int i) {
  return i == 0 ? Vec<2>(0.5 * p[1][1], -0.5 * p[1][0]) : Vec<2>(-0.5 * p[0][1], 0.5 * p[0][0]);
}
Vec<3> cone_gradient(const Corners<3>& p, int i) {
  return p[(i + 1) % 3].cross(p[(i + 2) % 3]) / 6;
}

template <int Dim>
const SurfacePatch<Dim>& patch_of(const WallPatch<Dim>& wall) {
  return wall.solid->patches[std::size_t(wall.patch)];
}

template <int Dim>
Vec<Dim> rest_of(const WallPatch<Dim>& wall, int point) {
  return wall.solid->body.mesh.nodes[std::size_t(wall.solid->surface.nodes[std::size_t(point)])];
}

template <int Dim>
Vec<Dim> place_of(const WallPatch<Dim>& wall, int point, const Eigen::VectorXd& u) {
  return rest_of(wall, point) + u.segment<Dim>(Dim * wall.solid->surface.nodes[std::size_t(point)]);
}

// A fixed point on the walls; positions are taken relative to it.
template <int Dim>
Vec<Dim> origin_of(const CavityWalls<Dim>& walls) {
  return rest_of(walls[0], patch_of(walls[0]).facets[0][0]);
}

// Numbers the motions at which the walls' patches end. Pin k of wall n has the number [n][k], or -1 where no patch ends
// at it.
template <int Dim>
std::vector<std::vector<int>> number_motions(const CavityWalls<Dim>& walls) {
  std::vector<const MotionSpec*> motions;
  std::vector<std::vector<int>> numbers;
  for (const WallPatch<Dim>& wall : walls) {
    std::vector<int>& of_wall = numbers.emplace_back(wall.solid->pins.size(), -1);
    for (const auto& closing : patch_of(wall).closings) {
      if (closing.pin < 0 || of_wall[std::size_t(closing.pin)] >= 0) continue;
      const MotionSpec& motion = wall.solid->pins[std::size_t(closing.pin)].motion;
      std::size_t n = 0;
      while (n < motions.size() && !same_motion(*motions[n], motion)) ++n;
      if (n == motions.size()) motions.push_back(&motion);
      of_wall[std::size_t(closing.pin)] = int(n);
    }
  }
  return numbers;
}

// Calls visit(number of the motion, number of the wall, closing).
template <int Dim, class Visit>
void for_each_closing(const CavityWalls<Dim>& walls, const Visit& visit) {
  if (walls.size() == 1 && patch_of(walls[0]).is_closed()) return;
  const auto numbers = number_motions(walls);
  for (std::size_t n = 0; n < walls.size(); ++n)
    for (const auto& closing : patch_of(walls[n]).closings) visit(numbers[n][std::size_t(closing.pin)], n, closing);
}

// Volume between the origin and the facets that join each loop to its middle.
template <int Dim>
double closing_volume(const CavityWalls<Dim>& walls, const std::vector<Eigen::VectorXd>& u, const Vec<Dim>& origin) {
  struct Middle {
    Vec<Dim> sum = Vec<Dim>::Zero();
    int count = 0;
  };
  std::map<int, Middle> middles;
  for_each_closing(walls, [&](int motion, std::size_t n, const auto& closing) {
    for (const int p : closing.corners)
      if (p >= 0) middles[motion].sum += place_of(walls[n], p, u[n]) - origin, ++middles[motion].count;
  });
  double volume = 0;
  for_each_closing(walls, [&](int motion, std::size_t n, const auto& closing) {
    Corners<Dim> p;
    const Middle& middle = middles[motion];
    for (std::size_t i = 0; i < Dim; ++i)
      p[i] = closing.corners[i] < 0 ? Vec<Dim>(middle.sum / middle.count)
                                    : Vec<Dim>(place_of(walls[n], closing.corners[i], u[n]) - origin);
    volume += cone(p);
  });
  return volume;
}

template <int Dim>
Corners<Dim> corners_of(const WallPatch<Dim>& wall, const Facet<Dim>& facet, const Eigen::VectorXd& u,
                        const Vec<Dim>& origin) {
  Corners<Dim> p;
  for (std::size_t i = 0; i < Dim; ++i) p[i] = place_of(wall, facet[i], u) - origin;
  return p;
}

// Unit normals at a patch's nodes, zero at pinned ones.
template <int Dim>
Eigen::VectorXd free_normals(const CavityWalls<Dim>& walls, std::size_t n, const Eigen::VectorXd& u, double t) {
  Eigen::VectorXd normals = enclosed_volume_gradient(walls, n, u);
  for (Eigen::Index i = 0; i < normals.size(); i += Dim)
    if (const double area = normals.segment<Dim>(i).norm(); area > 0) normals.segment<Dim>(i) /= area;
  for (const int dof : pins_at(*walls[n].solid, t).dofs) normals[dof] = 0;
  return normals;
}

// Displacements of each wall's solid after dt.
template <int Dim>
std::vector<Eigen::VectorXd> moved(const CavityWalls<Dim>& walls, const ElasticMotions& motions, double dt,
                                   const std::vector<Eigen::VectorXd>& velocities) {
  std::vector<Eigen::VectorXd> u;
  for (const WallPatch<Dim>& wall : walls)
    u.push_back(motions[std::size_t(wall.body)]->state.u + dt * velocities[std::size_t(wall.body)]);
  return u;
}

}  // namespace

// The patches close if each end of a patch meets the start of a patch (another one or the same) at one motion. In 3D:
// each point of a loop is entered as often as it is left.
template <int Dim>
bool can_be_closed(const CavityWalls<Dim>& walls) {
  for (const WallPatch<Dim>& wall : walls)
    for (const auto& closing : patch_of(wall).closings)
      if (closing.pin < 0) return false;
  std::map<std::array<int, 3>, int> balance;  // of a motion (3D: and a point of a body)
  for_each_closing(walls, [&](int motion, std::size_t n, const auto& closing) {
    if constexpr (Dim == 2) {
      balance[{motion, 0, 0}] += closing.corners[0] < 0 ? 1 : -1;
    } else {
      ++balance[{motion, walls[n].body, closing.corners[0]}];
      --balance[{motion, walls[n].body, closing.corners[1]}];
    }
  });
  return std::all_of(balance.begin(), balance.end(), [](const auto& b) { return b.second == 0; });
}

template <int Dim>
bool is_closed(const WallPatch<Dim>& wall) {
  return patch_of(wall).is_closed();
}

template <int Dim>
bool has_open_wall(const CavityWalls<Dim>& walls) {
  return std::any_of(walls.begin(), walls.end(), [](const WallPatch<Dim>& wall) { return !is_closed(wall); });
}

template <int Dim>
bool is_vessel(const WallPatch<Dim>& wall, const Eigen::VectorXd& u) {
  return enclosed_volume<Dim>({wall}, {u}) < 0;
}

template <int Dim>
double enclosed_volume(const CavityWalls<Dim>& walls, const std::vector<Eigen::VectorXd>& u) {
  const Vec<Dim> origin = origin_of(walls);
  double sum = closing_volume(walls, u, origin);
  for (std::size_t n = 0; n < walls.size(); ++n)
    for (const Facet<Dim>& facet : patch_of(walls[n]).facets)
      sum += cone(corners_of<Dim>(walls[n], facet, u[n], origin));
  return sum;
}

template <int Dim>
Eigen::VectorXd enclosed_volume_gradient(const CavityWalls<Dim>& walls, std::size_t n, const Eigen::VectorXd& u) {
  const WallPatch<Dim>& wall = walls[n];
  const Vec<Dim> origin = origin_of(walls);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(u.size());
  for (const Facet<Dim>& facet : patch_of(wall).facets) {
    const Corners<Dim> p = corners_of<Dim>(wall, facet, u, origin);
    for (int i = 0; i < Dim; ++i)
      gradient.segment<Dim>(Dim * wall.solid->surface.nodes[std::size_t(facet[std::size_t(i)])]) += cone_gradient(p, i);
  }
  if (patch_of(wall).is_closed()) return gradient;
  for (const PinnedNodes& pin : wall.solid->pins)
    for (const int node : pin.nodes) gradient.segment<Dim>(Dim * node).setZero();
  return gradient;
}

template <int Dim>
SurfaceMesh wall_of_cavity(const ElasticSolid<Dim>& solid, int patch) {
  SurfaceMesh wall;
  for (const Facet<Dim>& facet : solid.patches[std::size_t(patch)].facets) {
    if constexpr (Dim == 2)
      wall.segments.push_back({facet[1], facet[0]});
    else
      wall.triangles.push_back({facet[0], facet[2], facet[1]});
  }
  return wall;
}

template <int Dim>
std::vector<CavityWalls<Dim>> kept_cavities(const std::vector<Body<Dim>>& bodies, const ElasticMotions& motions) {
  std::map<double, CavityWalls<Dim>> cavities;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (!motions[k]) continue;
    const Eigen::VectorXd& cavity = motions[k]->cavity;
    for (Eigen::Index p = 0; p < cavity.size(); ++p)
      if (cavity[p] >= 0) cavities[cavity[p]].push_back({&bodies[k].elastic(), int(k), int(p)});
  }
  std::vector<CavityWalls<Dim>> list;
  for (auto& [number, walls] : cavities) list.push_back(std::move(walls));
  return list;
}

namespace {

// Newton's method. The residual is of second order in the motion, so two iterations suffice.
template <int Dim>
void keep_in_proportion(const CavityWalls<Dim>& walls, const ElasticMotions& motions, double t, double dt,
                        double wanted, std::vector<Eigen::VectorXd>& w) {
  constexpr int iterations = 4;
  for (int i = 0; i < iterations; ++i) {
    const auto end = moved(walls, motions, dt, w);
    std::vector<Eigen::VectorXd> normals;
    double slope = 0;
    for (std::size_t n = 0; n < walls.size(); ++n) {
      normals.push_back(free_normals(walls, n, end[n], t + dt));
      slope += enclosed_volume_gradient(walls, n, end[n]).dot(normals[n]);
    }
    if (!(slope > 0)) return;
    const double by = (wanted - enclosed_volume(walls, end)) / (slope * dt);
    for (std::size_t n = 0; n < walls.size(); ++n) w[std::size_t(walls[n].body)] += by * normals[n];
  }
}

}  // namespace

template <int Dim>
void keep_cavities(const std::vector<Body<Dim>>& bodies, const ElasticMotions& motions, const PartOfPlan& part,
                   std::vector<Eigen::VectorXd>& w) {
  if (part.dt == part.horizon) return;
  std::vector<Eigen::VectorXd> planned;
  for (const ElasticMotion* m : motions) planned.push_back(m ? m->velocity : Eigen::VectorXd());
  for (const CavityWalls<Dim>& walls : kept_cavities(bodies, motions)) {
    const double now = enclosed_volume(walls, moved(walls, motions, 0, planned));
    const double end = enclosed_volume(walls, moved(walls, motions, part.horizon, planned));
    const double share = part.horizon > 0 ? part.dt / part.horizon : 0;
    keep_in_proportion(walls, motions, part.t, part.dt, now + share * (end - now), w);
  }
}

#define SEICHE_INSTANTIATE(D)                                                                                       \
  template bool can_be_closed<D>(const CavityWalls<D>&);                                                            \
  template bool is_closed<D>(const WallPatch<D>&);                                                                  \
  template bool has_open_wall<D>(const CavityWalls<D>&);                                                            \
  template bool is_vessel<D>(const WallPatch<D>&, const Eigen::VectorXd&);                                          \
  template double enclosed_volume<D>(const CavityWalls<D>&, const std::vector<Eigen::VectorXd>&);                   \
  template Eigen::VectorXd enclosed_volume_gradient<D>(const CavityWalls<D>&, std::size_t, const Eigen::VectorXd&); \
  template SurfaceMesh wall_of_cavity<D>(const ElasticSolid<D>&, int);                                              \
  template std::vector<CavityWalls<D>> kept_cavities<D>(const std::vector<Body<D>>&, const ElasticMotions&);        \
  template void keep_cavities<D>(const std::vector<Body<D>>&, const ElasticMotions&, const PartOfPlan&,             \
                                 std::vector<Eigen::VectorXd>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
