#include "info/info.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>

#include "base/crc32c.h"
#include "base/error.h"
#include "base/scene.h"
#include "files/checked_file.h"
#include "files/checkpoint_commit.h"
#include "files/checkpoint_file.h"
#include "files/json.h"
#include "files/point_cache.h"
#include "files/run_directory.h"
#include "files/vtu_reader.h"
#include "render/frame.h"
#include "scene/reader.h"

namespace seiche {
namespace {

namespace fs = std::filesystem;
using Lines = std::vector<std::string>;

std::string kind_name(vdb::GridKind kind) {
  if (kind == vdb::GridKind::level_set) return "level set, m";
  return kind == vdb::GridKind::staggered_vector ? "staggered vectors" : "scalars";
}

// Liquid volume with a flat interface in each cell: the share of a cell is clamp(1/2 - phi/h). Exact to about one
// percent of the surface cells.
double volume_below(const vdb::Grid& grid, const vdb::Frame& frame) {
  double cells = 0;
  for (const float phi : grid.blocks.at(0).values) cells += std::clamp(0.5 - phi / frame.cell_size, 0.0, 1.0);
  return cells * std::pow(frame.cell_size, frame.dimension);
}

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::istringstream in(row);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

// Liquid volume in the row of stats.csv at time t; empty if there is no such row.
std::optional<double> volume_in_stats(const fs::path& file, double t) {
  constexpr double same_time = 1e-12;  // relative
  std::ifstream in(file);
  std::string row;
  std::getline(in, row);
  const Lines names = cells_of(row);
  const auto column = [&](const char* name) {
    return std::size_t(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const std::size_t time = column("time"), volume = column("liquid_volume");
  std::optional<double> found;
  while (std::getline(in, row)) {
    const Lines cells = cells_of(row);
    if (cells.size() <= std::max(time, volume)) continue;
    if (std::abs(std::atof(cells[time].c_str()) - t) <= same_time * std::abs(t))
      found = std::atof(cells[volume].c_str());
  }
  return found;
}

// The volume in the run's table is exact. A frame's free surface continues within solids, where there is no liquid.
std::string describe_volume(const fs::path& file, const vdb::Grid& grid, const vdb::Frame& frame) {
  const char* unit = frame.dimension == 3 ? "m^3" : "m^3 per metre of depth";
  const auto stats = fs::absolute(file).parent_path().parent_path() / "stats.csv";
  const auto known = grid.name == "surface" ? volume_in_stats(stats, frame.time) : std::optional<double>();
  if (known) return fmt::format("liquid volume {:.6g} {} (stats.csv)", *known, unit);
  const bool closed = grid.name == "surface" && vdb::level_set_name(frame) == "free_surface";
  return fmt::format("about {:.6g} {} below the surface{}", volume_below(grid, frame), unit,
                     closed ? "" : ", that within solids counted");
}

std::string describe_values(const fs::path& file, const vdb::Grid& grid, const vdb::Frame& frame) {
  if (grid.kind == vdb::GridKind::level_set) return describe_volume(file, grid, frame);
  const bool vectors = grid.kind == vdb::GridKind::staggered_vector;
  const auto values = vectors ? render::quantity_of(frame, grid.name).values : grid.blocks.at(0).values;
  if (values.empty()) return "no values";
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return fmt::format("{} {:.6g} to {:.6g}", vectors ? "length at cell centres" : "values", *low, *high);
}

std::string describe_drops(const vdb::Frame& frame) {
  double volume = 0, fastest = 0, largest = 0;
  for (const vdb::Point& p : frame.points) {
    volume += frame.dimension == 3 ? 4 * M_PI / 3 * std::pow(p.radius, 3) : M_PI * p.radius * p.radius;
    fastest = std::max(fastest, p.velocity.norm());
    largest = std::max(largest, p.radius);
  }
  return fmt::format("  {} (points): {}, {:.6g} {} in them; radius at most {:.4g} m, speed at most {:.4g} m/s",
                     vdb::point_grid_name, frame.points.size(), volume,
                     frame.dimension == 3 ? "m^3" : "m^3 per metre of depth", largest, fastest);
}

// A committed checkpoint and its verified contents.
struct Verified {
  Commit commit;
  CheckpointFile first;
  std::uint64_t bytes = 0;
};

// Throws Error(bad_checkpoint) at the first fault.
Verified verify(const fs::path& folder) {
  const auto fail = [&](const std::string& what) {
    throw Error(ExitCode::bad_checkpoint, fmt::format("{}: {}", folder.string(), what));
  };
  Verified verified;
  const auto commit = parse_commit(read_whole_file(folder / "COMMIT"));
  if (!commit) fail("its COMMIT file is damaged; resume uses an older checkpoint");
  verified.commit = *commit;
  for (const CommittedFile& file : commit->files) {
    const std::string bytes = read_whole_file(folder / file.name);
    if (bytes.size() != file.bytes || crc32c(bytes) != file.checksum) {
      fail(fmt::format("{} is damaged; resume uses an older checkpoint", file.name));
    }
    verified.bytes += bytes.size();
    const CheckpointDefect defect = examine_checkpoint_file(bytes);
    if (defect.kind != CheckpointDefect::Kind::none) fail(file.name + ": " + defect.text);
    if (&file == &commit->files.front()) verified.first = decode_checkpoint_file(bytes);
  }
  return verified;
}

std::string describe_names(const std::vector<FieldRecord>& fields) {
  std::string names;
  for (const FieldRecord& field : fields) names += (names.empty() ? "" : ", ") + field.name;
  return names.empty() ? "none" : names;
}

std::string checkpoint_state(const fs::path& folder) {
  try {
    const Verified verified = verify(folder);
    return fmt::format("step {}, {} rank{}, {:.1f} MB, verified", verified.commit.step, verified.commit.files.size(),
                       verified.commit.files.size() == 1 ? "" : "s", double(verified.bytes) / 1e6);
  } catch (const Error& error) {
    return fmt::format("not usable ({})", error.what());
  }
}

Lines list_checkpoints(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing)) {
    if (entry.is_directory() && entry.path().extension() != ".tmp") found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  Lines lines;
  for (const fs::path& path : found) {
    lines.push_back(fmt::format("  checkpoint {}: {}", path.filename().string(), checkpoint_state(path)));
  }
  if (lines.empty()) lines.push_back("  no checkpoints");
  return lines;
}

void add_summary(const fs::path& file, Lines& lines) {
  std::ifstream in(file);
  if (!in) {
    lines.push_back("  no summary.json: the run is in progress, or it was killed");
    return;
  }
  std::ostringstream text;
  text << in.rdbuf();
  const std::string json = text.str();
  if (!is_json_object(json)) lines.push_back("  summary.json is damaged");
  const std::pair<const char*, const char*> rows[] = {{"ended", "ended"},
                                                      {"exit_code", "exit code"},
                                                      {"version", "version"},
                                                      {"ranks", "ranks"},
                                                      {"steps", "steps"},
                                                      {"time", "simulated time, s"},
                                                      {"cells", "cells"},
                                                      {"wall_seconds", "wall seconds"},
                                                      {"peak_memory_bytes", "peak memory, bytes"},
                                                      {"liquid_volume", "liquid volume, m^3"},
                                                      {"volume_drift", "volume drift, relative"},
                                                      {"worst_residual", "worst residual"},
                                                      {"worst_divergence", "worst divergence, 1/s"}};
  for (const auto& [key, label] : rows) {
    const std::string value = json_value(json, key);
    if (!value.empty()) lines.push_back(fmt::format("  {}: {}", label, value));
  }
}

void add_scene(const fs::path& file, Lines& lines) {
  try {
    const Scene scene = read_scene(file, {});
    if (!scene.title.empty()) lines.push_back("  title: " + scene.title);
    const auto& cells = scene.domain.cells;
    lines.push_back(
        scene.dimension == 2
            ? fmt::format("  2D, {} x {} cells of {:g} m", cells[0], cells[1], scene.domain.cell_size)
            : fmt::format("  3D, {} x {} x {} cells of {:g} m", cells[0], cells[1], cells[2], scene.domain.cell_size));
    lines.push_back(fmt::format("  {} solid{}, ends at t = {:g} s", scene.solids.size(),
                                scene.solids.size() == 1 ? "" : "s", scene.time.end));
  } catch (const Error& error) {
    lines.push_back(fmt::format("  the scene cannot be read: {}", error.what()));
  }
}

// Point caches of elastic solids' surfaces.
Lines list_caches(const fs::path& folder) {
  Lines lines;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing)) {
    if (entry.path().extension() != ".pc2") continue;
    const auto facts = point_cache::read_facts(entry.path());
    const std::string what =
        facts ? fmt::format("{} points in {} frames from frame {}", facts->points, facts->samples, facts->first_frame)
              : std::string("no point cache of ours");
    lines.push_back(fmt::format("  deforming surface {}: {}", entry.path().filename().string(), what));
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

std::string last_row_of(const fs::path& file) {
  std::ifstream in(file);
  std::string row, last;
  while (std::getline(in, row)) {
    if (!row.empty()) last = row;
  }
  return last;
}

}  // namespace

Lines describe_frame(const fs::path& file) {
  const vdb::Frame frame = vdb::decode(file);
  Lines lines{fmt::format("{}: frame {} at t = {:g} s, {}D, dt {:g} s, written by {}", file.string(), frame.number,
                          frame.time, frame.dimension, frame.dt,
                          frame.creator.empty() ? "an unknown program" : frame.creator)};
  for (const vdb::Grid& grid : frame.grids) {
    const auto& upper = grid.blocks.at(0).upper;
    lines.push_back(fmt::format("  {} ({}): {} x {} x {} cells of {:g} m from ({:g}, {:g}, {:g}); {}", grid.name,
                                kind_name(grid.kind), upper[0], upper[1], upper[2], frame.cell_size, frame.lower[0],
                                frame.lower[1], frame.lower[2], describe_values(file, grid, frame)));
  }
  if (!frame.points.empty()) lines.push_back(describe_drops(frame));
  return lines;
}

Lines describe_grid(const fs::path& file) {
  const render::GridSummary grid = render::summarize_grid(file);
  Lines lines{fmt::format("{}: solids at t = {:g} s", file.string(), grid.time)};
  for (const render::SolidSummary& solid : grid.solids) {
    std::string line = fmt::format("  {}: {} points, {} {}", solid.name.empty() ? "a solid" : solid.name, solid.points,
                                   solid.cells, grid.has_fields ? "elements" : "facets");
    if (grid.has_fields) {
      line += fmt::format("; at most {:.4g} m displaced, {:.4g} m/s, {:.4g} Pa of von Mises stress",
                          solid.largest_displacement, solid.largest_speed, solid.largest_stress);
    }
    lines.push_back(line);
  }
  if (grid.solids.empty()) lines.push_back("  no solids");
  return lines;
}

Lines describe_checkpoint(const fs::path& folder) {
  const Verified verified = verify(folder);
  const CheckpointFile& first = verified.first;
  const auto time = first.data.scalars.find("run.time");
  Lines lines{fmt::format("{}: checkpoint of step {}, {}D, format {}, written by {}", folder.string(),
                          verified.commit.step, first.header.dimension, verified.commit.format, first.header.creator)};
  if (time != first.data.scalars.end()) lines.push_back(fmt::format("  t = {:g} s", time->second));
  lines.push_back(fmt::format("  {} rank{}, {} bytes, all checksums verified", first.header.ranks,
                              first.header.ranks == 1 ? "" : "s", verified.bytes));
  lines.push_back("  scene hash " + first.header.scene_hash);
  lines.push_back("  fields: " + describe_names(first.data.fields));
  lines.push_back(fmt::format("  {} numbers and {} texts besides", first.data.scalars.size(), first.data.texts.size()));
  return lines;
}

Lines describe_run(const fs::path& folder) {
  const RunPaths paths{folder};
  Lines lines{fmt::format("{}: run directory", folder.string())};
  add_scene(paths.scene(), lines);
  add_summary(paths.summary(), lines);
  const auto frames = render::list_frames(paths.frames());
  lines.push_back(frames.empty() ? std::string("  no frames")
                                 : fmt::format("  {} frame{}, {} to {}", frames.size(), frames.size() == 1 ? "" : "s",
                                               frames.front(), frames.back()));
  for (const std::string& line : list_caches(paths.frames())) lines.push_back(line);
  std::istringstream last(last_row_of(paths.stats()));
  std::string step, time;
  if (std::getline(last, step, ',') && std::getline(last, time, ',') && step != "step") {
    lines.push_back(fmt::format("  last row of stats.csv: step {}, t = {} s", step, time));
  }
  for (const std::string& line : list_checkpoints(paths.checkpoints())) lines.push_back(line);
  return lines;
}

Lines describe_path(const fs::path& path) {
  std::error_code failed;
  const bool folder = fs::is_directory(path, failed), file = fs::is_regular_file(path, failed);
  if (file && path.extension() == ".vdb") return describe_frame(path);
  if (file && path.extension() == ".vtu") return describe_grid(path);
  if (folder && fs::exists(path / "COMMIT")) return describe_checkpoint(path);
  if (file && fs::exists(path.parent_path() / "COMMIT")) return describe_checkpoint(path.parent_path());
  if (folder && (fs::exists(path / "scene.toml") || fs::exists(path / "frames"))) return describe_run(path);
  const std::string what = folder ? "holds no run and no checkpoint"
                           : file ? "is not a frame (.vdb, .vtu)"
                                  : "is not there";
  throw Error(ExitCode::bad_input,
              fmt::format("{}: {}; give a frame, a folder of checkpoints/, or a run directory", path.string(), what));
}

}  // namespace seiche
