// Sources and drains with a rate, and drains that keep a shape empty: the volume that comes and goes, to the bars.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "base/solid_spec.h"
#include "volume_scenes.h"

namespace volumes_fed_tests {
using namespace seiche;
using test::add_liquid;
using test::box_scene;

namespace {

Scene half_full(int dim, bool cells) {
  Scene s = box_scene(dim, dim == 2 ? 24 : 12);
  s.gravity = {0, -9.81, 0};
  s.liquid.volume = cells ? VolumeKeeping::in_cells : VolumeKeeping::by_shift;
  add_liquid(s, "y-0.6");
  return s;
}

LiquidSourceSpec fed_box(int dim, double low, double high, const Formula& rate) {
  LiquidSourceSpec source;
  source.shape.kind = "box", source.shape.where = "test";
  source.shape.lower = {low, 0.1, dim == 2 ? 0 : 0.4}, source.shape.upper = {high, 0.27, dim == 2 ? 0 : 0.61};
  source.rate = rate;
  return source;
}

void run_to(Simulation& sim, double end) {
  while (sim.time() < end * (1 - 1e-12)) (void)sim.step(end);
}

}  // namespace

// With volumes in cells the bar is rounding: what feeds bring is added to the cells, step by step, as it is booked.
TEST_CASE("feeds: volumes in cells follow the integral of the rates to rounding", "[volumes]") {
  for (const int dim : {2, 3})
    for (const double sign : {1.0, -1.0}) {
      Scene s = half_full(dim, true);
      s.time.fixed_step = 0.004;
      const double q = dim == 2 ? 0.4 : 0.15;
      (sign > 0 ? s.liquid.sources : s.liquid.drains)
          .push_back(fed_box(dim, 0.2, 0.5, std::to_string(q) + "*(1+10*t)"));
      const auto sim = make_simulation(s, Communicator());
      const double start = sim->stats().liquid_volume;
      for (int n = 0; n < 40; ++n) {
        const StepStats stats = sim->step(1);
        const double t = sim->time(), expected = start + sign * q * (t + 5 * t * t);
        INFO(dim << "D, sign " << sign << ", step " << n);
        REQUIRE(stats.liquid_volume == Approx(expected).epsilon(1e-9));
        REQUIRE(sim->expected_volume() == Approx(expected).epsilon(1e-9));
      }
      WARN(dim << "D: volume " << sim->stats().liquid_volume << ", spilled " << sim->stats().volume_spilled);
    }
}

// One shift of the surface restores what it lacks, a twentieth of a cell a step at most.
TEST_CASE("feeds: with the shift the volume follows the integral of the rates", "[volumes]") {
  for (const int dim : {2, 3})
    for (const double sign : {1.0, -1.0}) {
      Scene s = half_full(dim, false);
      const double q = dim == 2 ? 0.4 : 0.2, end = 0.25;
      (sign > 0 ? s.liquid.sources : s.liquid.drains).push_back(fed_box(dim, 0.2, 0.5, std::to_string(q)));
      s.time.max_step = 0.005;
      const auto sim = make_simulation(s, Communicator());
      const double start = sim->stats().liquid_volume;
      run_to(*sim, end);
      WARN(dim << "D, sign " << sign << ": off by " << (sim->stats().liquid_volume - start) / (sign * q * end) - 1
               << ", corrected " << sim->stats().volume_corrected / (q * end));
      CHECK(sim->expected_volume() == Approx(start + sign * q * end).epsilon(1e-9));
      CHECK(sim->stats().liquid_volume == Approx(start + sign * q * end).epsilon(1e-4));  // what one shift leaves
      // The first half step moves with the flow at rest: 1 % here, as measured.
      CHECK(std::abs(sim->stats().volume_corrected) < 0.03 * q * end);
    }
}

// The flow itself carries what is brought: net flux through a box around the feed, from the solve, is the rate.
TEST_CASE("feeds: the flow leaves a source and enters a drain at the rate", "[volumes]") {
  for (const int dim : {2, 3}) {
    Scene s = box_scene(dim, dim == 2 ? 24 : 12);
    s.gravity = {0, -9.81, 0};
    add_liquid(s, "-1");
    const double q = 0.3;
    s.liquid.sources.push_back(fed_box(dim, 0.1, 0.25, "0.3"));
    s.liquid.drains.push_back(fed_box(dim, 0.75, 0.9, "0.3"));
    ProbeSpec& flux = s.probes.emplace_back();
    flux.kind = ProbeKind::flux, flux.name = "middle";
    flux.lower = {0.5, 0, 0}, flux.upper = {0.5, 1, dim == 2 ? 0.0 : 1.0};
    const auto sim = make_simulation(s, Communicator());  // a closed, full tank: source and drain balance
    for (int n = 0; n < 3; ++n) (void)sim->step(1);
    CHECK(sim->probe(0).value == Approx(q).epsilon(1e-6));  // the solver's tolerance over the cells
    CHECK(sim->stats().max_divergence < 1e-5 * q / std::pow(s.domain.cell_size, dim));
  }
}

TEST_CASE("feeds: a closed full tank has no flow for a source alone", "[volumes]") {
  for (const int dim : {2, 3}) {
    Scene s = box_scene(dim, 8);
    add_liquid(s, "-1");
    s.liquid.sources.push_back(fed_box(dim, 0.1, 0.4, "0.1"));
    const auto sim = make_simulation(s, Communicator());
    try {
      (void)sim->step(1);
      FAIL_CHECK("the step was taken");
    } catch (const Error& e) {
      CHECK(e.code() == ExitCode::cannot_continue);
      CHECK_THAT(e.what(), Catch::Matchers::Contains("incompressible container, prescribed volume change 0.1 m^") &&
                               Catch::Matchers::Contains("by liquid.source.0"));
    }
  }
}

// One line a spell: while the rate is zero the source wants nothing. Drains of empty shapes are not told.
TEST_CASE("feeds: sources with a rate above the surface are told of, once a spell", "[volumes]") {
  for (const int dim : {2, 3})
    for (const bool cells : {false, true}) {
      Scene s = half_full(dim, cells);
      s.time.fixed_step = 0.01;
      LiquidSourceSpec dry = fed_box(dim, 0.25, 0.5, "t < 0.045 || t > 0.065 ? 0.1 : 0"),
                       wet = fed_box(dim, 0.6, 0.8, "0.01");
      dry.shape.lower[1] = 0.75, dry.shape.upper[1] = 0.9;
      s.liquid.sources = {wet, dry};
      s.liquid.drains = {dry};
      const auto sim = make_simulation(s, Communicator());
      std::vector<std::string> told;
      for (int n = 0; n < 10; ++n) {
        (void)sim->step(1);
        for (std::string& line : sim->take_warnings())
          if (line.find("brings nothing") != std::string::npos) told.push_back(std::move(line));
      }
      INFO(dim << "D, cells " << cells);
      REQUIRE(told.size() == 2);
      CHECK_THAT(told[0], Catch::Matchers::Contains("step 1: liquid.source.1 brings nothing from t = 0 s on"));
      CHECK_THAT(told[1], Catch::Matchers::Contains("step 7: liquid.source.1"));
    }
}

// A drain takes air in proportion: where its shape is half full, half of its rate is liquid.
TEST_CASE("feeds: a half-full drain takes half of its rate", "[volumes]") {
  for (const int dim : {2, 3}) {
    Scene s = half_full(dim, true);
    s.gravity = {0, 0, 0};
    s.time.fixed_step = 1e-4;
    LiquidSourceSpec drain = fed_box(dim, 0.25, 0.5, "0.2");
    drain.shape.lower[1] = 0.6 - 0.25, drain.shape.upper[1] = 0.6 + 0.25;
    s.liquid.drains.push_back(drain);
    const auto sim = make_simulation(s, Communicator());
    const double start = sim->stats().liquid_volume;
    for (int n = 0; n < 10; ++n) (void)sim->step(1);
    const double taken = (start - sim->stats().liquid_volume) / (0.2 * sim->time());
    CHECK(taken == Approx(0.5).margin(0.06));  // whole cells count as liquid or air: half a cell of eight
  }
}

// Liquid above a hole falls into it; all that was in the hole goes at once.
TEST_CASE("drains: a shape is kept empty, and what it takes is booked", "[volumes]") {
  for (const int dim : {2, 3})
    for (const bool cells : {false, true}) {
      Scene s = half_full(dim, cells);
      LiquidSourceSpec drain = fed_box(dim, 0.25, 0.5, "0");
      drain.rate.reset();
      drain.shape.lower = {0.25, -1, dim == 2 ? 0 : 0.25}, drain.shape.upper = {0.5, 0.25, dim == 2 ? 0 : 0.5};
      drain.from = 0.05, drain.until = 0.3;
      s.liquid.drains.push_back(drain);
      const auto sim = make_simulation(s, Communicator());
      const double start = sim->stats().liquid_volume, hole = dim == 2 ? 0.0625 : 0.015625;
      run_to(*sim, 0.05);
      CHECK(sim->stats().liquid_volume == Approx(start).epsilon(1e-9));
      run_to(*sim, 0.06);
      CHECK(start - sim->stats().liquid_volume > 0.9 * hole);  // liquid flows in at once
      run_to(*sim, 0.3);
      const double after = sim->stats().liquid_volume;
      CHECK(start - after > 2 * hole);
      CHECK(after == Approx(sim->expected_volume()).epsilon(cells ? 1e-9 : 1e-2));  // the shift lags behind
      run_to(*sim, 0.35);
      const double last = sim->stats().liquid_volume;
      WARN(dim << "D, " << (cells ? "cells" : "shift") << ": taken " << (start - after) / hole << " holes, "
               << last / sim->expected_volume() - 1);
      CHECK(last == Approx(sim->expected_volume()).epsilon(cells ? 1e-9 : 1e-2));
    }
}

}  // namespace volumes_fed_tests
