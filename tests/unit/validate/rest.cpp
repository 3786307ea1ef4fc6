// Validation runs that are stopped and resumed.
#include <catch2/catch.hpp>

#include <csignal>
#include <utility>

#include "base/scene.h"
#include "files/json.h"
#include "unit/validate/cases.h"

namespace rest_tests {
using namespace seiche;

namespace {

// A case of ten steps whose run is stopped after the first.
struct StoppedRun {
  ScratchFolder folder;
  std::string scene = scene_text;
  fs::path run = folder / "out" / "one" / "8";

  StoppedRun() {
    scene.replace(scene.find("end = 0.2"), 9, "end = 0.2\nmax_step = 0.02");
    put_case(folder, "one", case_text("kinetic_energy", 1e4));
    put(folder / "cases" / "one" / "scene.toml", scene);
    bool asked = false;  // a second signal would end the test
    const auto ask = [&](const std::string&) {
      if (!std::exchange(asked, true)) std::raise(SIGTERM);
    };
    CHECK(validate(folder, {"one"}, "quick", {}, ask).code == ExitCode::stopped);
    CHECK(steps() == "1");
  }

  std::string steps() const { return json_value(contents(run / "summary.json"), "steps"); }
  bool went_on() const { return contents(run / "log.txt").find("resuming at step") != std::string::npos; }

  Outcome again(const ValidateOptions& options = {}) const {
    const Outcome outcome = validate(folder, {"one"}, "quick", options);
    CHECK(outcome.code == ExitCode::done);
    return outcome;
  }

  void is_made_anew(const std::string& expected_steps = "10") const {
    again();
    CHECK_FALSE(went_on());
    CHECK(steps() == expected_steps);
  }
};

std::string figure_of(const Outcome& outcome) {
  const std::size_t at = outcome.json.find("\"measured\"");
  REQUIRE(at != std::string::npos);
  return outcome.json.substr(at, outcome.json.find('\n', at) - at);
}

}  // namespace

TEST_CASE("a run that was stopped goes on, with the figures of one that was not") {
  const StoppedRun stopped;
  const std::string rest = figure_of(stopped.again());
  CHECK(stopped.went_on());
  CHECK(stopped.steps() == "10");
  CHECK(stopped.again().json.find("\"cached\": true") != std::string::npos);
  ValidateOptions fresh;
  fresh.earlier = Earlier::ignore;
  CHECK(figure_of(stopped.again(fresh)) == rest);
  CHECK_FALSE(stopped.went_on());
}

TEST_CASE("a run that was stopped does not go on if it is not to") {
  const StoppedRun stopped;
  ValidateOptions fresh;
  fresh.earlier = Earlier::ignore;
  stopped.again(fresh);
  CHECK_FALSE(stopped.went_on());
  CHECK(stopped.steps() == "10");
}

TEST_CASE("a run that was stopped goes on for any case of its scene, and for that scene alone") {
  StoppedRun stopped;
  SECTION("another case") {
    put_case(stopped.folder, "other", case_text("dt", 1.5));
    put(stopped.folder / "cases" / "other" / "scene.toml", stopped.scene);
    CHECK(validate(stopped.folder, {"other"}, "quick").code == ExitCode::done);
    CHECK(stopped.went_on());
    CHECK_FALSE(fs::exists(stopped.folder / "out" / "other"));
  }
  SECTION("another scene") {
    stopped.scene.replace(stopped.scene.find("0.02"), 4, "0.04");
    put(stopped.folder / "cases" / "one" / "scene.toml", stopped.scene);
    stopped.is_made_anew("5");
  }
}

TEST_CASE("a run that was stopped is made anew where its rest is not to be had") {
  const StoppedRun stopped;
  SECTION("it failed") {
    std::string summary = contents(stopped.run / "summary.json");
    summary.replace(summary.find("\"exit_code\": 75"), 15, "\"exit_code\": 3");
    put(stopped.run / "summary.json", summary);
  }
  SECTION("something else has finished it") {
    const Communicator ranks;
    const EmergencyChannel emergency(ranks);
    const auto quiet = [](const std::string&) {};
    CHECK(resume_command({stopped.run, {}, {}, EditPolicy::refuse, {}}, {ranks, emergency, {quiet, quiet, {}}}) ==
          ExitCode::done);
  }
  SECTION("it was killed before it could say that it had come to its end") {
    stopped.again();
    const Scene scene = read_scene(stopped.run / "scene.toml", {});
    put(stopped.run / "validate.txt", "unfinished\n" + run_identity(scene, 1, ""));
    fs::remove(stopped.run / "summary.json");
  }
  SECTION("its checkpoints are lost") {
    fs::remove_all(stopped.run / "checkpoints");
  }
  stopped.is_made_anew();
}

}  // namespace rest_tests
