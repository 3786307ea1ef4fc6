#include "validate/measure/contour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace seiche {
namespace {

// A sample of the level set and its position in cells.
struct Corner {
  double x = 0, y = 0, phi = 0;
};

Corner zero_between(const Corner& a, const Corner& b) {
  const double t = a.phi / (a.phi - b.phi);
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), 0};
}

// Adds the length of the zero of phi, linear on a triangle, and twice its signed area by Green's theorem. The segment
// always has phi < 0 on the same side.
void add_segment(const std::array<Corner, 3>& corners, double& length, double& twice_area) {
  for (int k = 0; k < 3; ++k) {
    const Corner &lone = corners[std::size_t(k)], &next = corners[std::size_t((k + 1) % 3)],
                 &last = corners[std::size_t((k + 2) % 3)];
    const bool inside = lone.phi < 0;
    if ((next.phi < 0) == inside || (last.phi < 0) == inside) continue;
    Corner from = zero_between(lone, next), to = zero_between(lone, last);
    if (!inside) std::swap(from, to);
    length += std::hypot(to.x - from.x, to.y - from.y);
    twice_area += from.x * to.y - to.x * from.y;
  }
}

const vdb::Block& surface_of(const vdb::Frame& frame) {
  if (frame.dimension != 2) throw Error(ExitCode::cannot_continue, "only frames of two dimensions have a circularity");
  for (const vdb::Grid& grid : frame.grids)
    if (grid.name == vdb::level_set_name(frame) && grid.blocks.size() == 1) return grid.blocks[0];
  throw Error(ExitCode::cannot_continue, "a frame holds no surface");
}

}  // namespace

// Each square between four cell centres is divided into four triangles around its middle, which has the mean value.
double circularity(const vdb::Frame& frame) {
  const vdb::Block& block = surface_of(frame);
  const int nx = block.upper[0] - block.lower[0], ny = block.upper[1] - block.lower[1];
  const auto corner = [&](int i, int j) {
    return Corner{double(i), double(j), block.values[std::size_t(i) + std::size_t(nx) * std::size_t(j)]};
  };
  double length = 0, twice_area = 0;
  for (int j = 0; j + 1 < ny; ++j)
    for (int i = 0; i + 1 < nx; ++i) {
      const std::array<Corner, 4> square{corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)};
      Corner middle{i + 0.5, j + 0.5, 0};
      int inside = 0;
      for (const Corner& c : square) middle.phi += c.phi / 4, inside += c.phi < 0;
      if (inside == 0 || inside == 4) continue;
      if (i == 0 || j == 0 || i + 2 == nx || j + 2 == ny)
        throw Error(ExitCode::cannot_continue, "the surface ends at the domain's sides: it has no circularity");
      for (std::size_t k = 0; k < 4; ++k) add_segment({square[k], square[(k + 1) % 4], middle}, length, twice_area);
    }
  if (length == 0) throw Error(ExitCode::cannot_continue, "a frame holds no surface");
  return 2 * std::sqrt(std::numbers::pi * std::abs(twice_area) / 2) / length;
}

}  // namespace seiche
