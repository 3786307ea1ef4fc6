#include "charts/run.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "charts/panels.h"
#include "files/checked_file.h"
#include "files/run_directory.h"
#include "render/painter.h"
#include "render/png_writer.h"

namespace seiche::charts {
namespace {

using render::Format;

std::vector<RunTables> open_runs(const PlotOptions& options) {
  std::vector<RunTables> runs;
  for (const std::filesystem::path& run : options.runs) {
    if (!std::filesystem::is_directory(run)) {
      throw Error(ExitCode::bad_input,
                  fmt::format("{}: there is no such folder; give the directory of a run", run.string()));
    }
    const std::filesystem::path clean = (run / "").lexically_normal().parent_path();
    RunTables tables;
    tables.label = options.runs.size() > 1 ? clean.filename().string() : "";
    tables.folder = run;
    tables.read_scene_of_run();
    runs.push_back(std::move(tables));
  }
  for (std::size_t n = 1; n < runs.size(); ++n)  // the same last name: whole paths tell runs apart
    for (std::size_t m = 0; m < n; ++m)
      if (runs[m].label == runs[n].label)
        runs[m].label = options.runs[m].string(), runs[n].label = options.runs[n].string();
  return runs;
}

Format format_of(const std::filesystem::path& out) {
  const std::string extension = out.extension().string();
  const Format format = render::parse_format(extension.empty() ? "" : extension.substr(1), "--out");
  if (format == Format::exr)
    throw Error(ExitCode::bad_input, "--out: plots are drawn as png, svg or pdf; name such a file");
  return format;
}

std::array<int, 2> size_of(const PlotOptions& options, std::size_t panels) {
  if (options.width > 0) return {options.width, options.height};
  if (panels == 1) return {800, 480};
  return panels == 2 ? std::array<int, 2>{1280, 420} : std::array<int, 2>{1280, 380 * int((panels + 1) / 2)};
}

}  // namespace

std::filesystem::path plot_runs(const PlotOptions& options) {
  std::filesystem::path out = options.out;
  if (out.empty()) out = RunPaths{options.runs.at(0)}.pictures() / "plot.png";
  const Format format = format_of(out);
  std::vector<RunTables> runs = open_runs(options);
  PlotOptions wanted = options;
  const bool has_table = !options.table.empty();
  if (has_table && !runs[0].table(options.table)) {
    throw Error(ExitCode::bad_input, fmt::format("--file: {} has no {}.csv", options.runs[0].string(), options.table));
  }
  if (has_table && options.columns.empty())  // all of that table
    wanted.columns = runs[0].table(options.table)->columns, std::erase(wanted.columns, "time");
  const std::vector<Panel> panels =
      wanted.columns.empty() ? usual_panels(runs, wanted) : panels_of_columns(runs, wanted);
  if (panels.empty()) {
    throw Error(ExitCode::bad_input,
                fmt::format("{}: its tables hold nothing to plot; give the directory of a run that has made a step",
                            options.runs[0].string()));
  }
  const auto [width, height] = size_of(options, panels.size());
  render::Painter painter(width, height, format, options.font);
  draw_sheet(painter, panels);
  if (options.out.empty()) make_folder(out.parent_path());
  if (format == Format::png)
    render::write_png(out, painter.image());
  else
    write_file(out, painter.page());
  return out;
}

}  // namespace seiche::charts
