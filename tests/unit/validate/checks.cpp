// Messages about wrong cases, data and records before anything is run.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "base/scene.h"
#include "unit/validate/cases.h"
#include "validate/case/checks.h"
#include "validate/record/record.h"

namespace checks_tests {
using namespace seiche;

namespace {

// Rejected when the case is read, with this word in the message.
void refuses_case(const std::string& name, const std::string& text, const char* word) {
  const ScratchFolder folder;
  put_case(folder, name, text);
  INFO(text);
  CHECK_THROWS_WITH(read_case(folder / "cases" / name), Catch::Contains(word));
}

Scene tank() {
  Scene scene;
  scene.dimension = 2;
  scene.time.end = 2;
  scene.probes.resize(1);
  scene.probes[0].name = "p", scene.probes[0].kind = ProbeKind::pressure;
  return scene;
}

// Message of check_measure about data.
void refuses_data(const char* kind, const std::string& text, const char* word) {
  const ScratchFolder folder;
  put(folder / "data.csv", text);
  MeasureSpec m;
  m.kind = kind, m.probe = "p", m.data = folder / "data.csv";
  INFO(text);
  CHECK_THROWS_WITH(check_measure(m, tank(), "w"), Catch::Contains(word));
}

void refuses_row(const std::string& rows, const char* word) {
  INFO(rows);
  CHECK_THROWS_WITH(ValidationRecord("r.csv", rows), Catch::Contains(word));
}

}  // namespace

TEST_CASE("names, settings, references and orders of a case that cannot be") {
  refuses_case("a,b", case_text("max_speed", 1), "letters, digits");
  std::string text = case_text("max_speed", 1);
  text.replace(text.find("0.0625\""), 7, "0.0625\", \"domain.cell_size=0.1\"");
  refuses_case("one", text, "domain.cell_size is set twice");
  refuses_case("one", case_text("max_speed", 1) + "reference = \"1\"\n", "takes none");
  refuses_case("one", "min_order = 1.0\n" + case_text("max_speed", 1) + "series = \"fine\"\n", "same series");
}

TEST_CASE("a folder whose case.toml is missing or misspelt is named") {
  const ScratchFolder folder;
  put_case(folder, "one", case_text("max_speed", 1));
  put(folder / "cases" / "README.md", "cases\n");
  for (const char* other : {".git", "two", "three"}) fs::create_directories(folder / "cases" / other);
  put(folder / "cases" / "two" / "Case.toml", case_text("max_speed", 1));
  fs::create_symlink(folder / "none", folder / "cases" / "four");
  const auto left_out = folders_without_case(folder / "cases");
  CHECK(left_out ==
        std::vector<fs::path>{folder / "cases" / "four", folder / "cases" / "three", folder / "cases" / "two"});
}

TEST_CASE("a wrong setting names its case and resolution") {
  const ScratchFolder folder;
  std::string text = case_text("max_speed", 1);
  text.replace(text.find("cell_size=0.06"), 14, "cel_size=0.06");
  put_case(folder, "one", text);
  CHECK_THROWS_WITH(validate(folder, {}, "full"),
                    Catch::Contains("one/case.toml, resolution '16'") && Catch::Contains("cel_size"));
}

TEST_CASE("reference data that go back, lie outside or are not what their header says") {
  refuses_data("probe_rms", "t,y\n0,1\n50,1\n2,1\n", "goes back, from 50 to 2");
  refuses_data("probe_rms", "0,1\n1,1\n2,1\n", "name the columns");
  refuses_data("probe_rms", "t,y\n0,1;0\n1,1\n", "not a finite number");
  refuses_data("probe_rms", "t,y\n0,1 m\n1,1\n", "not a finite number");
  refuses_data("probe_rms", "t,y\n0,1\n3,1\n", "3 s lies beyond the scene's end, 2 s");
  const std::string header = "component,along,x,y,z,extreme,value\n";
  refuses_data("line_extrema", header + "x,y,7.5,0,0,min,1\n", "outside of the domain");
  refuses_data("line_extrema", header + "z,y,0.5,0,0,min,1\n", "no axis of a 2D");
  refuses_data("line_extrema", header + "x,y,0.5,0,0,min,0\n", "zero");
  refuses_data("line_deviation", "component,along,x,y,z,value\nx,y,0.5,1.5,0,1\n", "outside of the domain");
}

TEST_CASE("times that a scene does not have, and zeros that errors would be over") {
  const Scene scene = tank();
  MeasureSpec m;
  m.kind = "probe_peak", m.probe = "p", m.column = "value", m.reference = "2";
  const auto refused = [&](double from, double to, const char* reference, const char* word) {
    m.from = from, m.to = to, m.reference = reference;
    CHECK_THROWS_WITH(check_measure(m, scene, "w"), Catch::Contains(word));
  };
  refused(1, 1, "2", "from must be below to");
  refused(0, 3, "2", "to: 3 s lies beyond the scene's end");
  refused(0, 2, "1-1", "reference is 0");
  m.reference = "2";
  CHECK_NOTHROW(check_measure(m, scene, "w"));
  Scene bare = scene;
  bare.output.frames = {"surface"};
  MeasureSpec of_frames;
  of_frames.kind = "vector_l2";
  CHECK_THROWS_WITH(
      check_measure(of_frames, bare, "w"),
      Catch::Contains("for vector_l2: there is no field in output.frames 'velocity'; there are: surface"));
  CHECK_NOTHROW(check_measure(of_frames, scene, "w"));
  m.kind = "column_peak", m.column = "max_speed", m.unit = "0";
  CHECK_THROWS_WITH(check_measure(m, scene, "w"), Catch::Contains("unit is 0"));

  const ScratchFolder folder;
  put(folder / "plot.csv", "t,y\n0,1\n1,2\n");
  PlotSpec plot;
  plot.data = folder / "plot.csv";
  CHECK_NOTHROW(check_plot(plot, "w"));
  plot.value_unit = "0";
  CHECK_THROWS_WITH(check_plot(plot, "w"), Catch::Contains("value_unit is 0"));
  put(folder / "plot.csv", "t,y\n");
  CHECK_THROWS_WITH(check_plot(plot, "w"), Catch::Contains("less than two rows"));
}

TEST_CASE("rows of a record that no validation has written") {
  const std::string good = "one,8,0123abcd,b,2026-11-23,1,2.5,1,0.5,2,1,m,\n";
  CHECK_NOTHROW(ValidationRecord("r.csv", good));
  refuses_row("one,8,0123abcd,b,2026-11-23,1,2.5,1,-5,2,1,m,\n", "not a row");
  refuses_row("one,8,0123abcd,b,2026-11-23,1,2.5,1,nan,2,1,m,\n", "not a row");
  refuses_row("one,8,0123abcd,b,2026-11-23,1e99,2.5,1,0.5,2,1,m,\n", "not a row");
  refuses_row(good + good, "line 2: a second row of one/8");
}

}  // namespace checks_tests
