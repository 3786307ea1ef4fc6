// Measures of frames.
#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "files/checked_file.h"
#include "validate/measure/contour.h"
#include "validate/measure/frames.h"
#include "validate/measure/kinds.h"
#include "validate/measure/lines.h"

namespace seiche {
namespace {

namespace fs = std::filesystem;

// Rejects values that are not finite: comparisons would silently skip them.
vdb::Frame read_frame(const fs::path& file) {
  vdb::Frame frame = vdb::decode(file);
  for (const vdb::Grid& grid : frame.grids)
    for (const vdb::Block& block : grid.blocks)
      if (!std::ranges::all_of(block.values, [](float value) { return std::isfinite(value); }))
        throw Error(ExitCode::cannot_continue,
                    fmt::format("{}: '{}' holds a value that is not a finite number", file.string(), grid.name));
  return frame;
}

vdb::Frame last_frame(const RunPaths& run) {
  fs::path last;
  for (const auto& entry : fs::directory_iterator(run.frames())) {
    if (entry.path().extension() == ".vdb") last = std::max(last, entry.path());
  }
  return read_frame(last);
}

// Circularities of all frames over time.
Points circularities(const MeasureSpec&, const RunPaths& run) {
  Points points;
  for (const auto& entry : fs::directory_iterator(run.frames())) {
    if (entry.path().extension() != ".vdb") continue;
    const vdb::Frame frame = read_frame(entry.path());
    points.emplace_back(frame.time, circularity(frame));
  }
  std::sort(points.begin(), points.end());
  return points;
}

Measurement least_circularity(const MeasureSpec& spec, const RunPaths& run) {
  double least = 1;
  for (const auto& [time, value] : points_during(circularities(spec, run), spec.from, spec.to))
    least = std::min(least, value);
  const double reference = constant(spec.reference);
  return {least, reference, std::abs(least - reference)};
}

// Vertex of the parabola through the frame of least circularity and its neighbours.
Measurement least_circularity_time(const MeasureSpec& spec, const RunPaths& run) {
  const Points points = points_during(circularities(spec, run), spec.from, spec.to);
  const auto least = std::ranges::min_element(points, {}, [](const auto& point) { return point.second; });
  if (least == points.begin() || least + 1 == points.end())
    throw Error(ExitCode::cannot_continue, "the least circularity is that of the first or last frame of the time");
  const double before = least->first - (least - 1)->first, after = (least + 1)->first - least->first;
  const double fall = (least->second - (least - 1)->second) / before;
  const double rise = ((least + 1)->second - least->second) / after;
  // The slopes are at the midpoints between frames; between these the slope is linear.
  const double time = least->first - 0.5 * before - 0.5 * fall * (before + after) / (rise - fall);
  return against(time, constant(spec.reference));
}

Measurement vector_l2(const MeasureSpec& spec, const RunPaths& run) {
  return itself(velocity_difference(last_frame(run), spec.velocity, "-1"));
}

Measurement region_l2(const MeasureSpec& spec, const RunPaths& run) {
  return itself(velocity_difference(last_frame(run), spec.velocity, spec.region));
}

Measurement region_max(const MeasureSpec& spec, const RunPaths& run) {
  return itself(largest_velocity_difference(last_frame(run), spec.velocity, spec.region));
}

Measurement line_extrema(const MeasureSpec& spec, const RunPaths& run) {
  const vdb::Frame frame = last_frame(run);
  double worst = 0;
  for (const LineExtreme& line : csv_extremes(read_whole_file(spec.data)))
    worst = larger(worst, std::abs(extreme_along(frame, line).value / line.value - 1));
  return itself(worst);
}

// Largest distance of an extreme from its expected position, m.
Measurement line_extrema_places(const MeasureSpec& spec, const RunPaths& run) {
  const vdb::Frame frame = last_frame(run);
  double worst = 0;
  for (const LineExtreme& line : csv_extremes(read_whole_file(spec.data)))
    worst = larger(worst, std::abs(extreme_along(frame, line).place - line.value));
  return itself(worst);
}

Measurement stream_function(const MeasureSpec& spec, const RunPaths& run) {
  return against(stream_function_extreme(last_frame(run)), constant(spec.reference));
}

// Largest deviation over all points of the profile, m/s.
Measurement line_deviation(const MeasureSpec& spec, const RunPaths& run) {
  const vdb::Frame frame = last_frame(run);
  double worst = 0;
  for (const LinePoint& at : csv_profile(read_whole_file(spec.data)))
    worst = larger(worst, std::abs(value_along(frame, at) - at.value));
  return itself(worst);
}

Measurement surface_deviation(const MeasureSpec& spec, const RunPaths& run) {
  return itself(surface_difference(last_frame(run), spec.surface) / constant(spec.length_unit));
}

Measurement misplaced(const MeasureSpec& spec, const RunPaths& run) {
  return itself(surface_misplaced(last_frame(run), spec.surface) / constant(spec.unit));
}

}  // namespace

std::vector<MeasureKind> measures_of_frames() {
  return {
      {"vector_l2", {"velocity"}, vector_l2},
      {"region_l2", {"velocity", "region"}, region_l2},
      {"region_max", {"velocity", "region"}, region_max},
      {"line_extrema", {"data"}, line_extrema},
      {"line_extrema_places", {"data"}, line_extrema_places},
      {"stream_function_extreme", {"reference"}, stream_function},
      {"line_deviation", {"data"}, line_deviation},
      {"surface_deviation", {"surface", "length_unit"}, surface_deviation},
      {"circularity", {"from", "to", "reference"}, least_circularity, circularities},
      {"circularity_time", {"from", "to", "reference"}, least_circularity_time, circularities},
      {"surface_misplaced", {"surface", "unit"}, misplaced},
  };
}

}  // namespace seiche
