// The record of a validation, and protection against wrong figures.
#include <catch2/catch.hpp>
#include <thread>

#include "base/error.h"
#include "base/scene.h"
#include "base/version.h"
#include "files/json.h"
#include "unit/validate/cases.h"
#include "validate/case/checks.h"
#include "validate/measure/quantity.h"
#include "validate/record/files.h"
#include "validate/record/record.h"
#include "validate/run/judge.h"

namespace record_tests {
using namespace seiche;

namespace {

const char* const old_text =
    "# Written by seiche validate --record; see docs/validating.md.\n"
    "case,resolution,identity,build,date,ranks,seconds,value,error,reference\n"
    "a,8,12345678,abcdef01,2026-01-02,2,3.5,0.25,0.125,2\nb,8,12345678,abcdef01,2026-01-02,1,1.0,0.5,0.5,\n";

ExitCode code_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.code();
  }
  return ExitCode::done;
}

ReportedResult row_of(const CaseSpec& one, double h, std::optional<double> error) {
  ReportedResult row{one, {}, {}};
  row.result.cell_size = h;
  row.result.verdict = error ? Verdict::passed : Verdict::failed;
  row.result.measured.error = error.value_or(0);
  return row;
}

}  // namespace

TEST_CASE("a record is read back as it was written, failures, commas and quotes included, and older ones are read") {
  ValidationRecord record("r.csv", old_text);
  REQUIRE(record.find("a", "8", "12345678"));
  CHECK(record.find("a", "8", "12345678")->measured.reference == 2.0);
  CHECK(record.find("a", "8", "12345678")->origin.machine.empty());
  CHECK_FALSE(record.find("a", "8", "00000000"));
  RecordedRow row{
      "c", "16", "00000001", {{"ab", "2026-01-03", 1, 2, "a \"fast\", old one"}, 1, {}, "it, broke\n here"}};
  record.put(row);
  const ValidationRecord again("r.csv", record.text());
  const auto failed = again.find("c", "16", "00000001");
  REQUIRE(failed);
  CHECK(failed->failure == "it, broke  here");
  CHECK(failed->origin.machine == "a \"fast\", old one");
  CHECK(failed->origin.threads == 2);
  CHECK(again.find("b", "8", "12345678")->measured.error == 0.5);
  CHECK(again.text() == record.text());
}

TEST_CASE("rows that several validations put on a record at once are all there") {
  const ScratchFolder folder;
  const fs::path file = folder / "record.csv";
  constexpr int writers = 6, rows = 15;
  std::vector<std::thread> threads;
  for (int writer = 0; writer < writers; ++writer)
    threads.emplace_back([&file, writer] {
      for (int n = 0; n < rows; ++n)
        put_on_file(file, {"case" + std::to_string(writer), std::to_string(n), "00000001", {}});
    });
  for (std::thread& thread : threads) thread.join();
  const ValidationRecord record(file, read_record(file));
  int found = 0;
  for (int writer = 0; writer < writers; ++writer)
    for (int n = 0; n < rows; ++n)
      found += record.find("case" + std::to_string(writer), std::to_string(n), "00000001").has_value();
  CHECK(found == writers * rows);
  CHECK(entries(folder.path()) == 1);  // no other files remain
}

TEST_CASE("a row counts that is older than keys of scenes at their defaults, and no longer where these are set") {
  Scene scene;
  const MeasureSpec measure;
  const auto count = [&] { return older_identities(scene, measure).size(); };
  const std::string present = measured_identity(scene, measure);
  const auto older = older_identities(scene, measure);
  REQUIRE(older.size() == 5);
  CHECK(older.front() != present);
  scene.output.velocity_name = "v";
  CHECK(count() == 4);
  CHECK(measured_identity(scene, measure) != present);
}

TEST_CASE("a run that fails replaces the pass on record") {
  const ScratchFolder folder;
  ValidateOptions options;
  options.record = folder / "record.csv";
  put_case(folder, "one", unmeasurable_text());
  CHECK(validate(folder, {}, "quick", options).code == ExitCode::cannot_continue);
  std::string text = contents(*options.record);
  CHECK(text.find(",,,") != std::string::npos);
  CHECK(text.find("is zero at the start") != std::string::npos);

  // A pass of the same scene and measure by an older build.
  ValidationRecord record("", text);
  std::string identity = text.substr(text.find("one,8,") + 6, 8);
  RecordedRun pass = *record.find("one", "8", identity);
  pass.failure.clear();
  pass.origin.build = "older";
  record.put({"one", "8", identity, pass});
  put(*options.record, record.text());
  options.making = Making::report;
  const fs::path empty = folder / "out";
  fs::remove_all(empty);
  CHECK(validate(folder, {}, "quick", options).code == ExitCode::done);
  options.making = Making::runs;
  CHECK(validate(folder, {}, "quick", options).code == ExitCode::cannot_continue);
  fs::remove_all(empty);
  options.making = Making::report;
  const Outcome outcome = validate(folder, {}, "quick", options);
  CHECK(outcome.code == ExitCode::cannot_continue);
  CHECK(outcome.table.find("FAILED") != std::string::npos);
  CHECK(outcome.table.find("is zero at the start") != std::string::npos);
}

TEST_CASE("broken operators leave record and page alone, and their reports say what they are") {
  const ScratchFolder folder;
  put_case(folder, "one", case_text("max_speed", 1.5));
  ValidateOptions options;
  options.perturbation = "divergence:0.5";
  for (const bool record : {true, false}) {
    ValidateOptions both = options;
    (record ? both.record : both.docs) = folder / "kept";
    CHECK(code_of([&] { validate(folder, {}, "quick", both); }) == ExitCode::bad_input);
    CHECK_FALSE(fs::exists(folder / "kept"));
    CHECK_FALSE(fs::exists(folder / "out"));
  }
  const Outcome broken = validate(folder, {}, "quick", options);
  CHECK(json_value(broken.json, "broken_on_purpose") == "divergence:0.5");
  CHECK(contents(folder / "out" / "report.html").find("broken on purpose") != std::string::npos);
  const Outcome whole = validate(folder, {}, "quick");
  CHECK(json_value(whole.json, "broken_on_purpose") == "null");
  CHECK_FALSE(json_value(whole.json, "machine").empty());
}

TEST_CASE("files that cannot be written are noticed before the first run") {
  const ScratchFolder folder;
  put_case(folder, "one", case_text("max_speed", 1.5));
  put(folder / "kept.csv", old_text);
  for (const char* bad : {"none/page.md", "cases"}) {
    ValidateOptions options;
    options.record = folder / "kept.csv", options.docs = folder / bad;
    CHECK(code_of([&] { validate(folder, {}, "quick", options); }) == ExitCode::output_failed);
    std::swap(options.record, options.docs);
    CHECK(code_of([&] { validate(folder, {}, "quick", options); }) == ExitCode::output_failed);
  }
  CHECK_THROWS_WITH(check_writable(folder / "none/page.md"), Catch::Contains("none/page.md"));
  CHECK(contents(folder / "kept.csv") == old_text);
  CHECK_FALSE(fs::exists(folder / "out"));
  CHECK(entries(folder.path()) == 2);
}

TEST_CASE("what is no output of a validation is not replaced by one") {
  const ScratchFolder folder;
  put_case(folder, "one", case_text("max_speed", 1.5));
  ValidateOptions options;
  options.docs = "/dev/null";
  CHECK(code_of([&] { validate(folder, {}, "quick", options); }) == ExitCode::output_failed);
  CHECK(fs::is_character_file("/dev/null"));
  options.docs = folder / "cases" / "one" / "case.toml";
  CHECK_THROWS_WITH(validate(folder, {}, "quick", options), Catch::Contains("no page of seiche validate"));
  CHECK_FALSE(fs::exists(folder / "out"));
  options.docs = folder / "page.md";
  CHECK(validate(folder, {}, "quick", options).code == ExitCode::done);
  CHECK(validate(folder, {}, "quick", options).code == ExitCode::done);  // replaces its own
}

TEST_CASE("one file is not taken for two outputs") {
  const ScratchFolder folder;
  put_case(folder, "one", case_text("max_speed", 1.5));
  put(folder / "kept.csv", old_text);
  fs::create_symlink(folder / "kept.csv", folder / "link.csv");
  ValidateOptions options;
  options.record = folder / "kept.csv", options.docs = folder / "link.csv";
  CHECK(code_of([&] { validate(folder, {}, "quick", options); }) == ExitCode::bad_input);
  options.docs = folder / "out" / "report.html";
  CHECK(code_of([&] { validate(folder, {}, "quick", options); }) == ExitCode::bad_input);
  CHECK(contents(folder / "kept.csv") == old_text);
  CHECK_FALSE(fs::exists(folder / "out"));
}

// Both runs have errors of 1 m/s: order 0, which a single selected run does not know.
TEST_CASE("a single run does not escape the order that its case asks for") {
  const ScratchFolder folder;
  put_case(folder, "one", "min_order = 1.9\n" + case_text("max_speed", 1.5));
  ValidateOptions options;
  options.record = folder / "r.csv", options.docs = folder / "page.md";
  validate(folder, {"one/8"}, "full", options);
  CHECK(contents(folder / "page.md").find("MISS") == std::string::npos);
  validate(folder, {"one/16"}, "full", options);
  CHECK(contents(folder / "page.md").find("MISS") != std::string::npos);
}

TEST_CASE("probes, solids and columns that a scene does not have are named before anything is run") {
  const ScratchFolder folder;
  put_case(folder, "one", case_text("max_sped", 1));
  CHECK_THROWS_WITH(validate(folder, {}, "quick"),
                    Catch::Contains("case.toml, resolution '8'") && Catch::Contains("did you mean 'max_speed'"));
  CHECK(code_of([&] { validate(folder, {}, "quick"); }) == ExitCode::bad_input);
  CHECK_FALSE(fs::exists(folder / "out"));

  Scene scene;
  scene.dimension = 2;
  scene.probes.resize(2);
  scene.probes[0].name = "tip", scene.probes[0].kind = ProbeKind::displacement;
  scene.probes[1].name = "wall", scene.probes[1].kind = ProbeKind::pressure;
  scene.solids.resize(2);
  scene.solids[0].name = "cylinder", scene.solids[1].name = "flag";
  MeasureSpec m;
  const auto refused = [&](const char* kind, const char* word) {
    m.kind = kind;
    CHECK_THROWS_WITH(check_measure(m, scene, "w"), Catch::Contains(word));
  };
  m.probe = "tpi", m.column = "y";
  refused("probe_mean", "did you mean 'tip'");
  m.probe = "tip", m.column = "value";
  refused("probe_mean", "there are: x, y, z");
  refused("probe_rms", "there are: x, y, z");  // a scalar probe has no components
  refused("impact_peak", "is to measure pressure");
  m.data = folder / "none.csv", m.probe = "wall";
  refused("probe_rms", "none.csv");
  m.data = folder / "one.csv";
  put(m.data, "t,y\n0,1\n");
  refused("probe_rms", "less than two rows");
  put(m.data, "t,y\n0,one\n1,2\n");
  refused("probe_rms", "one");
  put(m.data, "component,along,x,y,z,extreme,value\nx,y,0,0,0,min\n");
  refused("line_extrema", "needs 7 columns");
  put(m.data, "component,along,x,y,z,value\nx,y,0,0,0\n");
  refused("line_deviation", "needs 6 columns");
  put(m.data, "t,y\n0,1\n1,2\n");
  m.kind = "probe_rms";
  CHECK_NOTHROW(check_measure(m, scene, "w"));
  m.probe = "tip", m.column = "y", m.minus = "tp";
  refused("probe_difference", "did you mean 'tip'");
  m.solid = "cylinder + flg", m.column = "fx";
  refused("solid_mean", "did you mean 'flag'");
  m.solid = "cylinder + flag", m.column = "name";
  refused("solid_mean", "column of solids.csv");
  m.column = "fx", m.to = scene.time.end;
  CHECK_NOTHROW(check_measure(m, scene, "w"));
  CHECK(unit_of(m, scene) == "N/m");
  m.kind = "solid_slope", m.column = "vx";
  CHECK(unit_of(m, scene) == "m/s^2");
  m.kind = "column_peak", m.column = "kinetic_energy", m.unit = "2";
  CHECK(unit_of(m, scene) == "J/m over unit");
}

TEST_CASE("the order is judged at the last run that has a figure") {
  CaseSpec one;
  one.name = "one", one.max_error = 1, one.min_order = 1.9;
  Report report;
  report.results = {row_of(one, 0.4, 0.4), row_of(one, 0.2, 0.12), row_of(one, 0.1, 0.036), row_of(one, 0.05, {})};
  const ReportedResult* changed = judge_last_measured(report);
  REQUIRE(changed);  // orders of 1.74: within the scatter of pairs, but too low for the fit
  CHECK(changed->result.cell_size == 0.1);
  CHECK(changed->result.verdict == Verdict::missed);
  CHECK(*changed->result.fitted_order == Approx(1.737).epsilon(1e-3));
  report.results[2].one.min_order = 1.5;
  report.results[2].result.verdict = Verdict::passed;
  CHECK(judge_last_measured(report) == nullptr);
  CHECK(report.results[2].result.fitted_order);
}

TEST_CASE("orders are taken within a series, in whatever turn its runs come") {
  CaseSpec one;
  one.name = "one", one.max_error = 1;
  one.resolutions.resize(2);
  one.resolutions[1].series = "stiff";
  const auto row = [&](const ResolutionSpec& series, double h, double error) {
    ReportedResult found = row_of(one, h, error);
    found.resolution = series;
    return found;
  };
  Report report;
  report.results = {row(one.resolutions[0], 0.2, 0.4), row(one.resolutions[1], 0.2, 0.08)};
  const auto order_at = [&](const ResolutionSpec& series, double error) {
    CaseResult fine = row(series, 0.1, error).result;
    judge_by_all({&one, &series, {}, true}, report, fine);
    CHECK(fine.order == fine.fitted_order);  // from the same two runs
    return *fine.order;
  };
  CHECK(order_at(one.resolutions[0], 0.1) == Approx(2).epsilon(1e-12));  // round-off of two logarithms
  CHECK(order_at(one.resolutions[1], 0.04) == Approx(1).epsilon(1e-12));
  one.resolutions[1].reference = "2";
  CHECK_FALSE(same_series(one, one.resolutions[1], report.results[1].resolution));
}

}  // namespace record_tests
