#include <fmt/format.h>

#include "base/agree.h"
#include "charts/columns.h"
#include "charts/run.h"
#include "render/run.h"
#include "verbs.h"

namespace seiche {
namespace {

struct PlotWords {
  std::vector<std::string> runs;
  std::string out, size;
  charts::PlotOptions options;
};

void plot_tables(PlotWords words) {
  charts::PlotOptions& options = words.options;
  options.runs.assign(words.runs.begin(), words.runs.end());
  options.out = words.out;
  if (!words.size.empty()) {
    const auto [width, height] = render::parse_size(words.size);
    options.width = width;
    options.height = height;
  }
  fmt::print("{}\n", charts::plot_runs(options).string());
}

}  // namespace

void add_plot(CLI::App& program, VerbContext& context) {
  auto* verb = program.add_subcommand("plot", "Plot columns of the tables of runs over time");
  auto words = std::make_shared<PlotWords>();
  verb->add_option("directories", words->runs, "Directories of runs; their curves share the panels")->required();
  verb->add_option(
          "--file", words->options.table,
          fmt::format("Table: {}; default: the first with the columns", fmt::join(charts::table_names(), ", ")))
      ->check(CLI::IsMember(charts::table_names()));
  verb->add_option("--columns", words->options.columns,
                   "Columns, or groups such as energy, volume, force, by commas; default: a sheet of the most useful")
      ->delimiter(',');
  verb->add_option("--names", words->options.names, "Solids, probes or joints, by commas; default: all")
      ->delimiter(',');
  verb->add_option("--out", words->out, "Picture: .png, .svg or .pdf; default: pictures/plot.png of the first run");
  verb->add_option("--size", words->size, "Width and height in pixels; default: by the number of panels");
  verb->add_flag("--log", words->options.logarithmic, "Logarithmic axes of the values");
  verb->add_option("--font", words->options.font, "Font of the texts, a family or a file; default: DejaVu Sans");
  verb->callback([words, &context] {
    context.action = [words, &context] {
      agree_on_root(context.ranks, "plotting " + words->runs.front(), [&] { plot_tables(*words); });
      return ExitCode::done;
    };
  });
}

}  // namespace seiche
