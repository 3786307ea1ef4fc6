// Runs of a validation that were stopped and go on.
#include <catch2/catch.hpp>

#include <csignal>
#include <utility>

#include "io/info.h"
#include "io_validate_cases.h"

using namespace seiche;

TEST_CASE("a run that was stopped goes on, with the figures of one that was not") {
  const ScratchFolder folder;
  put_case(folder, "one", case_text("time", 1.5));
  std::string slow = scene_text;
  slow.replace(slow.find("end = 0.2"), 9, "end = 0.2\nmax_step = 0.02");
  put(folder / "cases" / "one" / "scene.toml", slow);
  const fs::path run = folder / "out" / "one" / "8";
  const auto stop = [&](const ValidateOptions& options = {}) {
    bool asked = false;  // a second signal would end the test
    const auto ask = [&](const std::string&) {
      if (!std::exchange(asked, true)) std::raise(SIGTERM);
    };
    return validate(folder, {"one"}, "quick", options, ask).code;
  };
  const auto steps = [&] { return json_value(contents(run / "summary.json"), "steps"); };
  const auto went_on = [&] { return contents(run / "log.txt").find("resuming at step") != std::string::npos; };
  CHECK(stop() == ExitCode::stopped);
  CHECK(steps() == "1");
  CHECK(validate(folder, {"one"}, "quick").code == ExitCode::done);
  CHECK(went_on());
  CHECK(steps() == "10");
  CHECK(validate(folder, {"one"}, "quick").json.find("\"cached\": true") != std::string::npos);

  SECTION("not if it is not to") {
    ValidateOptions fresh;
    fresh.earlier = Earlier::ignore;
    CHECK(stop(fresh) == ExitCode::stopped);
    CHECK(validate(folder, {"one"}, "quick", fresh).code == ExitCode::done);
    CHECK_FALSE(went_on());
    CHECK(steps() == "10");
  }
  SECTION("not from another scene's") {
    fs::remove_all(folder / "out");
    CHECK(stop() == ExitCode::stopped);
    slow.replace(slow.find("0.02"), 4, "0.04");
    put(folder / "cases" / "one" / "scene.toml", slow);
    CHECK(validate(folder, {"one"}, "quick").code == ExitCode::done);
    CHECK_FALSE(went_on());
    CHECK(steps() == "5");
  }
  SECTION("not after a failure") {
    fs::remove_all(folder / "out");
    CHECK(stop() == ExitCode::stopped);
    std::string summary = contents(run / "summary.json");
    summary.replace(summary.find("\"exit_code\": 75"), 15, "\"exit_code\": 3");
    put(run / "summary.json", summary);
    CHECK(validate(folder, {"one"}, "quick").code == ExitCode::done);
    CHECK_FALSE(went_on());
  }
  SECTION("by another case of that scene") {
    fs::remove_all(folder / "out");
    CHECK(stop() == ExitCode::stopped);
    put_case(folder, "other", case_text("dt", 1.5));
    put(folder / "cases" / "other" / "scene.toml", slow);
    CHECK(validate(folder, {"other"}, "quick").code == ExitCode::done);
    CHECK(went_on());
    CHECK_FALSE(fs::exists(folder / "out" / "other"));
  }
  SECTION("not where something else has finished it") {
    fs::remove_all(folder / "out");
    CHECK(stop() == ExitCode::stopped);
    const Communicator ranks;
    const EmergencyChannel emergency(ranks);
    const auto quiet = [](const std::string&) {};
    CHECK(resume_command({run, {}, EditPolicy::refuse, {}}, {ranks, emergency, {quiet, quiet, {}}}) == ExitCode::done);
    CHECK(validate(folder, {"one"}, "quick").code == ExitCode::done);
    CHECK_FALSE(went_on());
    CHECK(steps() == "10");
  }
  SECTION("anew where it was killed before it could say that it had come to its end") {
    fs::remove_all(folder / "out");
    CHECK(stop() == ExitCode::stopped);
    CHECK(validate(folder, {"one"}, "quick").code == ExitCode::done);
    put(run / "validate.txt", "unfinished\n" + run_identity(read_scene(run / "scene.toml", {}), 1, ""));
    fs::remove(run / "summary.json");
    CHECK(validate(folder, {"one"}, "quick").code == ExitCode::done);
    CHECK_FALSE(went_on());
    CHECK(steps() == "10");
  }
  SECTION("anew where its checkpoints are lost") {
    fs::remove_all(folder / "out");
    CHECK(stop() == ExitCode::stopped);
    fs::remove_all(run / "checkpoints");
    CHECK(validate(folder, {"one"}, "quick").code == ExitCode::done);
    CHECK_FALSE(went_on());
    CHECK(steps() == "10");
  }
}
