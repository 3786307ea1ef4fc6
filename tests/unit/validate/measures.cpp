// Arithmetic of the measures of `seiche validate`, on data with known results.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "geometry/vdb/openvdb_adapter.h"
#include "unit/files/scratch.h"
#include "validate/measure/kinds.h"
#include "validate/measure/measures.h"

namespace measures_tests {
using namespace seiche;

namespace {

constexpr double pi = 3.14159265358979323846;

// A frame of 8 x 4 cells with (x + t, 2 y) on faces, plus `offset` along x.
vdb::Frame linear_frame(double offset) {
  vdb::Frame frame;
  frame.dimension = 2;
  frame.lower = {1, 2, 0};
  frame.cell_size = 0.25;
  frame.time = 0.5;
  vdb::Block block{{0, 0, 0}, {8, 4, 1}, {}};
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 8; ++i) {
      block.values.push_back(float(1 + 0.25 * i + 0.5 + offset));
      block.values.push_back(float(2 * (2 + 0.25 * j)));
      block.values.push_back(0);
    }
  }
  frame.grids.push_back({"vel", vdb::GridKind::staggered_vector, 0, {block}});
  return frame;
}

double l2_of(const vdb::Frame& frame) {
  const ScratchFolder folder;
  const RunPaths run{folder.path()};
  std::filesystem::create_directories(run.frames());
  put(run.frames() / "frame.0000.vdb", "an older frame, not to be read");
  put(run.frames() / "frame.0001.vdb", vdb::encode(frame));
  MeasureSpec spec;
  spec.kind = "vector_l2";
  spec.velocity = {"x+t", "2*y", "0"};
  return measure(spec, run).error;
}

}  // namespace

TEST_CASE("a least-squares slope sees only the points between its bounds") {
  const Points points{{0, 9}, {1, 2}, {2, 2.5}, {3, 3}, {4, 4.5}};
  CHECK(slope_between(points, 2, 4) == Approx(0.5).epsilon(1e-14));  // three points on a line: round-off only
  CHECK(slope_between({{0, 0}, {1, 2}, {2, 1}}, 0, 5) == Approx(0.5).epsilon(1e-14));
  CHECK_THROWS_AS(slope_between(points, 4, 4.6), Error);
  CHECK_THROWS_AS(slope_between({{1, 1}, {1, 2}}, 0, 5), Error);
}

TEST_CASE("the mean period of a sampled wave is that of the wave") {
  Points points;
  for (int n = 0; n <= 1000; ++n) points.emplace_back(0.01 * n, 3 + std::cos(2 * pi * 0.01 * n / 1.7));
  CHECK(mean_period(points, 3) == Approx(1.7).epsilon(1e-4));  // linear interpolation: (pi dt / T)^2 of a sample
  CHECK_THROWS_AS(mean_period(points, 5), Error);
  points.resize(100);  // 1 s: under one period
  CHECK_THROWS_AS(mean_period(points, 3), Error);
}

TEST_CASE("columns and points are read from CSV text with comments and gaps") {
  const std::string text = "# where from\na,b,c\n1,2,3\r\n4,,6\n";
  CHECK(csv_column(text, "c") == std::vector<double>{3, 6});
  CHECK_THROWS_WITH(csv_column(text, "b"), Catch::Contains("not a finite number") && Catch::Contains("4,,6"));
  CHECK(csv_points("# where from\na,b\n1,2,3\n") == Points{{1, 2}});
  CHECK_THROWS_WITH(csv_points(text), Catch::Contains("not a finite number"));
  CHECK_THROWS_WITH(csv_column(text, "d"), Catch::Contains("'d'") && Catch::Contains("a, b, c"));
}

TEST_CASE("samples of one probe are picked from probes.csv, undefined ones left out") {
  const std::string text = "time,name,value,x,y,z\n0,p,1,,,\n0,q,7,,,\n1,p,,,,\n2,p,3,,,\n";
  CHECK(probe_points(text, "p") == Points{{0, 1}, {2, 3}});
  CHECK_THROWS_AS(probe_points(text, "r"), Error);
}

TEST_CASE("vector_l2 compares face velocities of the last frame at the faces' own places") {
  CHECK(l2_of(linear_frame(0)) < 1e-7);                            // frames are 32-bit: round-off of numbers up to 8
  CHECK(l2_of(linear_frame(0.25)) == Approx(0.25).epsilon(1e-6));  // 32-bit round-off
}

TEST_CASE("the slope during a time takes the rows at its ends in") {
  const Points points{{0, 9}, {0.1, 2}, {0.2, 4}, {0.1 + 0.2, 6}, {0.4, 9}};
  CHECK(slope_during(points, 0.1, 0.3) == Approx(20).epsilon(1e-12));  // round-off of times
  CHECK_THROWS_AS(slope_during(points, 0.15, 0.25), Error);
  CHECK_THROWS_WITH(slope_during(points, 0.1, 0.5), Catch::Contains("does not reach"));
  CHECK_THROWS_WITH(slope_during(points, -0.1, 0.3), Catch::Contains("does not reach"));
}

TEST_CASE("a settled mean leaves next to nothing of an oscillation, whatever the steps") {
  Points points;
  for (double t = 0, n = 0; t < 10; t += 0.02 + 0.01 * std::sin(n++)) points.emplace_back(t, 3 + std::cos(2 * t));
  CHECK(settled_mean(points, 1, 9) == Approx(3).epsilon(0.01));  // 100 to 200 rows, five periods
  CHECK_THROWS_AS(settled_mean(points, 1, 11), Error);
  CHECK_THROWS_AS(settled_mean({}, 0, 1), Error);
  const Points later(points.begin() + 1, points.end());  // no pressure before the first solve
  CHECK(settled_mean(later, 0, 8) == Approx(settled_mean(points, 0, 8)).epsilon(1e-3));
  CHECK_THROWS_AS(settled_mean(later, -1, 9), Error);
}

TEST_CASE("rows of one solid are picked from solids.csv, and the farthest way of all") {
  const std::string text = "time,name,x,y,z\n0,a,0,0,0\n0,b,5,5,5\n1,a,1,2,0\n1,b,5,5,5\n2,a,1,2,0\n2,b,5,8,1\n";
  CHECK(solid_points(text, "a", "y") == Points{{0, 0}, {1, 2}, {2, 2}});
  CHECK(solid_points(text, "a + b", "y") == Points{{0, 5}, {1, 7}, {2, 10}});
  CHECK_THROWS_AS(solid_points(text, "c", "y"), Error);
  CHECK_THROWS_AS(solid_points(text, "a + c", "y"), Error);
  CHECK_THROWS_WITH(solid_points(text + "3,a,1,2,0\n", "a + b", "y"), Catch::Contains("as many rows"));
  CHECK(farthest_stray(text, 1) == 5);
  CHECK(farthest_stray(text, 2) == 0);
  CHECK_THROWS_AS(farthest_stray(text, 3), Error);
}

TEST_CASE("a component of a vector probe is measured by its period, mean, peak and amplitude") {
  const ScratchFolder folder;
  const RunPaths run{folder.path()};
  std::string text = "time,name,value,x,y,z\n";
  for (int n = 0; n <= 1000; ++n)
    text += fmt::format("{},tip,,0,{:.17g},0\n", 0.01 * n, 1 - 3 * std::cos(6.283185307179586 * 0.01 * n));
  put(run.probes(), text);
  MeasureSpec spec;
  spec.probe = "tip", spec.column = "y", spec.to = 10;
  const auto value = [&](const char* kind, const char* reference) {
    spec.kind = kind, spec.reference = reference;
    const Measurement m = measure(spec, run);
    CHECK(m.error == Approx(std::abs(m.value / *m.reference - 1)).margin(1e-15));
    return m.value;
  };
  CHECK(value("probe_mean", "2") == Approx(1));
  CHECK(value("probe_peak", "2") == Approx(4));
  spec.to = 1.2;
  CHECK(value("probe_peak_time", "0.6") == Approx(0.5));
  spec.to = 10;
  CHECK(value("probe_amplitude", "2") == Approx(3));
  CHECK(value("probe_middle", "2") == Approx(1));
  spec.level = "1";
  CHECK(value("probe_period", "2") == Approx(1));
  spec.kind = "probe_peak", spec.to = 11;
  CHECK_THROWS_WITH(measure(spec, run), Catch::Contains("does not reach"));
}

TEST_CASE("periods that differ scatter, and chatter about the level is no period") {
  Points points{{0, 1}, {1, -1}, {3, 1}, {5, -1}, {7, 1}, {9, -1}};  // zeros at 0.5, 2, 4, 6, 8: 3.5, 4 and 4
  const double scatter = std::sqrt(1.0 / 18) / (23.0 / 6);
  CHECK(period_scatter(points, 0) == Approx(scatter));
  points.insert(points.begin() + 2, {{1.9, 0.1}, {1.95, -0.05}});  // three crossings, the last at 2
  CHECK(period_scatter(points, 0) == Approx(scatter));
  CHECK_THROWS_WITH(period_scatter(points, 2), Catch::Contains("0 swings"));
  points.emplace_back(20, -1);
  CHECK_THROWS_WITH(period_scatter(points, 0), Catch::Contains("swings end at 8 s"));
}

TEST_CASE("liquid arrives with the first sample that has a value") {
  const ScratchFolder folder;
  const RunPaths run{folder.path()};
  put(run.probes(),
      "time,name,value,x,y,z\n0,gauge,,,,\n0,other,7,,,\n0.1,gauge,,,,\n0.25,gauge,-3,,,\n0.3,gauge,5,,,\n");
  MeasureSpec spec;
  spec.kind = "probe_arrival", spec.probe = "gauge", spec.reference = "0.2";
  CHECK(measure(spec, run).value == 0.25);
  CHECK(measure(spec, run).error == Approx(0.25));
  put(run.probes(), "time,name,value,x,y,z\n0,gauge,,,,\n0.1,gauge,,,,\n");
  CHECK_THROWS_WITH(measure(spec, run), Catch::Contains("no samples"));  // it never arrived: an error, no time of 0
}

TEST_CASE("an impact's peak counts from when the probe was dry") {
  const ScratchFolder folder;
  const RunPaths run{folder.path()};
  put(run.probes(), "time,name,value,x,y,z\n0,p,,,,\n0.1,p,,,,\n0.2,p,30,,,\n0.3,p,40,,,\n0.4,p,-50,,,\n");
  MeasureSpec spec;
  spec.kind = "impact_peak", spec.probe = "p", spec.reference = "50", spec.to = 0.4;
  CHECK(measure(spec, run).value == 40);
  CHECK(measure(spec, run).error == Approx(0.2));
  spec.kind = "impact_peak_time", spec.reference = "0.2";
  CHECK(measure(spec, run).value == 0.3);
  spec.to = 0.5;
  CHECK_THROWS_WITH(measure(spec, run), Catch::Contains("does not reach"));
  put(run.probes(), "time,name,value,x,y,z\n0,p,,,,\n1,p,,,,\n");
  CHECK_THROWS_WITH(measure(spec, run), Catch::Contains("no samples"));  // a probe that was never wet has no peak of 0
}

TEST_CASE("a column of stats.csv is compared over time, and by how fast it falls") {
  const ScratchFolder folder;
  const RunPaths run{folder.path()};
  std::string text = "step,time,energy\n";  // 6 - 2 tanh(t - 3): falls at 2 sech^2, fastest at t = 3
  for (int n = 0; n <= 600; ++n) text += fmt::format("{},{},{:.17g}\n", n, 0.01 * n, 6 - 2 * std::tanh(0.01 * n - 3));
  put(run.stats(), text);
  MeasureSpec spec;
  spec.column = "energy", spec.from = 1, spec.to = 5, spec.unit = "4";
  spec.kind = "column_fall", spec.reference = "0.5";
  CHECK(measure(spec, run).value == Approx(0.5).epsilon(1e-4));  // differences over 0.01: 0.01^2/12 of u'''
  spec.kind = "column_fall_time", spec.reference = "3";
  CHECK(measure(spec, run).error < 0.005 / 3 + 1e-9);  // the middle of the nearest step
  spec.kind = "column_rms", spec.time_unit = "2", spec.unit = "2", spec.data = folder.path() / "data.csv";
  put(spec.data, "t,y\n0.5,4.1640275800758169\n1.5,2.5\n");  // 3 - tanh(2 0.5 - 3) + 0.2, 3 - tanh(0) - 0.5
  CHECK(measure(spec, run).error == Approx(std::sqrt((0.2 * 0.2 + 0.5 * 0.5) / 2)));
  spec.kind = "column_extreme_time", spec.from = 2, spec.reference = "4";
  CHECK(measure(spec, run).value == 2);  // it falls throughout
  CHECK(measure(spec, run).error == 0.5);
  spec.kind = "column_fall", spec.to = 7;
  CHECK_THROWS_WITH(measure(spec, run), Catch::Contains("does not reach"));
}

TEST_CASE("a column of a solid is measured by its extremes and against data") {
  const ScratchFolder folder;
  const RunPaths run{folder.path()};
  std::string text = "time,name,x,fy\n";
  for (int n = 0; n <= 1000; ++n)
    text +=
        fmt::format("{0},wall,0,0\n{0},flag,{1:.17g},{2:.17g}\n", 0.01 * n, 0.02 * n, 1 - 3 * std::cos(0.02 * pi * n));
  put(run.solids(), text);
  MeasureSpec spec;
  spec.solid = "flag", spec.column = "fy", spec.from = 2, spec.to = 8;
  spec.kind = "solid_amplitude", spec.reference = "2";
  CHECK(measure(spec, run).value == Approx(3));
  CHECK(measure(spec, run).error == Approx(0.5));
  spec.kind = "solid_middle";
  CHECK(measure(spec, run).value == Approx(1));
  spec.kind = "solid_root_mean_square";  // sqrt(1^2 + 3^2/2), over whole periods
  CHECK(measure(spec, run).value == Approx(std::sqrt(5.5)));
  spec.kind = "solid_rms", spec.column = "x", spec.level = "1", spec.length_unit = "4", spec.time_unit = "5";
  spec.data = folder.path() / "data.csv";
  put(spec.data, "t,y\n0,-0.25\n1,2.35\n");  // (2 * 5 - 1)/4 = 2.25
  CHECK(measure(spec, run).error == Approx(0.1 / std::sqrt(2)));
}

TEST_CASE("the energy of a swing dies away at a rate") {
  const ScratchFolder folder;
  const RunPaths run{folder.path()};
  std::string text = "time,name,value,x,y,z\n";
  for (double t = 0; t < 10; t += 0.01)
    text += fmt::format("{},gauge,{:.17g},,,\n", t, 0.5 + 0.1 * std::exp(-0.15 * t) * std::cos(2 * pi * t));
  put(run.probes(), text);
  MeasureSpec spec;
  spec.kind = "probe_decay_rate", spec.probe = "gauge", spec.level = "0.5", spec.reference = "0.4";
  CHECK(measure(spec, run).value == Approx(0.3).epsilon(1e-3));  // the extremes are at samples
  CHECK(measure(spec, run).error == Approx(0.25).epsilon(5e-3));
}

TEST_CASE("growth is the slope of a logarithm, and two probes are measured against each other") {
  Points wave;
  for (double t = 0; t < 2; t += 0.01) wave.emplace_back(t, 1 - 0.02 * std::exp(0.7 * t));
  CHECK(growth_rate(wave, 1, 0.5, 1.5) == Approx(0.7));
  CHECK_THROWS_AS(growth_rate(wave, 1, 0.5, 3), Error);
  CHECK_THROWS_AS(growth_rate({{0, 1}, {1, 1}, {2, 1}}, 1, 0, 2), Error);
  const ScratchFolder folder;
  const RunPaths run{folder.path()};
  std::string text = "time,name,value,x,y,z\n";
  for (double t = 0; t < 2; t += 0.01) text += fmt::format("{0},top,,0,-0.5,0\n{0},foot,,0,-0.1,0\n", t);
  put(run.probes(), text);
  MeasureSpec spec;
  spec.kind = "probe_difference";
  spec.probe = "top";
  spec.minus = "foot";
  spec.column = "y";
  spec.from = 0.5;
  spec.to = 1.5;
  spec.reference = "-0.5";
  CHECK(measure(spec, run).value == Approx(-0.4));
  CHECK(measure(spec, run).error == Approx(0.2));
}

TEST_CASE("what is not a number is not measured, wherever it stands") {
  const ScratchFolder folder;
  const RunPaths run{folder.path()};
  MeasureSpec spec;
  spec.column = "energy", spec.solid = spec.probe = "p", spec.reference = "1", spec.to = 2;
  const auto refused = [&](const char* kind) {
    spec.kind = kind;
    CHECK_THROWS_WITH(measure(spec, run), Catch::Contains("not a finite number"));
  };
  for (const char* value : {"nan", "inf", ""}) {
    put(run.stats(), fmt::format("time,energy\n0,1\n1,{}\n2,1\n", value));
    for (const char* kind : {"max_of_column", "column_peak", "column_extreme", "column_drift", "column_fall"})
      refused(kind);
  }
  spec.column = "x";
  put(run.solids(), "time,name,x,y,z\n0,p,1,0,0\n1,p,nan,0,0\n2,p,1,0,0\n");
  for (const char* kind : {"solid_slope", "solid_peak", "solid_amplitude", "solid_middle", "solid_mean"}) refused(kind);
  refused("solids_stray");
  put(run.probes(), "time,name,value,x,y,z\n0,p,,1,0,0\n1,p,,nan,0,0\n2,p,,1,0,0\n");
  for (const char* kind : {"probe_peak", "probe_peak_time", "probe_amplitude", "probe_mean"}) refused(kind);
  CHECK(std::isnan(larger(1, std::nan(""))));
  CHECK(std::isnan(larger(std::nan(""), 1)));
  CHECK(larger(1, 2) == 2);
}

TEST_CASE("a measure that would pass on nothing fails") {
  const ScratchFolder folder;
  const RunPaths run{folder.path()};
  put(run.stats(), "time,energy\n0,0\n1,2\n2,0\n");
  MeasureSpec spec;
  spec.column = "energy";
  spec.kind = "column_drift";
  CHECK_THROWS_WITH(measure(spec, run), Catch::Contains("zero at the start"));
  spec.kind = "column_peak", spec.from = 0.2, spec.to = 0.8;  // between two rows
  CHECK_THROWS_WITH(measure(spec, run), Catch::Contains("no rows between"));
  spec.to = 2, spec.unit = "-1";  // would be a negative error, below any bar
  CHECK_THROWS_WITH(measure(spec, run), Catch::Contains("below zero"));
  spec.kind = "front_slope", spec.probe = "f", spec.data = folder / "data.csv", spec.from = 1, spec.to = 3;
  put(spec.data, "t,z\n0,1\n1,2\n2,3\n");
  put(run.probes(), "time,name,value,x,y,z\n0,f,1,,,\n1,f,2,,,\n");
  CHECK_THROWS_WITH(measure(spec, run), Catch::Contains("does not go from 1 to 3"));
}

TEST_CASE("a run that does not hold what is measured is said not to be measurable") {
  const ScratchFolder folder;
  const RunPaths run{folder.path()};
  for (const MeasureKind& kind : measure_kinds()) {
    MeasureSpec spec;
    spec.kind = kind.name;
    try {
      measure(spec, run);
      FAIL(kind.name);
    } catch (const Error& error) {
      CHECK(error.code() == ExitCode::cannot_continue);
    }
  }
  put(run.stats(), "step,max_speed\n");
  MeasureSpec spec;
  spec.kind = "max_of_column";
  spec.column = "max_speed";
  CHECK_THROWS_WITH(measure(spec, run), Catch::Contains("no rows"));  // an error, not a figure of 0
  put(run.stats(), "step,max_speed\n0,1\n1,-2\n");
  CHECK(measure(spec, run).error == 2);
  spec.kind = "column_drift";
  put(run.stats(), "step,max_speed\n0,2\n1,1\n2,2.5\n");
  CHECK(measure(spec, run).error == 0.5);
  spec.kind = "energy_growth";
  spec.from = 0.5;  // the earlier rise does not count
  put(run.stats(), "time,kinetic_energy,elastic_energy\n0,1,0\n1,3,1\n2,2,1.5\n3,1.5,2.5\n4,0,1\n");
  CHECK(measure(spec, run).error == 0.125);
  spec.from = 2.5;
  CHECK(measure(spec, run).error == 0);
  put(run.stats(), "time,kinetic_energy,elastic_energy\n2,2,0\n3,0,0\n4,1,0\n");
  CHECK_THROWS_WITH(measure(spec, run), Catch::Contains("no energy"));
  put(run.summary(), "{\n  \"volume_drift\": -0.25\n}\n");
  spec.kind = "volume_drift";
  CHECK(measure(spec, run).error == 0.25);
}

}  // namespace measures_tests
