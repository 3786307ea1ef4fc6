#include "files/csv.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

namespace csv_tests {
using namespace seiche;

TEST_CASE("stats.csv has the contract's columns first, in its order") {
  const std::string contract =
      "step,time,dt,liquid_volume,kinetic_energy,potential_energy,elastic_energy,momentum_x,momentum_y,momentum_z,max_"
      "speed,"
      "max_divergence,solver_iterations,solver_residual,newton_iterations,contacts,cells_liquid,wall_seconds";
  CHECK(stats_header().rfind(contract, 0) == 0);
  CHECK(solids_header() ==
        "time,name,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,fx,fy,fz,tx,ty,tz,pin_fx,pin_fy,pin_fz,pin_tx,pin_"
        "ty,pin_tz\n");
  CHECK(probes_header() == "time,name,value,x,y,z\n");
}

TEST_CASE("numbers in the tables read back to the same bits") {
  StepStats stats;
  stats.step = 3;
  stats.time = 0.1 + 0.2;
  const std::string row = stats_row(stats);
  CHECK(std::strtod(row.c_str() + 2, nullptr) == stats.time);
  const std::string header = stats_header();
  CHECK(std::count(row.begin(), row.end(), ',') == std::count(header.begin(), header.end(), ','));
}

TEST_CASE("probe rows fill the columns of their kind only") {
  CHECK(probes_row(0.5, {"p", false, true, 2.5, {}}) == "0.5,p,2.5,,,\n");
  CHECK(probes_row(0.5, {"v", true, true, 0, {1, 2, 3}}) == "0.5,v,,1,2,3\n");
  CHECK(probes_row(0.5, {"air", false, false, 0, {}}) == "0.5,air,,,,\n");
  CHECK(probes_row(0.5, {"a,\"b\"", false, true, 1, {}}) == "0.5,\"a,\"\"b\"\"\",1,,,\n");
}

TEST_CASE("the first number that is not finite is named") {
  StepStats stats;
  CHECK(not_finite(stats).empty());
  stats.momentum[1] = std::numeric_limits<double>::quiet_NaN();
  CHECK(not_finite(stats) == "momentum_y");
  SolidState solid;
  solid.force[2] = std::numeric_limits<double>::infinity();
  CHECK(not_finite(solid) == "fz");
}

TEST_CASE("docs/outputs.md lists every column of the tables") {
  std::ifstream file(std::filesystem::path(__FILE__).parent_path() / "../../../docs/outputs.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  const std::pair<const char*, std::string> tables[] = {{"## stats.csv", stats_header()},
                                                        {"## solids.csv", solids_header()},
                                                        {"## joints.csv", joints_header()},
                                                        {"## probes.csv", probes_header()}};
  for (const auto& [title, header] : tables) {
    const std::size_t from = page.find(title);
    REQUIRE(from != std::string::npos);
    const std::string section = page.substr(from, page.find("\n## ", from) - from);
    std::istringstream names(header.substr(0, header.size() - 1));
    for (std::string name; std::getline(names, name, ',');) {
      INFO(title << " " << name);
      CHECK(section.find("`" + name + "`") < section.rfind("|"));
    }
  }
}

}  // namespace csv_tests
