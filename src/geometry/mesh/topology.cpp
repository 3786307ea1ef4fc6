#include "geometry/mesh/topology.h"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "base/error.h"

namespace seiche::mesh {
namespace {

using Triangle = std::array<int, 3>;

// One side of a triangle.
struct Side {
  int low, high;  // points of its edge
  int triangle;
  bool ascending;  // true if the triangle traverses the edge from low to high
  std::pair<int, int> edge() const { return {low, high}; }
};

std::vector<Side> sorted_sides(const SurfaceMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(mesh.triangles.size() * 3);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int e = 0; e < 3; ++e) {
      const int a = mesh.triangles[t][e], b = mesh.triangles[t][(e + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), int(t), a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    return std::pair(x.edge(), x.triangle) < std::pair(y.edge(), y.triangle);
  });
  return sides;
}

struct Neighbour {
  int triangle = -1;
  bool agrees = false;  // true if both traverse the shared edge in opposite directions, as in an oriented surface
};

// The triangles across the three sides of each triangle of a closed surface.
std::vector<std::array<Neighbour, 3>> neighbours(const SurfaceMesh& mesh) {
  const std::vector<Side> sides = sorted_sides(mesh);
  std::vector<std::array<Neighbour, 3>> result(mesh.triangles.size());
  std::vector<int> filled(mesh.triangles.size(), 0);
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
    const Side &a = sides[i], &b = sides[i + 1];
    const bool agrees = a.ascending != b.ascending;
    result[a.triangle][filled[a.triangle]++] = {b.triangle, agrees};
    result[b.triangle][filled[b.triangle]++] = {a.triangle, agrees};
  }
  return result;
}

std::string place(const Vec3& p) {
  return fmt::format("({:g}, {:g}, {:g})", p[0], p[1], p[2]);
}

// "12 <what>, the first from (..) to (..), from (..) to (..)"
std::string describe(const SurfaceMesh& mesh, const std::vector<Side>& edges, std::string_view what) {
  constexpr std::size_t shown = 3;
  std::string text = fmt::format("{} {}: ", edges.size(), what);
  for (std::size_t i = 0; i < std::min(shown, edges.size()); ++i) {
    text += (i ? ", " : "") + place(mesh.points[edges[i].low]) + " to " + place(mesh.points[edges[i].high]);
  }
  return text + (edges.size() > shown ? ", ..." : "");
}

// Six times the signed volume between a triangle and the mesh's first point. Accurate far from the origin, too.
double signed_volume(const SurfaceMesh& mesh, const Triangle& t) {
  const Vec3& o = mesh.points.front();
  const Vec3 a = mesh.points[t[0]] - o, b = mesh.points[t[1]] - o, c = mesh.points[t[2]] - o;
  return a.dot(b.cross(c));
}

double doubled_area(const SurfaceMesh& mesh, const Triangle& t) {
  const Vec3& a = mesh.points[t[0]];
  return (mesh.points[t[1]] - a).cross(mesh.points[t[2]] - a).norm();
}

void turn(Triangle& t) {
  std::swap(t[1], t[2]);
}

// Visits a connected piece from its first triangle on, and marks triangles to be reoriented so that neighbours agree.
struct Flood {
  SurfaceMesh& mesh;
  const std::vector<std::array<Neighbour, 3>>& across;
  std::vector<int>& piece;  // -1: not visited
  std::vector<char> turned{};

  void visit(int seed, int number) {
    std::vector<int> front{seed};
    piece[seed] = number;
    while (!front.empty()) {
      const int t = front.back();
      front.pop_back();
      for (const Neighbour& n : across[t]) step(t, n, number, front);
    }
  }

  void step(int t, const Neighbour& n, int number, std::vector<int>& front) {
    const bool turn_it = n.agrees ? turned[t] : !turned[t];
    if (piece[n.triangle] < 0) {
      piece[n.triangle] = number;
      turned[n.triangle] = turn_it;
      front.push_back(n.triangle);
    } else if (bool(turned[n.triangle]) != turn_it) {
      throw Error(ExitCode::bad_input, "the surface has one side only (like a Moebius band) near " +
                                           place(mesh.points[mesh.triangles[t][0]]) + "; it encloses no solid");
    }
  }
};

struct MeshPiece {
  std::vector<int> triangles;
  double volume = 0;  // six times the signed volume
  Vec3 lower = Vec3::Constant(INFINITY), upper = Vec3::Constant(-INFINITY);
};

std::vector<MeshPiece> collect(const SurfaceMesh& mesh, const std::vector<int>& piece_of) {
  std::vector<MeshPiece> result(1 + *std::max_element(piece_of.begin(), piece_of.end()));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    MeshPiece& piece = result[piece_of[t]];
    piece.triangles.push_back(int(t));
    piece.volume += signed_volume(mesh, mesh.triangles[t]);
    for (const int corner : mesh.triangles[t]) {
      piece.lower = piece.lower.cwiseMin(mesh.points[corner]);
      piece.upper = piece.upper.cwiseMax(mesh.points[corner]);
    }
  }
  return result;
}

// Winding number of a closed piece about x, by solid angles: 0 outside, +-1 inside (van Oosterom, Strackee 1983).
double winding(const SurfaceMesh& mesh, const MeshPiece& piece, const Vec3& x) {
  double sum = 0;
  for (const int t : piece.triangles) {
    const Vec3 a = mesh.points[mesh.triangles[t][0]] - x, b = mesh.points[mesh.triangles[t][1]] - x,
               c = mesh.points[mesh.triangles[t][2]] - x;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4 * 3.14159265358979323846);
}

bool encloses(const SurfaceMesh& mesh, const MeshPiece& outer, const MeshPiece& inner) {
  const bool within =
      (outer.lower.array() < inner.lower.array()).all() && (inner.upper.array() < outer.upper.array()).all();
  if (!within) return false;
  constexpr std::size_t samples = 200;  // several corners, since crossing pieces are not nested
  const std::size_t stride = 1 + inner.triangles.size() / samples;
  for (std::size_t i = 0; i < inner.triangles.size(); i += stride) {
    const Vec3& corner = mesh.points[mesh.triangles[inner.triangles[i]][0]];
    if (std::abs(winding(mesh, outer, corner)) < 0.5) return false;
  }
  return true;
}

int depth(const SurfaceMesh& mesh, const std::vector<MeshPiece>& all, const MeshPiece& piece) {
  int result = 0;
  for (const MeshPiece& other : all) result += &other != &piece && encloses(mesh, other, piece);
  return result;
}

void require_volume(const SurfaceMesh& mesh, const MeshPiece& piece) {
  const double extent = (piece.upper - piece.lower).maxCoeff();
  if (std::abs(piece.volume) > 1e-14 * extent * extent * extent) return;
  throw Error(ExitCode::bad_input, "the piece of the surface at " +
                                       place(mesh.points[mesh.triangles[piece.triangles.front()][0]]) +
                                       " encloses no volume");
}

template <class Drop>
void drop_triangles(SurfaceMesh& mesh, Drop&& drop, const char* what, std::vector<std::string>& notes) {
  const std::size_t before = mesh.triangles.size();
  std::erase_if(mesh.triangles, drop);
  const std::size_t dropped = before - mesh.triangles.size();
  if (dropped > 0) notes.push_back(fmt::format("dropped {} {}", dropped, what));
}

bool repeats_corner(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

void drop_duplicates(SurfaceMesh& mesh, std::vector<std::string>& notes) {
  std::vector<std::pair<Triangle, int>> keys;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle key = mesh.triangles[t];
    std::sort(key.begin(), key.end());
    keys.emplace_back(key, int(t));
  }
  std::sort(keys.begin(), keys.end());
  std::vector<char> duplicate(mesh.triangles.size(), 0);
  for (std::size_t i = 1; i < keys.size(); ++i) duplicate[keys[i].second] = keys[i].first == keys[i - 1].first;
  std::size_t index = 0;
  drop_triangles(
      mesh, [&](const Triangle&) { return duplicate[index++] != 0; }, "duplicate triangles", notes);
}

}  // namespace

void weld(SurfaceMesh& mesh) {
  const auto less = [&](int i, int j) {
    const Vec3 &p = mesh.points[i], &q = mesh.points[j];
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  };
  std::vector<char> used(mesh.points.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    for (const int corner : t) used[corner] = 1;
  }
  for (const auto& ends : mesh.segments) {
    for (const int end : ends) used[end] = 1;
  }
  std::vector<int> order(mesh.points.size()), first(mesh.points.size()), compact(mesh.points.size(), -1);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), less);  // of equal points, the first in the file comes first
  for (std::size_t k = 0; k < order.size(); ++k) {
    first[order[k]] = k > 0 && !less(order[k - 1], order[k]) ? first[order[k - 1]] : order[k];
  }
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    int& leader = compact[first[i]];
    if (!used[i]) continue;
    if (leader < 0) {
      leader = int(points.size());
      points.push_back(mesh.points[i]);
    }
  }
  for (Triangle& t : mesh.triangles) {
    for (int& corner : t) corner = compact[first[corner]];
  }
  for (auto& ends : mesh.segments) {
    for (int& end : ends) end = compact[first[end]];
  }
  mesh.points = std::move(points);
}

void drop_degenerate_and_duplicate(SurfaceMesh& mesh, std::vector<std::string>& notes) {
  drop_triangles(mesh, repeats_corner, "degenerate triangles", notes);
  drop_duplicates(mesh, notes);
  if (mesh.triangles.size() < 4) throw Error(ExitCode::bad_input, "fewer than 4 triangles enclose no volume");
}

void require_closed(const SurfaceMesh& mesh) {
  const std::vector<Side> sides = sorted_sides(mesh);
  std::vector<Side> open, crowded;
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i;
    while (end < sides.size() && sides[end].edge() == sides[i].edge()) ++end;
    if (end - i == 1) open.push_back(sides[i]);
    if (end - i > 2) crowded.push_back(sides[i]);
    i = end;
  }
  if (!open.empty()) {
    throw Error(ExitCode::bad_input, "the surface is not closed, it has " + describe(mesh, open, "open edges") +
                                         "; fill its holes and export it again");
  }
  if (!crowded.empty()) {
    throw Error(ExitCode::bad_input, "the surface is not manifold, it has " +
                                         describe(mesh, crowded, "edges with more than two triangles") +
                                         "; separate or remove the parts that meet there");
  }
}

void orient(SurfaceMesh& mesh, std::vector<std::string>& notes) {
  const auto across = neighbours(mesh);
  std::vector<int> piece_of(mesh.triangles.size(), -1);
  Flood flood{mesh, across, piece_of, std::vector<char>(mesh.triangles.size(), 0)};
  int count = 0;
  for (std::size_t seed = 0; seed < piece_of.size(); ++seed) {
    if (piece_of[seed] < 0) flood.visit(int(seed), count++);
  }
  for (std::size_t t = 0; t < piece_of.size(); ++t) {
    if (flood.turned[t]) turn(mesh.triangles[t]);
  }
  const std::vector<MeshPiece> all = collect(mesh, piece_of);
  for (const MeshPiece& piece : all) {
    require_volume(mesh, piece);
    const bool cavity = depth(mesh, all, piece) % 2 == 1;
    if ((piece.volume > 0) != cavity) continue;
    for (const int t : piece.triangles) {
      turn(mesh.triangles[t]);
      flood.turned[t] = !flood.turned[t];
    }
  }
  const auto turned = std::count(flood.turned.begin(), flood.turned.end(), char(1));
  if (turned > 0) notes.push_back(fmt::format("turned {} triangles to face outwards", turned));
}

void drop_slivers(SurfaceMesh& mesh, std::vector<std::string>& notes) {
  drop_triangles(
      mesh, [&](const Triangle& t) { return doubled_area(mesh, t) == 0; }, "triangles without area", notes);
}

}  // namespace seiche::mesh
