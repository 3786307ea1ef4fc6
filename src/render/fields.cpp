#include "render/fields.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "base/suggest.h"

namespace seiche::render {
namespace {

struct QuantityRow {
  const char* name;
  const char* unit;
  bool from_velocity;
  bool is_signed;
};

constexpr QuantityRow quantity_rows[] = {
    {"speed", "m/s", true, false},     {"vorticity", "s⁻¹", true, true},    {"divergence", "s⁻¹", true, true},
    {"velocity_x", "m/s", true, true}, {"velocity_y", "m/s", true, true},   {"velocity_z", "m/s", true, true},
    {"pressure", "Pa", false, false},  {"viscosity", "Pa s", false, false},
};

const QuantityRow* row_of(const std::string& quantity) {
  for (const QuantityRow& row : quantity_rows)
    if (quantity == row.name) return &row;
  return nullptr;
}

ScalarVolume volume_over(const vdb::Frame& frame, const vdb::Block& block) {
  ScalarVolume volume;
  for (int a = 0; a < 3; ++a) volume.cells[a] = block.upper[a] - block.lower[a];
  volume.lower = frame.lower.cast<float>();
  volume.h = float(frame.cell_size);
  return volume;
}

const vdb::Grid* velocity_grid(const vdb::Frame& frame) {
  for (const vdb::Grid& grid : frame.grids)
    if (grid.name == "vel" && grid.kind == vdb::GridKind::staggered_vector) return &grid;
  return nullptr;
}

// Derivatives of the velocity at cell centres.
class Derivatives {
 public:
  Derivatives(const FaceVelocity& velocity, const std::optional<ScalarVolume>& phi) : u_(velocity), phi_(phi) {}

  // The derivative of component `of` along an axis.
  float along(int axis, int of, const std::array<int, 3>& cell) const {
    std::array<int, 3> low = cell, high = cell;
    if (cell[axis] > 0 && holds_flow(cell, axis, -1)) --low[axis];
    if (cell[axis] + 1 < u_.cells[axis] && holds_flow(cell, axis, 1)) ++high[axis];
    const int steps = high[axis] - low[axis];
    return steps == 0 ? 0.0f : (u_.at_center(high, of) - u_.at_center(low, of)) / (float(steps) * u_.h);
  }

  // Difference of a cell's two faces; at the last cell of an axis, whose high face frames lack, that before it.
  float across_cell(int axis, std::array<int, 3> cell) const {
    if (u_.cells[axis] < 2) return 0;
    cell[axis] = std::min(cell[axis], u_.cells[axis] - 2);
    std::array<int, 3> next = cell;
    ++next[axis];
    return (face(next, axis) - face(cell, axis)) / u_.h;
  }

 private:
  float face(const std::array<int, 3>& c, int axis) const {
    return u_.values[3 * ((std::size_t(c[2]) * u_.cells[1] + c[1]) * u_.cells[0] + c[0]) + std::size_t(axis)];
  }
  // Beyond the liquid frames continue its velocity without regard to its derivatives.
  bool holds_flow(std::array<int, 3> cell, int axis, int step) const {
    cell[axis] += step;
    return !phi_ || phi_->at(cell[0], cell[1], cell[2]) < 0;
  }

  const FaceVelocity& u_;
  const std::optional<ScalarVolume>& phi_;
};

float derived_value(const std::string& quantity, const FaceVelocity& u, const Derivatives& d, int dimension,
                    const std::array<int, 3>& cell) {
  if (quantity == "speed") return Vec3f(u.at_center(cell, 0), u.at_center(cell, 1), u.at_center(cell, 2)).norm();
  if (quantity.starts_with("velocity_")) return u.at_center(cell, quantity.back() - 'x');
  if (quantity == "divergence") {
    float sum = 0;
    for (int a = 0; a < dimension; ++a) sum += d.across_cell(a, cell);
    return sum;
  }
  const float turn = d.along(0, 1, cell) - d.along(1, 0, cell);
  if (dimension == 2) return turn;
  return Vec3f(d.along(1, 2, cell) - d.along(2, 1, cell), d.along(2, 0, cell) - d.along(0, 2, cell), turn).norm();
}

FaceVelocity faces_of(const vdb::Frame& frame, const vdb::Grid& grid) {
  const ScalarVolume place = volume_over(frame, grid.blocks.at(0));
  return {place.cells, place.lower, place.h, grid.blocks.at(0).values};
}

ScalarVolume derived(const vdb::Frame& frame, const vdb::Grid& vectors, const std::string& quantity) {
  const FaceVelocity u = faces_of(frame, vectors);
  const std::optional<ScalarVolume> phi = level_set_of(frame);
  const Derivatives d(u, phi && phi->cells == u.cells ? phi : std::nullopt);
  ScalarVolume volume{u.cells, u.lower, u.h, {}};
  volume.values.reserve(u.values.size() / 3);
  for (int k = 0; k < u.cells[2]; ++k)
    for (int j = 0; j < u.cells[1]; ++j)
      for (int i = 0; i < u.cells[0]; ++i)
        volume.values.push_back(derived_value(quantity, u, d, frame.dimension, {i, j, k}));
  return volume;
}

[[noreturn]] void refuse_quantity(const vdb::Frame& frame, const std::string& quantity) {
  const std::vector<std::string> shown = quantities_of(frame);
  std::string text = fmt::format("--color: frame {} holds no '{}'; it can show none{}{}", frame.number, quantity,
                                 shown.empty() ? "" : ", ", fmt::join(shown, ", "));
  const QuantityRow* row = row_of(quantity);
  std::vector<std::string> known;
  for (const QuantityRow& each : quantity_rows) known.emplace_back(each.name);
  if (row)
    text += fmt::format("; '{}' needs \"{}\" in output.frames of the scene, and a new run", quantity,
                        row->from_velocity ? "velocity" : row->name);
  else if (const auto near = suggest(quantity, known))
    text += fmt::format("; did you mean '{}'?", *near);
  throw Error(ExitCode::bad_input, text);
}

}  // namespace

float FaceVelocity::at_center(const std::array<int, 3>& cell, int axis) const {
  const std::array<std::size_t, 3> stride{1, std::size_t(cells[0]), std::size_t(cells[0]) * cells[1]};
  const std::size_t c = std::size_t(cell[0]) + cell[1] * stride[1] + cell[2] * stride[2];
  const float low = values[3 * c + std::size_t(axis)];
  return cell[axis] + 1 == cells[axis] ? low : 0.5f * (low + values[3 * (c + stride[axis]) + std::size_t(axis)]);
}

Vec2f FaceVelocity::sample(const Vec2f& x) const {
  Vec2f result = Vec2f::Zero();
  for (int axis = 0; axis < 2; ++axis) {
    Vec2f index = (x - lower.head<2>()) / h;
    if (!(index.minCoeff() >= 0) || index.x() > float(cells[0]) || index.y() > float(cells[1])) return Vec2f::Zero();
    index[1 - axis] -= 0.5f;
    std::array<int, 2> low, high;
    for (int a = 0; a < 2; ++a) {
      low[a] = std::clamp(int(std::floor(index[a])), 0, cells[a] - 1);
      high[a] = std::min(low[a] + 1, cells[a] - 1);
      index[a] = std::clamp(index[a] - float(low[a]), 0.0f, 1.0f);
    }
    const auto value = [&](int i, int j) { return values[3 * (std::size_t(j) * cells[0] + i) + std::size_t(axis)]; };
    const float below = value(low[0], low[1]) + index.x() * (value(high[0], low[1]) - value(low[0], low[1]));
    const float above = value(low[0], high[1]) + index.x() * (value(high[0], high[1]) - value(low[0], high[1]));
    result[axis] = below + index.y() * (above - below);
  }
  return result;
}

std::optional<ScalarVolume> level_set_of(const vdb::Frame& frame) {
  for (const vdb::Grid& grid : frame.grids) {
    if (grid.kind != vdb::GridKind::level_set || grid.name != vdb::level_set_name(frame)) continue;
    ScalarVolume volume = volume_over(frame, grid.blocks.at(0));
    volume.values = grid.blocks.at(0).values;
    return volume;
  }
  return std::nullopt;
}

FaceVelocity velocity_of(const vdb::Frame& frame, const std::string& option) {
  const vdb::Grid* grid = velocity_grid(frame);
  if (!grid) {
    throw Error(
        ExitCode::bad_input,
        fmt::format("{}: frame {} holds no velocity; it needs \"velocity\" in output.frames of the scene, and a "
                    "new run",
                    option, frame.number));
  }
  return faces_of(frame, *grid);
}

ScalarVolume quantity_of(const vdb::Frame& frame, const std::string& quantity) {
  for (const vdb::Grid& grid : frame.grids) {
    if (grid.name != quantity || grid.kind == vdb::GridKind::level_set) continue;
    if (grid.kind == vdb::GridKind::staggered_vector) return derived(frame, grid, "speed");
    ScalarVolume volume = volume_over(frame, grid.blocks.at(0));
    volume.values = grid.blocks.at(0).values;
    return volume;
  }
  const QuantityRow* row = row_of(quantity);
  const bool in_plane = quantity != "velocity_z" || frame.dimension == 3;
  if (!row || !row->from_velocity || !velocity_grid(frame) || !in_plane) refuse_quantity(frame, quantity);
  return derived(frame, *velocity_grid(frame), quantity);
}

std::vector<std::string> quantities_of(const vdb::Frame& frame) {
  std::vector<std::string> names;
  for (const QuantityRow& row : quantity_rows) {
    const bool in_plane = std::string_view(row.name) != "velocity_z" || frame.dimension == 3;
    if (row.from_velocity && in_plane && velocity_grid(frame)) names.emplace_back(row.name);
  }
  for (const vdb::Grid& grid : frame.grids) {
    const bool listed = std::find(names.begin(), names.end(), grid.name) != names.end();
    if (grid.kind == vdb::GridKind::scalar && !listed) names.push_back(grid.name);
  }
  return names;
}

std::string label_of(const std::string& quantity) {
  const QuantityRow* row = row_of(quantity);
  return row ? fmt::format("{} ({})", quantity, row->unit) : quantity;
}

bool has_sign(const std::string& quantity, int dimension) {
  const QuantityRow* row = row_of(quantity);
  return row && row->is_signed && !(quantity == "vorticity" && dimension == 3);
}

}  // namespace seiche::render
