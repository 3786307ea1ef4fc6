#include "solid/elastic/surface_patches.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "geometry/mesh/facets.h"

namespace seiche {
namespace {

// Per surface point: the first pin with the motion of the point's pin; -1: free.
std::vector<int> pins_of_points(const ElasticSurface& surface, const std::vector<PinnedNodes>& pins) {
  std::map<int, int> of_node;
  for (std::size_t k = 0; k < pins.size(); ++k) {
    std::size_t first = 0;
    while (!same_motion(pins[first].motion, pins[k].motion)) ++first;
    for (const int n : pins[k].nodes) of_node[n] = int(first);
  }
  std::vector<int> of_point;
  for (const int n : surface.nodes) {
    const auto found = of_node.find(n);
    of_point.push_back(found == of_node.end() ? -1 : found->second);
  }
  return of_point;
}

// The pin that holds all of these points; -1: none.
template <class Points>
int common_pin(const Points& points, const std::vector<int>& pin_of_point) {
  int pin = -1;
  bool first = true;
  for (const int p : points) {
    if (p < 0) continue;
    if (!first && pin_of_point[std::size_t(p)] != pin) return -1;
    pin = pin_of_point[std::size_t(p)];
    first = false;
  }
  return pin;
}

// Adds the facets that close the sides with one facet only. 2D: segments from a facet's end to the apex and from the
// apex to its start. 3D: the side in reverse orientation with the apex.
template <int Dim>
void close_sides(const std::vector<int>& pin_of_point, SurfacePatch<Dim>& patch) {
  std::map<std::array<int, Dim>, int> closings;  // and how often
  const auto add = [&](const std::array<int, Dim>& closing, const std::array<int, Dim>& opposite) {
    const auto found = closings.find(opposite);
    if (found == closings.end())
      ++closings[closing];
    else if (--found->second == 0)
      closings.erase(found);
  };
  for (const auto& f : patch.facets) {
    if constexpr (Dim == 2) {
      add({f[1], -1}, {-1, f[1]});
      add({-1, f[0]}, {f[0], -1});
    } else {
      for (int i = 0; i < 3; ++i) add({f[(i + 1) % 3], f[i], -1}, {f[i], f[(i + 1) % 3], -1});
    }
  }
  for (const auto& [corners, count] : closings) patch.closings.push_back({corners, common_pin(corners, pin_of_point)});
}

// Groups facets that share points, keyed by the group's smallest point number.
template <int Dim>
std::map<int, std::vector<std::array<int, Dim>>> pieces_of(const std::vector<std::array<int, Dim>>& facets,
                                                           std::size_t points) {
  std::vector<int> root(points);
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int i) {
    while (root[std::size_t(i)] != i) i = root[std::size_t(i)] = root[std::size_t(root[std::size_t(i)])];
    return i;
  };
  for (const auto& f : facets)
    for (int i = 1; i < Dim; ++i) {
      const int a = find(f[0]), b = find(f[std::size_t(i)]);
      root[std::size_t(std::max(a, b))] = std::min(a, b);
    }
  std::map<int, std::vector<std::array<int, Dim>>> pieces;
  for (const auto& f : facets) pieces[find(f[0])].push_back(f);
  return pieces;
}

}  // namespace

template <int Dim>
std::vector<SurfacePatch<Dim>> find_patches(const ElasticSurface& surface, const std::vector<PinnedNodes>& pins) {
  const std::vector<int> pin_of_point = pins_of_points(surface, pins);
  std::vector<SurfacePatch<Dim>> patches;
  for (int part = 0; part < surface.parts; ++part) {
    std::vector<std::array<int, Dim>> all, loose;
    for (const auto& f : facets_of<Dim>(surface.facets)) {
      if (surface.part[std::size_t(f[0])] != part) continue;
      all.push_back(f);
      if (common_pin(f, pin_of_point) < 0) loose.push_back(f);
    }
    const auto pieces = pieces_of<Dim>(loose, surface.nodes.size());
    if (pieces.size() < 2) {
      patches.push_back({all, {}});
      continue;
    }
    for (const auto& [point, facets] : pieces) {
      patches.push_back({facets, {}});
      close_sides(pin_of_point, patches.back());
    }
  }
  return patches;
}

template <int Dim>
std::vector<int> patches_of_nodes(const ElasticSolid<Dim>& solid) {
  std::vector<int> patches(solid.body.mesh.nodes.size(), -1);
  for (std::size_t k = 0; k < solid.patches.size(); ++k)
    for (const auto& facet : solid.patches[k].facets)
      for (const int p : facet) patches[std::size_t(solid.surface.nodes[std::size_t(p)])] = int(k);
  return patches;
}

#define SEICHE_INSTANTIATE(D)                                                                                    \
  template std::vector<SurfacePatch<D>> find_patches<D>(const ElasticSurface&, const std::vector<PinnedNodes>&); \
  template std::vector<int> patches_of_nodes<D>(const ElasticSolid<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
