#include "render/frame.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "base/expression.h"
#include "base/solid_spec.h"
#include "files/frames.h"
#include "files/vtu_reader.h"
#include "geometry/shapes/shapes.h"

namespace seiche::render {
namespace {

ScalarVolume empty_volume(const vdb::Frame& frame, const vdb::Block& block) {
  ScalarVolume volume;
  for (int a = 0; a < 3; ++a) volume.cells[a] = block.upper[a] - block.lower[a];
  volume.lower = frame.lower.cast<float>();
  volume.h = float(frame.cell_size);
  return volume;
}

// Lengths of the vectors averaged from the faces of each cell. The last cell of an axis uses its low face only.
std::vector<float> lengths(const std::vector<float>& faces, const std::array<int, 3>& cells) {
  const std::array<std::size_t, 3> stride{1, std::size_t(cells[0]), std::size_t(cells[0]) * cells[1]};
  std::vector<float> result(faces.size() / 3);
  for (std::size_t c = 0; c < result.size(); ++c) {
    float square = 0;
    for (int a = 0; a < 3; ++a) {
      const bool last = int(c / stride[a] % cells[a]) + 1 == cells[a];
      const float mean = last ? faces[3 * c + a] : 0.5f * (faces[3 * c + a] + faces[3 * (c + stride[a]) + a]);
      square += mean * mean;
    }
    result[c] = std::sqrt(square);
  }
  return result;
}

// A moving shape at one time: maps x to the rest pose and evaluates the shape there.
class PlacedShape {
 public:
  PlacedShape(const SolidSpec& solid, double cell_size, double time)
      : center_(solid.motion.center), shape_(make_shape<3>(solid.shape, {cell_size, nullptr})) {
    if (!solid.kind.is_prescribed()) return;
    translate_ = VectorExpression(solid.motion.translate)(Vec3::Zero(), time);
    const double degrees = Expression(solid.motion.degrees)(Vec3::Zero(), time);
    back_ = Eigen::AngleAxisd(-degrees * M_PI / 180, solid.motion.axis.normalized()).toRotationMatrix();
  }
  double operator()(const Vec3& x) const { return (*shape_)(center_ + back_ * (x - translate_ - center_)); }

 private:
  Vec3 center_, translate_ = Vec3::Zero();
  Eigen::Matrix3d back_ = Eigen::Matrix3d::Identity();
  std::unique_ptr<ShapeField<3>> shape_;
};

std::string grid_names(const vdb::Frame& frame) {
  std::string names = "none";
  for (const vdb::Grid& grid : frame.grids) {
    if (grid.kind != vdb::GridKind::level_set) names += ", " + (grid.name == "vel" ? "speed" : grid.name);
  }
  return names;
}

}  // namespace

std::optional<ScalarVolume> level_set_of(const vdb::Frame& frame) {
  for (const vdb::Grid& grid : frame.grids) {
    if (grid.kind != vdb::GridKind::level_set || grid.name != vdb::level_set_name(frame)) continue;
    ScalarVolume volume = empty_volume(frame, grid.blocks.at(0));
    volume.values = grid.blocks.at(0).values;
    return volume;
  }
  return std::nullopt;
}

ScalarVolume quantity_of(const vdb::Frame& frame, const std::string& quantity) {
  const std::string name = quantity == "speed" ? "vel" : quantity;
  for (const vdb::Grid& grid : frame.grids) {
    if (grid.name != name || grid.kind == vdb::GridKind::level_set) continue;
    const vdb::Block& block = grid.blocks.at(0);
    ScalarVolume volume = empty_volume(frame, block);
    const bool vectors = grid.kind == vdb::GridKind::staggered_vector;
    volume.values = vectors ? lengths(block.values, volume.cells) : block.values;
    return volume;
  }
  throw Error(ExitCode::bad_input, fmt::format("--color: frame {} holds no '{}'; it can show {}", frame.number,
                                               quantity, grid_names(frame)));
}

std::string label_of(const std::string& quantity) {
  if (quantity == "speed") return "speed m/s";
  if (quantity == "pressure") return "pressure Pa";
  if (quantity == "vorticity") return "vorticity 1/s";
  return quantity == "viscosity" ? "viscosity Pa s" : quantity;
}

LoadedFrame load_frame(const std::filesystem::path& frames, int number, const std::string& quantity) {
  const vdb::Frame decoded = vdb::decode(frames / frame_file("frame", number, "vdb"));
  if (decoded.grids.empty()) {
    throw Error(ExitCode::bad_input, fmt::format("{}: holds no grid", frame_file("frame", number, "vdb")));
  }
  LoadedFrame frame{decoded.dimension, number, decoded.time, {}, level_set_of(decoded), {}, {}};
  frame.domain = empty_volume(decoded, decoded.grids[0].blocks.at(0)).box();
  if (quantity != "none") frame.quantity = quantity_of(decoded, quantity);
  const std::filesystem::path solids = frames / frame_file("solids", number, "vtu");
  if (std::filesystem::exists(solids)) frame.solids = read_solids(solids);
  return frame;
}

std::vector<int> list_frames(const std::filesystem::path& frames) {
  std::vector<int> numbers;
  std::error_code missing;
  for (const auto& entry : std::filesystem::directory_iterator(frames, missing)) {
    const std::string name = entry.path().filename().string();
    const std::string digits = name.size() > 10 ? name.substr(6, name.size() - 10) : "";
    const bool plain =
        !digits.empty() && digits.size() < 10 && digits.find_first_not_of("0123456789") == std::string::npos;
    if (plain && frame_file("frame", std::stoi(digits), "vdb") == name) numbers.push_back(std::stoi(digits));
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

void clip_to_containers(LoadedFrame& frame, const std::vector<SolidSpec>& solids) {
  if (frame.dimension != 3 || !frame.phi) return;
  ScalarVolume& phi = *frame.phi;
  for (const SolidSpec& solid : solids) {
    if (!solid.shape.invert) continue;
    const PlacedShape shape(solid, phi.h, frame.time);
    for (std::size_t c = 0; c < phi.values.size(); ++c) {
      if (phi.values[c] >= 3 * phi.h) continue;
      const Vec3 index(double(c % phi.cells[0]), double(c / phi.cells[0] % phi.cells[1]),
                       double(c / (std::size_t(phi.cells[0]) * phi.cells[1])));
      const Vec3 x = phi.lower.cast<double>() + phi.h * (index + Vec3::Constant(0.5));
      // cut half a cell inside the solid, so that the liquid still reaches the solid's surface
      phi.values[c] = std::max(phi.values[c], std::min(float(-shape(x) - 0.5 * phi.h), 3 * phi.h));
    }
  }
}

}  // namespace seiche::render
