#pragma once
// A simulation without physics on a minimal grid: a chaotic sequence, in which every lost bit shows.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "coupling/state/simulation.h"

namespace seiche {

class FakeSimulation : public Simulation {
 public:
  std::int64_t fails_at = -1;  // this step fails
  double largest_step = 0.03;  // s
  double expected = 1;         // m^2 of liquid

  void set_fault_hook(FaultHook hook) override { hook_ = std::move(hook); }
  double time() const override { return time_; }
  std::int64_t step_count() const override { return step_; }
  StepStats step(double until) override {
    const PhaseFault fault = hook_("solve");
    if (step_ + 1 == fails_at) throw Error(ExitCode::cannot_continue, "the fake solve fails");
    if (fault == PhaseFault::poison) x_ = std::numeric_limits<double>::quiet_NaN();
    dt_ = std::min(largest_step, until - time_);
    time_ = until - time_ <= largest_step ? until : time_ + dt_;
    ++step_;
    x_ = 3.9 * x_ * (1 - x_);
    return stats();
  }
  StepStats stats() const override {
    StepStats s;
    s.step = step_;
    s.time = time_;
    s.dt = dt_;
    s.liquid_volume = 1 + 0.01 * x_;
    s.kinetic_energy = x_;
    return s;
  }
  std::vector<SolidState> solids() const override { return {{"wall", {x_, 0, 0}, {1, 0, 0, 0}, {}, {}, {}, {}}}; }
  SurfaceMesh solid_surface(std::size_t) const override { return {{{0, 0, 0}, {1, 0, 0}}, {}, {{0, 1}}}; }
  ProbeSample probe(std::size_t) const override { return {"p", false, true, x_, {}}; }
  FieldView view(const std::string&) override { return {}; }
  FrameField frame_field(const std::string& name) const override {
    FrameField f{name, FrameField::Kind::level_set, {0, 0, 0}, {2, 2, 1}, {float(x_), -1, -1, -1}};
    if (name != "vel") return f;
    f.kind = FrameField::Kind::staggered_vector;
    f.values.assign(12, float(x_));
    return f;
  }
  double expected_volume() const override { return expected; }
  CheckpointData save() const override {
    CheckpointData data;
    data.scalars = {{"time", time_}, {"step", double(step_)}};
    data.fields = {{"x", {0, 0, 0}, {1, 1, 1}, {x_}}};
    return data;
  }
  void load(const CheckpointData& data) override {
    time_ = data.scalars.at("time");
    step_ = std::int64_t(data.scalars.at("step"));
    x_ = data.fields.at(0).values.unpack().at(0);
  }
  std::vector<FieldRecord> checkpoint_boxes(const CheckpointData&) override {
    return {{"x", {0, 0, 0}, {1, 1, 1}, {}}};
  }
  const Timers& timers() const override { return timers_; }
  std::vector<std::string> take_warnings() override { return {}; }

 private:
  FaultHook hook_ = [](const std::string&) { return PhaseFault::none; };
  Timers timers_;
  double time_ = 0, dt_ = 0, x_ = 0.3;
  std::int64_t step_ = 0;
};

}  // namespace seiche
