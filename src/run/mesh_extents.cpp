#include "run/mesh_extents.h"

#include <fmt/format.h>

#include <array>

#include "base/error.h"
#include "base/scene.h"
#include "geometry/mesh/extent.h"
#include "solid/mesh/file.h"

namespace seiche {
namespace {

constexpr double too_wide = 4;  // domain widths; millimetres and inches taken for metres are wrong by 1000 and 39

struct Unit {
  double scale;
  const char* name;
};
constexpr std::array<Unit, 4> units{
    {{1e-3, "millimetres"}, {1e-2, "centimetres"}, {0.0254, "inches"}, {1e-6, "micrometres"}}};

bool is_surface_file(const ShapeSpec& shape) {
  return shape.kind == "mesh" && !holds_elements(shape.file);
}

// Suggests a unit in which the mesh fits the domain and is resolved by its cells.
std::string remedy(const DomainSpec& domain, double longest, double width, double scale) {
  for (const Unit& unit : units) {
    const double fitting = width * unit.scale;
    if (fitting > longest || fitting < 2 * domain.cell_size) continue;
    return fmt::format("is it in {}? scale = {:g} makes it {:.3g} m", unit.name, scale * unit.scale, fitting);
  }
  return "give it a smaller scale";
}

// Empty if the width is plausible.
std::string fault(const Scene& scene, const ShapeSpec& shape, const std::string& name) {
  const DomainSpec& domain = scene.domain;
  const double longest = (domain.upper - domain.lower).maxCoeff(), scale = shape.transform.scale;
  const Vec3 extent = scene.dimension == 2 ? polyline_extent(shape.file) : mesh_extent(shape.file);
  const double width = scale * extent.maxCoeff();
  if (width <= too_wide * longest) return "";
  return fmt::format("{}: {} is {:.3g} m wide, the domain {:.3g} m; {}", shape.where, name, width, longest,
                     remedy(domain, longest, width, scale));
}

}  // namespace

std::vector<std::string> check_mesh_extents(const Scene& scene) {
  std::vector<std::string> notes;
  std::string faults;
  const auto look_at = [&](const ShapeSpec& shape, const std::string& name, bool refuse) {
    if (!is_surface_file(shape)) return;
    const std::string text = fault(scene, shape, name);
    if (text.empty()) return;
    if (refuse) faults += (faults.empty() ? "" : "\n") + text;
    if (!refuse) notes.push_back(text);
  };
  for (const SolidSpec& solid : scene.solids) look_at(solid.shape, "'" + solid.name + "'", solid.kind.is_free());
  for (const auto& region : scene.liquid.regions) look_at(region.shape, "a region of liquid", false);
  for (const auto& source : scene.liquid.sources) look_at(source.shape, "a source of liquid", false);
  for (const auto& drain : scene.liquid.drains) look_at(drain.shape, "a drain of liquid", false);
  if (!faults.empty()) throw Error(ExitCode::bad_input, faults);
  return notes;
}

}  // namespace seiche
