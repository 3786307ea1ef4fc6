// `seiche check`: examines a scene without running it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/agree.h"
#include "base/scene.h"
#include "base/thread_limit.h"
#include "files/checked_file.h"
#include "files/frames.h"
#include "fluid/rheology/rheology.h"
#include "geometry/shapes/shapes.h"
#include "run/command.h"
#include "run/estimate.h"
#include "run/memory.h"
#include "run/mesh_extents.h"
#include "run/start_table.h"
#include "run/threads.h"
#include "scene/writer.h"
#include "solid/elastic/solid.h"
#include "solid/mesh/point.h"

namespace seiche {
namespace {

// Grids up to this size are set up as for a run, within a few seconds.
constexpr std::int64_t most_cells_set_up = 2'000'000;

// Findings about the solids of a scene.
struct Verified {
  std::vector<std::string> notes, meshes;
  double nodes = 0, factors = 0;  // of elastic solids; bytes of their Cholesky factors
};

// The set-up for a run makes the shapes of sources and solids itself and tells their notes; doing it here as well would
// double the time.
std::vector<const ShapeSpec*> shapes_of(const Scene& scene, bool set_up) {
  std::vector<const ShapeSpec*> shapes;
  for (const auto& region : scene.liquid.regions) shapes.push_back(&region.shape);
  if (set_up) return shapes;
  for (const auto& source : scene.liquid.sources) shapes.push_back(&source.shape);
  for (const auto& drain : scene.liquid.drains) shapes.push_back(&drain.shape);
  for (const auto& solid : scene.solids) {
    if (!solid.kind.has_elements) shapes.push_back(&solid.shape);
  }
  return shapes;
}

// Meshes an elastic solid as a run would, and finds the points of its displacement probes.
template <int Dim>
void verify_elastic(const Scene& scene, const SolidSpec& solid, const ShapeOptions& options, Verified& found) {
  const Vec<Dim> lower = truncate<Dim>(scene.domain.lower), upper = truncate<Dim>(scene.domain.upper);
  const ElasticSolid<Dim> elastic = make_elastic_solid<Dim>(solid, options, lower, upper);
  for (const ProbeSpec& probe : scene.probes) {
    if (probe.kind == ProbeKind::displacement && probe.solid == solid.name)
      point_of_probe<Dim>(elastic.body.mesh, probe);
  }
  found.meshes.push_back(describe_mesh<Dim>(solid.name, elastic.body.mesh));
  found.nodes += double(elastic.body.size()) / Dim;
  found.factors += factor_bytes(Dim, elastic.body.size());
}

template <int Dim>
void verify_shapes(const Scene& scene, bool set_up, Verified& found) {
  const ShapeOptions options{scene.domain.cell_size, &found.notes};
  for (const ShapeSpec* shape : shapes_of(scene, set_up)) make_shape<Dim>(*shape, options);
  for (const SolidSpec& solid : scene.solids) {
    if (solid.kind.has_elements && !set_up) verify_elastic<Dim>(scene, solid, options, found);
    if (solid.kind.follows_meshes && !set_up) MeshSequence(Dim, solid.shape, solid.sequence, options);
  }
}

Verified verify_solids(const Scene& scene, bool set_up) {
  Verified found;
  scene.dimension == 2 ? verify_shapes<2>(scene, set_up, found) : verify_shapes<3>(scene, set_up, found);
  return found;
}

// Description of a scene at its start, and of the cost of its run.
struct Findings {
  std::vector<std::string> warnings, lines;
  JsonMembers json;
};

// Writes frame 0 as a run directory that the renderer can read.
void write_start(const Scene& scene, const Simulation& simulation, const std::filesystem::path& folder,
                 const Communicator& ranks) {
  Scene shown = scene;
  shown.output.frames = {"surface"};
  shown.output.formats = {"vdb"};
  shown.output.surface = "closed";
  const RunPaths paths{folder};
  agree_on_root(ranks, "writing the start of the scene", [&] {
    make_folder(paths.frames());
    write_file(paths.scene(), write_scene(shown));
  });
  FrameWriter(shown, paths, ranks).write({0, 0, 0}, simulation, PhaseFault::none);
}

// Makes steps and keeps nothing of them. Collective.
TrialSteps make_trial_steps(const Scene& scene, Simulation& simulation, int steps, const Communicator& ranks) {
  std::vector<double> seconds;
  TrialSteps trial;
  for (int n = 0; n < steps && simulation.time() < scene.time.end; ++n) {
    const double frame = 1 / scene.time.frame_rate, now = simulation.time();
    const double next = (std::floor(now / frame * (1 + 1e-12) + 1e-9) + 1) * frame;
    seconds.push_back(ranks.global_max(simulation.step(std::min(next, scene.time.end)).wall_seconds));
  }
  trial.steps = int(seconds.size());
  if (seconds.empty()) return trial;
  const bool skips_first = seconds.size() > 2;  // it sets up what later steps reuse
  const auto first = seconds.begin() + skips_first;
  const auto [least, most] = std::minmax_element(first, seconds.end());
  trial.fastest = *least;
  trial.slowest = *most;
  std::nth_element(first, first + (seconds.end() - first) / 2, seconds.end());
  trial.seconds = *(first + (seconds.end() - first) / 2);
  trial.dt = simulation.time() / trial.steps;
  trial.memory = ranks.global_sum(peak_resident_bytes());
  return trial;
}

std::string grid_line(const Scene& scene, std::int64_t cells) {
  const auto& n = scene.domain.cells;
  std::string text = fmt::format("cells   {} ({} x {}", cells, n[0], n[1]);
  return text + (scene.dimension == 3 ? fmt::format(" x {})", n[2]) : ")");
}

void describe_cost(const Scene& scene, const RunSize& size, const std::optional<TrialSteps>& trial,
                   const Threads& threads, const Communicator& ranks, Findings& found) {
  const RunEstimate estimate = estimate_run(scene, size, ranks.size(), threads.count, trial);
  for (std::string& line : estimate_lines(scene, estimate, ranks.size(), threads.count, trial))
    found.lines.push_back(std::move(line));
  found.json.emplace_back("size", size_json(size));
  found.json.emplace_back("estimate", estimate_json(estimate, trial));
}

// The same for a grid that is too large to be set up here: half of it is taken as liquid.
void describe_unseen(const Scene& scene, const Cost& cost, const Verified& verified, const Threads& threads,
                     const Communicator& ranks, Findings& found) {
  RunSize size;
  size.cells = double(cost.cells);
  size.fluid = size.near = size.cells / 2;
  size.band = 6 * std::pow(size.cells, 1 - 1.0 / scene.dimension);
  size.nodes = verified.nodes;
  size.factors = verified.factors;
  found.lines.insert(found.lines.end(), verified.meshes.begin(), verified.meshes.end());
  found.lines.push_back(
      "note: the grid is too large to evaluate formulas and measure liquid and solids here; the run does it as it "
      "begins. Estimates below take half of the cells as liquid; --measure 3 sets the scene up and tries it");
  describe_cost(scene, size, {}, threads, ranks, found);
}

// Sets up the initial state, which evaluates the formulas as a run would, and describes liquid, solids and costs.
// Collective.
void look_at_start(const Scene& scene, const CheckOptions& options, const Threads& threads, const Communicator& ranks,
                   Findings& found) {
  const std::unique_ptr<Simulation> simulation = make_simulation(scene, ranks);
  for (std::string& text : simulation->take_warnings())
    if (std::find(found.warnings.begin(), found.warnings.end(), text) == found.warnings.end())
      found.warnings.push_back(std::move(text));
  const StartAccount start = simulation->start_account();
  for (std::string& line : start_table(start, scene.dimension)) found.lines.push_back(std::move(line));
  found.lines.insert(found.lines.end(), start.others.begin(), start.others.end());
  found.json = start_json(start, scene.dimension);
  const RunSize size = measure_size(scene, *simulation, ranks);
  if (size.factors > 0)
    found.lines.push_back(fmt::format("factors of elastic solids take about {}", readable_bytes(size.factors)));
  if (!options.frame_folder.empty()) write_start(scene, *simulation, options.frame_folder, ranks);
  std::optional<TrialSteps> trial;
  if (options.trial_steps > 0) trial = make_trial_steps(scene, *simulation, options.trial_steps, ranks);
  describe_cost(scene, size, trial, threads, ranks, found);
}

void print(const Findings& found, const CheckOptions& options, const Communicator& ranks, RunLog& log) {
  for (const std::string& text : found.warnings) log.warn(text);
  if (!options.json) {
    for (const std::string& text : found.lines) log.note(text);
    return;
  }
  JsonItems warnings;
  for (const std::string& text : found.warnings) warnings.emplace_back(text);
  JsonMembers members{{"scene", options.scene.string()}, {"ranks", ranks.size()}, {"warnings", warnings}};
  members.insert(members.end(), found.json.begin(), found.json.end());
  std::string text = format_json(members);
  text.pop_back();  // its newline
  log.note(text);
}

// Lines about the scene that need no grid.
std::vector<std::string> first_lines(const Scene& scene, const CheckOptions& options) {
  std::vector<std::string> lines{fmt::format("{}: no errors", options.scene.string())};
  for (const std::string& text : {note_of_end(scene), describe_rheology(scene.liquid.rheology)})
    if (!text.empty()) lines.push_back(text);
  return lines;
}

}  // namespace

ExitCode check_command(const CheckOptions& options, const Surroundings& around) {
  const Communicator& ranks = around.ranks;
  RunLog log(ranks, around.console, Verbosity::normal);
  Scene scene;
  Verified verified;
  Findings found;
  Cost cost;
  bool set_up = true;
  agree(ranks, "checking the scene", [&] {
    scene = read_scene(options.scene, options.overrides);
    cost = estimate_cost(scene, ranks.size());
    check_memory(cost, ranks.size(), ranks_on_this_machine(ranks), machine_memory());
    found.warnings = check_mesh_extents(scene);
    set_up = cost.cells <= most_cells_set_up || !options.frame_folder.empty() || options.trial_steps > 0;
    verified = verify_solids(scene, set_up);
  });
  found.warnings.insert(found.warnings.end(), verified.notes.begin(), verified.notes.end());
  const Threads threads = choose_threads(options.threads, ranks, log);
  const ThreadLimit limit(threads.count);
  found.lines = first_lines(scene, options);
  found.lines.push_back(grid_line(scene, cost.cells));
  if (set_up)
    look_at_start(scene, options, threads, ranks, found);
  else
    describe_unseen(scene, cost, verified, threads, ranks, found);
  print(found, options, ranks, log);
  return ExitCode::done;
}

}  // namespace seiche
