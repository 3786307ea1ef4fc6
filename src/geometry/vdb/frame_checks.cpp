#include "geometry/vdb/frame_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>

#include "base/error.h"

namespace seiche::vdb {

std::array<int, 3> domain_cells(const Frame& frame) {
  std::array<int, 3> cells{0, 0, 0};
  for (const Grid& grid : frame.grids) {
    for (const Block& block : grid.blocks) {
      for (int a = 0; a < 3; ++a) cells[a] = std::max(cells[a], block.upper[a]);
    }
  }
  return cells;
}

std::string level_set_name(const Frame& frame) {
  const bool has_free = std::any_of(frame.grids.begin(), frame.grids.end(), [](const Grid& grid) {
    return grid.kind == GridKind::level_set && grid.name == "free_surface";
  });
  return has_free ? "free_surface" : "surface";
}

std::size_t voxel_count(const std::array<int, 3>& lower, const std::array<int, 3>& upper) {
  std::size_t n = 1;
  for (int a = 0; a < 3; ++a) n *= std::size_t(std::max(0, upper[a] - lower[a]));
  return n;
}

int components(GridKind kind) {
  return kind == GridKind::staggered_vector ? 3 : 1;
}

void require_block(const Grid& grid, const Block& block) {
  const std::size_t n = voxel_count(block.lower, block.upper) * components(grid.kind);
  const bool outside = *std::min_element(block.lower.begin(), block.lower.end()) < 0;
  if (block.values.size() == n && !outside) return;
  throw Error(ExitCode::bug,
              fmt::format("frame grid '{}': a block from ({}, {}, {}) of {} values where its box takes {}", grid.name,
                          block.lower[0], block.lower[1], block.lower[2], block.values.size(), n));
}

void require_finite(const Grid& grid, const Block& block) {
  const auto bad = std::find_if(block.values.begin(), block.values.end(), [](float v) { return !std::isfinite(v); });
  if (bad == block.values.end()) return;
  std::size_t voxel = std::size_t(bad - block.values.begin()) / components(grid.kind);
  std::array<std::size_t, 3> at{};
  for (int a = 0; a < 3; ++a) {
    const std::size_t extent = block.upper[a] - block.lower[a];
    at[a] = block.lower[a] + voxel % extent;
    voxel /= extent;
  }
  throw Error(ExitCode::cannot_continue,
              fmt::format("frame grid '{}' holds a value that is not finite at voxel ({}, {}, {}); not written",
                          grid.name, at[0], at[1], at[2]));
}

void require_finite(const std::filesystem::path& file, const Grid& grid) {
  for (const Block& block : grid.blocks) {
    for (const float v : block.values) {
      if (!std::isfinite(v)) refuse(file, "grid '" + grid.name + "' holds a value that is not finite");
    }
  }
}

void require_readable(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) refuse(file, "is a folder, not a frame");
  std::ifstream in(file, std::ios::binary);
  if (!in) refuse(file, std::string("cannot be read: ") + std::strerror(errno));
  if (in.peek() == std::ifstream::traits_type::eof()) refuse(file, "is empty (0 bytes), not a frame");
}

void require_sane(const std::filesystem::path& file, const Frame& frame, const std::array<int, 3>& cells) {
  constexpr double max_voxels = 2147483647.0;
  double voxels = 1;
  for (const int n : cells) voxels *= n > 0 ? double(n) : max_voxels;
  const bool layer = frame.dimension == 3 || (frame.dimension == 2 && cells[2] == 1);
  const bool finite = frame.lower.allFinite() && std::isfinite(frame.time) && std::isfinite(frame.dt);
  if (voxels < max_voxels && layer && finite && frame.cell_size > 0 && std::isfinite(frame.cell_size)) return;
  refuse(file, fmt::format("the frame's metadata is corrupt: dimension {}, {} x {} x {} cells of {:g} m",
                           frame.dimension, cells[0], cells[1], cells[2], frame.cell_size));
}

void refuse(const std::filesystem::path& file, const std::string& what) {
  throw Error(ExitCode::bad_input, file.string() + ": " + what);
}

}  // namespace seiche::vdb
