#include "render/frame.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "base/solid_spec.h"
#include "files/frames.h"
#include "files/vtu_reader.h"
#include "render/placed_shape.h"

namespace seiche::render {

LoadedFrame load_frame(const std::filesystem::path& frames, int number, const FrameWants& wants) {
  const vdb::Frame decoded = vdb::decode(frames / frame_file("frame", number, "vdb"));
  if (decoded.grids.empty()) {
    throw Error(ExitCode::bad_input, fmt::format("{}: holds no grid", frame_file("frame", number, "vdb")));
  }
  LoadedFrame frame{decoded.dimension, number, decoded.time, {}, level_set_of(decoded), {}, {}, {}, decoded.points};
  const vdb::Block& block = decoded.grids[0].blocks.at(0);
  frame.domain.lower = decoded.lower.cast<float>();
  for (int a = 0; a < 3; ++a)
    frame.domain.upper[a] = frame.domain.lower[a] + float(decoded.cell_size) * float(block.upper[a] - block.lower[a]);
  if (wants.quantity != "none") frame.quantity = quantity_of(decoded, wants.quantity);
  if (!wants.velocity.empty()) frame.velocity = velocity_of(decoded, wants.velocity);
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
    const PlacedShape<3> shape(solid, phi.h, frame.time);
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
