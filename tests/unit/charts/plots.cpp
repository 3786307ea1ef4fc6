// Plots of the tables of runs.
#include <catch2/catch.hpp>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "charts/columns.h"
#include "charts/panels.h"
#include "files/checked_file.h"
#include "files/csv.h"
#include "render/png_writer.h"
#include "unit/render/common.h"

namespace plots_tests {
using namespace seiche;
using namespace seiche::charts;
using seiche::testing::message_of;
namespace fs = std::filesystem;

namespace {

// A folder that is removed at the end of the test.
struct Scratch {
  fs::path folder = fs::temp_directory_path() / ("seiche_plots_" + std::to_string(getpid()));
  Scratch() { fs::create_directories(folder / "a"); }
  ~Scratch() { fs::remove_all(folder); }
};

// A run of `steps` steps of 0.1 s, in which a ball falls and a probe measures.
void store_run(const fs::path& run, int steps) {
  fs::create_directories(run);
  std::string stats = stats_header(), solids = solids_header(), probes = probes_header();
  for (int n = 0; n <= steps; ++n) {
    StepStats step;
    step.step = n;
    step.time = 0.1 * n;
    step.dt = 0.1;
    step.liquid_volume = 0.25;
    step.kinetic_energy = n * n;
    step.potential_energy = 100 - n * n;
    step.solver_iterations = 10 + n % 3;
    stats += stats_row(step);
    for (const char* name : {"ball", "box"}) {
      SolidState solid;
      solid.name = name;
      solid.position = Vec3(1, -0.5 * n * n, 0);
      solids += solids_row(step.time, solid);
    }
    probes += probes_row(step.time, {"gauge, left", false, n != 2, 5.0 * n, {}});
  }
  write_file(run / "stats.csv", stats);
  write_file(run / "solids.csv", solids);
  write_file(run / "probes.csv", probes);
}

RunTables run_at(const std::string& label, const fs::path& folder) {
  RunTables run;
  run.label = label;
  run.folder = folder;
  run.read_scene_of_run();
  return run;
}

std::vector<Panel> panels_for(const fs::path& run, const std::vector<std::string>& columns) {
  PlotOptions options;
  options.runs = {run};
  options.columns = columns;
  std::vector<RunTables> runs{run_at("", run)};
  return columns.empty() ? usual_panels(runs, options) : panels_of_columns(runs, options);
}

}  // namespace

TEST_CASE("tables come back with names that hold commas, gaps, and without the line that is being written") {
  const Scratch scratch;
  store_run(scratch.folder / "a", 3);
  const Table probes = read_table(scratch.folder / "a" / "probes.csv");
  CHECK(probes.entities() == std::vector<std::string>{"gauge, left"});
  REQUIRE(probes.rows() == 4);
  CHECK(std::isnan(probes.values[probes.find("value")][2]));
  CHECK(probes.values[probes.find("value")][3] == 15);
  const fs::path file = scratch.folder / "stats.csv";
  write_file(file, "time,dt\n0,1\n0.5,2\n0.7,");
  CHECK(read_table(file).rows() == 2);
  write_file(file, "time,dt\n0,1\n0.5\n");
  CHECK_THAT(message_of([&] { read_table(file); }), Catch::Contains("stats.csv:3: has 1 cells, and the header 2"));
  write_file(file, "time,dt\n0,x\n");
  CHECK_THAT(message_of([&] { read_table(file); }), Catch::Contains("stats.csv:2: 'x' in column dt is not a number"));
  write_file(file, "a,b\n");
  CHECK_THAT(message_of([&] { read_table(file); }), Catch::Contains("no column 'time'"));
  CHECK_THAT(message_of([&] { read_table(scratch.folder / "none.csv"); }), Catch::Contains("there is no such table"));
}

TEST_CASE("every column of the tables that docs/outputs.md gives a unit has it in plots, and no other") {
  std::ifstream file(fs::path(__FILE__).parent_path() / "../../../docs/outputs.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  const std::pair<std::string, std::string> tables[] = {
      {"stats", stats_header()}, {"solids", solids_header()}, {"joints", joints_header()}, {"probes", probes_header()}};
  for (const auto& [table, header] : tables) {
    const std::size_t from = page.find("## " + table + ".csv");
    REQUIRE(from != std::string::npos);
    std::istringstream section(page.substr(from, page.find("\n## ", from) - from));
    for (std::string line; std::getline(section, line);) {
      if (!line.starts_with("| `")) continue;
      const std::size_t names_end = line.find(" | "), unit_end = line.find("|", names_end + 2);
      std::string unit = line.substr(names_end + 2, unit_end - names_end - 2);
      unit.erase(0, unit.find_first_not_of(' '));
      unit.erase(unit.find_last_not_of(' ') + 1);
      if (unit == "1/s") unit = "s⁻¹";
      for (std::size_t at = 2; at < names_end;) {
        const std::size_t end = line.find('`', at + 1);
        const std::string column = line.substr(at + 1, end - at - 1);
        INFO(table << " " << column);
        CHECK(unit_of(table, column) == unit);
        at = std::min(line.find('`', end + 1), line.size());
      }
    }
  }
}

TEST_CASE("columns share a panel where their units agree, groups stand for several") {
  const Scratch scratch;
  const fs::path run = scratch.folder / "a";
  store_run(run, 5);
  const std::vector<Panel> panels = panels_for(run, {"energy", "dt", "solver_iterations"});
  REQUIRE(panels.size() == 3);
  CHECK(panels[0].curves.size() == 3);
  CHECK(panels[0].title == "energy (J)");
  CHECK(panels[0].curves[0].value[3] == 9);
  CHECK(panels[1].title == "dt (s)");
  CHECK(panels[2].title == "solver_iterations");
  const std::vector<Panel> places = panels_for(run, {"x", "y"});  // in solids.csv
  REQUIRE(places.size() == 1);
  REQUIRE(places[0].curves.size() == 4);
  CHECK(places[0].title == "x, y (m)");
  CHECK(places[0].curves[2].label == "y, ball");
  CHECK(places[0].curves[2].value == std::vector<double>{0, -0.5, -2, -4.5, -8, -12.5});
}

TEST_CASE("the usual sheet has energy, volume, step, iterations and probes, without columns that stay zero") {
  const Scratch scratch;
  store_run(scratch.folder / "a", 5);
  const std::vector<Panel> panels = panels_for(scratch.folder / "a", {});
  std::vector<std::string> titles;
  for (const Panel& panel : panels) titles.push_back(panel.title);
  CHECK(titles == std::vector<std::string>{"energy (J)", "volume (m³)", "step (s)", "iterations a step", "probes"});
  REQUIRE(panels[0].curves.size() == 2);       // nothing is elastic
  CHECK(panels[0].curves[1].value[5] == -25);  // less the potential energy of the start
}

TEST_CASE("the scene of a run decides units: per metre of depth in 2D, and by kind of probe") {
  const Scratch scratch;
  const fs::path run = scratch.folder / "a";
  store_run(run, 2);
  write_file(run / "scene.toml",
             "dimension = 2\n[domain]\nlower = [0.0, 0.0]\nupper = [1.0, 1.0]\ncell_size = 0.1\n[time]\nend = 1.0\n"
             "[[probe]]\nname = \"gauge\"\nkind = \"pressure\"\nposition = [0.5, 0.5]\n");
  const std::vector<Panel> panels = panels_for(run, {});
  CHECK(panels[0].title == "energy (J/m)");
  CHECK(panels[1].title == "volume (m²)");
  CHECK(unit_in_2d("N m") == "N");
  CHECK(unit_in_2d("m/s") == "m/s");
}

TEST_CASE("columns, names, tables and files that are not there are refused with those that are") {
  const Scratch scratch;
  const fs::path run = scratch.folder / "a";
  store_run(run, 2);
  PlotOptions options;
  options.runs = {run};
  options.columns = {"kinetic_enrgy"};
  CHECK_THAT(message_of([&] { plot_runs(options); }),
             Catch::Contains("no table has 'kinetic_enrgy'; did you mean 'kinetic_energy'?") &&
                 Catch::Contains("stats.csv has step, time, dt,") && Catch::Contains("the groups energy, volume"));
  options.columns = {"fx"};
  options.table = "stats";
  CHECK_THAT(message_of([&] { plot_runs(options); }), Catch::Contains("stats.csv has no 'fx'"));
  options.table = "joints";
  CHECK_THAT(message_of([&] { plot_runs(options); }), Catch::Contains("has no joints.csv"));
  options.table = "solids";
  options.names = {"bal"};
  CHECK_THAT(message_of([&] { plot_runs(options); }), Catch::Contains("did you mean 'ball'?; it has ball, box"));
  options.names.clear();
  options.out = run / "plot.jpg";
  CHECK_THAT(message_of([&] { plot_runs(options); }), Catch::Contains("formats are png, svg, pdf"));
  options.out.clear();
  options.runs = {scratch.folder / "nothing"};
  CHECK_THAT(message_of([&] { plot_runs(options); }), Catch::Contains("there is no such folder"));
}

TEST_CASE("runs are compared on one plot, written as PNG, SVG or PDF") {
  const Scratch scratch;
  store_run(scratch.folder / "a", 2);
  store_run(scratch.folder / "b", 4);
  PlotOptions options;
  options.runs = {scratch.folder / "a", scratch.folder / "b" / ""};
  CHECK(render::read_png(plot_runs(options)).width == 1280);
  options.columns = {"volume"};
  options.out = scratch.folder / "volume.svg";
  plot_runs(options);
  CHECK(read_whole_file(options.out).find("<svg") != std::string::npos);
  options.out = scratch.folder / "volume.pdf";
  plot_runs(options);
  CHECK(read_whole_file(options.out).starts_with("%PDF"));
  std::vector<RunTables> runs{run_at("a", scratch.folder / "a"), run_at("b", scratch.folder / "b")};
  const std::vector<Panel> panels = panels_of_columns(runs, options);
  REQUIRE(panels.size() == 1);
  REQUIRE(panels[0].curves.size() == 2);
  CHECK(panels[0].curves[0].label == "liquid_volume, a");
  CHECK(panels[0].curves[1].value.size() == 5);
}

TEST_CASE("axes hold all values, constants lie in the middle, logarithms leave out what is not positive") {
  Panel panel{"", {{"", {0, 1, 2}, {-1, 3, NAN}}}};
  CHECK(range_of(panel).low == Approx(-1.2));
  CHECK(range_of(panel).high == Approx(3.2));
  panel.curves[0].value = {5, 5, 5};
  CHECK(range_of(panel).low == Approx(4.5));
  CHECK(range_of(panel).high == Approx(5.5));
  panel.curves[0].value = {0, 1e-6, 1e-2};
  panel.logarithmic = true;
  CHECK(range_of(panel).low > 1e-7);
  CHECK(range_of(panel).low < 1e-6);
}

TEST_CASE("long curves are thinned without losing a peak or a gap") {
  Curve curve;
  for (int n = 0; n < 100000; ++n) curve.time.push_back(n), curve.value.push_back(std::sin(1e-3 * n));
  curve.value[54321] = 50;
  curve.value[77777] = NAN;
  const Curve few = thinned(curve, 0, 99999, 500);
  CHECK(few.time.size() < 2100);
  CHECK(std::count(few.value.begin(), few.value.end(), 50.0) == 1);
  CHECK(std::count_if(few.value.begin(), few.value.end(), [](double v) { return std::isnan(v); }) == 1);
  CHECK(std::is_sorted(few.time.begin(), few.time.end()));
}

}  // namespace plots_tests
