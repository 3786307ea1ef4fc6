#include "validate/report/charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "base/scene.h"
#include "files/checked_file.h"
#include "files/frames.h"
#include "render/frame.h"
#include "render/run.h"

namespace seiche {
namespace {

constexpr std::size_t most_curves = 6;

std::vector<ReportedResult> measured_of(const std::vector<ReportedResult>& rows) {
  std::vector<ReportedResult> measured;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(measured),
               [](const ReportedResult& row) { return is_measured(row.result); });
  return measured;
}

// Line of slope `order` through the finest error of the first curve.
Curve slope_line(const Points& points, double order) {
  const auto fine = *std::min_element(points.begin(), points.end());
  const auto coarse = *std::max_element(points.begin(), points.end());
  const auto at = [&](double h) { return std::pair(h, fine.second * std::pow(h / fine.first, order)); };
  return {fmt::format("order {:g}", order), {at(fine.first), at(coarse.first)}, Curve::Style::dashes};
}

// Values in the units of a plot's axes.
Points in_units(Points points, const PlotSpec& plot) {
  if (plot.data.empty()) return points;
  const double time_unit = constant(plot.time_unit), value_unit = constant(plot.value_unit);
  for (auto& [time, value] : points) time /= time_unit, value /= value_unit;
  return points;
}

// Series of the reference: from the plot's data or the front's.
Points reference_series(const CaseSpec& one) {
  if (!one.plot.data.empty()) return csv_points(read_whole_file(one.plot.data));
  if (one.measure.kind == "front_slope") return csv_points(read_whole_file(one.measure.data));
  return {};
}

void name_axes(const CaseSpec& one, Chart& chart) {
  const MeasureSpec& m = one.measure;
  chart.x = one.plot.data.empty() ? "time, s" : one.plot.x;
  chart.y = one.plot.data.empty() ? fmt::format("{} {}", m.probe.empty() ? m.solid : m.probe, m.column) : one.plot.y;
  if (m.kind == "front_slope") chart.x = "time / unit", chart.y = "length / unit";
}

}  // namespace

Chart error_chart(const std::vector<ReportedResult>& all) {
  Chart chart{"cell size, m", "error", Chart::Axes::logarithmic, {}};
  using Series = std::pair<std::string, Formula>;
  std::map<Series, Points> errors;
  std::map<Series, std::string> names;  // or name of its first run
  Points bars;
  for (const ReportedResult& row : measured_of(all)) {
    const Series series(row.resolution.series, reference_of(row.one, row.resolution));
    errors[series].emplace_back(row.result.cell_size, row.result.measured.error);
    names.emplace(series, row.resolution.series.empty() ? "from " + row.resolution.name : row.resolution.series);
    bars.emplace_back(row.result.cell_size, *max_error_of(row.one, row.resolution));
  }
  std::sort(bars.begin(), bars.end());
  if (bars.empty() || bars.front().first == bars.back().first) return chart;
  for (auto& [series, points] : errors) {
    std::sort(points.begin(), points.end());
    if (chart.curves.size() < most_curves)
      chart.curves.push_back(
          {errors.size() == 1 ? "error" : "error, " + names[series], points, Curve::Style::line_and_marks});
  }
  chart.curves.push_back({"bar", bars, Curve::Style::marks});
  chart.curves.push_back(slope_line(chart.curves[0].points, all[0].one.min_order.value_or(2)));
  return chart;
}

Chart share_chart(const std::vector<ReportedResult>& all) {
  Chart chart{"run, by its row in the table", "error / bar", Chart::Axes::linear, {}};
  Points shares;
  for (std::size_t n = 0; n < all.size(); ++n)
    if (is_measured(all[n].result))
      shares.emplace_back(double(n + 1), all[n].result.measured.error / *max_error_of(all[n].one, all[n].resolution));
  if (shares.size() < 2 || !error_chart(all).curves.empty()) return chart;
  chart.curves.push_back({"error", shares, Curve::Style::marks});
  chart.curves.push_back({"bar", {{shares.front().first, 1}, {shares.back().first, 1}}, Curve::Style::dashes});
  return chart;
}

Chart series_chart(const std::vector<ReportedResult>& all) {
  Chart chart;
  const CaseSpec& one = all[0].one;
  name_axes(one, chart);
  try {
    if (const Points points = reference_series(one); !points.empty())
      chart.curves.push_back({"reference", points, Curve::Style::marks});
    for (const ReportedResult& row : measured_of(all)) {
      if (row.result.recorded) continue;
      const Points points = measured_series(measure_of(row.one, row.resolution), RunPaths{row.result.run});
      if (!points.empty() && chart.curves.size() < most_curves)
        chart.curves.push_back({row.resolution.name, in_units(points, one.plot), Curve::Style::line});
    }
  } catch (const Error&) {  // unreadable data cannot be plotted; the figures remain
    chart.curves.clear();
  }
  return chart;
}

Picture last_picture(const std::filesystem::path& run) {
  try {
    const RunPaths paths{run};
    const std::vector<int> frames = render::list_frames(paths.frames());
    if (frames.empty()) return {"", "the run wrote no frames"};
    if (read_scene(paths.scene(), {}).output.frames.empty()) return {"", "the run's frames hold no fields"};
    render::RenderOptions options;
    options.run = run;
    options.width = 640;
    options.height = 400;
    options.frames = std::to_string(frames.back());
    render::render_run(options, [](const std::string&) {});
    return {read_whole_file(run / "pictures" / frame_file("frame", frames.back(), "png")), ""};
  } catch (const Error& error) {
    return {"", error.what()};
  }
}

}  // namespace seiche
