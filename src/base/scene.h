#pragma once
// A scene file as plain data in SI units, one header per table. Scene vectors always have three components; in 2D the
// third is zero. src/scene/reader fills it and checks every value. The simulation includes the headers of the tables
// that it reads, not this one, so that a new key causes little recompilation.
#include <map>
#include <string>

#include "base/contact_spec.h"
#include "base/curves.h"
#include "base/domain_spec.h"
#include "base/fluid_spec.h"
#include "base/force_spec.h"
#include "base/gravity_spec.h"
#include "base/joint_spec.h"
#include "base/output_spec.h"
#include "base/probe_spec.h"
#include "base/robot_spec.h"
#include "base/solid_spec.h"
#include "base/solver_spec.h"
#include "base/time_spec.h"

namespace seiche {

struct Scene {
  std::string title;
  std::map<std::string, TimeCurve> curves;  // functions in formulas (base/curves.h)
  std::map<std::string, double> signals;    // values at the start (base/signals.h)
  int dimension = 3;
  GravitySpec gravity;
  DomainSpec domain;
  TimeSpec time;
  LiquidSpec liquid;
  GasSpec gas;
  std::vector<SolidSpec> solids;
  std::vector<RobotSpec> robots;  // as read; expand_robots() makes solids and joints of them
  std::vector<JointSpec> joints;
  std::vector<ContactSpec> contacts;
  std::vector<ForceSpec> forces;
  std::vector<ProbeSpec> probes;
  std::string tracking = "level_set";
  SolverSpec solver;
  OutputSpec output;
};

}  // namespace seiche
