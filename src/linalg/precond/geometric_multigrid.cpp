#include "linalg/precond/geometric_multigrid.h"

#include <algorithm>

#include "linalg/precond/multigrid_assembly.h"
#include "linalg/precond/multigrid_coarsen.h"
#include "linalg/precond/multigrid_coarsest.h"

namespace seiche {
namespace {

// A level, and how its values reach the next one: by coarsening, or, where every rank takes the whole of it, by copies.
template <int Dim>
struct Stage {
  std::unique_ptr<MultigridLevel<Dim>> level;
  bool gathers = false;
  BlockExchange gather, scatter;
};

// A row on no cell.
struct LoneRow {
  std::size_t row;
  float inverse;  // 1 / a_ii
};

template <int Dim>
class GeometricMultigrid : public Preconditioner {
 public:
  GeometricMultigrid(const LinearSystem& system, const CellBox& box, StencilRows<Dim> stencil,
                     const MultigridSettings& settings);
  void apply(const Vector& r, Vector& z) override;

 private:
  using TimeLevel = MultigridLevel<Dim>;
  void add_first_level(const CellBox& box, StencilRows<Dim>& stencil);
  void add_coarse_level();
  void add_whole_level();
  void cycle(std::size_t n);

  MultigridSettings settings_;
  Communicator ranks_;
  std::array<int, 3> periodic_;
  std::vector<int> place_;  // of each row, in `home`
  std::vector<LoneRow> lone_;
  // On several ranks, blocks of rows are cut elsewhere than those of the first level.
  std::vector<float> home_b_, home_x_;
  BlockExchange to_level_, to_home_;
  std::vector<Stage<Dim>> stages_;
  std::vector<float> excess_;  // of the last level, at set-up
  CoarsestSolve<Dim> coarsest_;
};

template <int Dim>
BlockExchange copies(const BlockPlan& plan, const SplitRows<Dim>& from, const SplitRows<Dim>& to,
                     const Communicator& ranks) {
  const auto place = [](const SplitRows<Dim>& rows) {
    return [&rows](const std::array<int, 3>& c) { return rows.at(c); };
  };
  return BlockExchange(
      plan, place(from), place(to), [](const auto&) { return true; }, ranks);
}

template <int Dim>
std::int64_t active_cells(const MultigridLevel<Dim>& level) {
  return std::count_if(level.inverse.begin(), level.inverse.end(), [](float v) { return v > 0; });
}

// Each rank takes what it owns of a level that every rank holds: nothing is sent.
template <int Dim>
BlockExchange own_part(const std::vector<CellBox>& blocks, const SplitRows<Dim>& from, const SplitRows<Dim>& to,
                       const Communicator& ranks) {
  BlockPlan plan{blocks, {}, {0, 0, 0}};
  for (const CellBox& block : blocks) plan.wanted.push_back({block});
  return copies(plan, from, to, ranks);
}

BlockPlan all_take(const std::vector<CellBox>& blocks, const CellBox& whole) {
  return {blocks, std::vector<std::vector<CellBox>>(blocks.size(), {whole}), {0, 0, 0}};
}

// Blocks that begin and end at multiples of `step`, but at the sides of the box: cells of the coarse levels then have
// all their children on one rank.
std::vector<CellBox> aligned(std::vector<CellBox> blocks, const CellBox& box, int step) {
  for (CellBox& block : blocks)
    for (int a = 0; a < 3; ++a) {
      const auto round = [&](int i) {
        const int at = (i + step / 2) / step * step;
        return i <= box.lower[a]   ? box.lower[a]
               : i >= box.upper[a] ? box.upper[a]
                                   : std::clamp(at, box.lower[a], box.upper[a]);
      };
      block.lower[a] = round(block.lower[a]);
      block.upper[a] = round(block.upper[a]);
    }
  return blocks;
}

template <int Dim>
GeometricMultigrid<Dim>::GeometricMultigrid(const LinearSystem& system, const CellBox& box, StencilRows<Dim> stencil,
                                            const MultigridSettings& settings)
    : settings_(settings),
      ranks_(system.ranks()),
      periodic_(system.grid().periodic),
      place_(std::move(stencil.place)),
      excess_(std::move(stencil.excess)) {
  for (int row = 0; row < system.rows(); ++row)
    if (place_[std::size_t(row)] < 0) lone_.push_back({std::size_t(row), float(1 / system.diagonal(row))});
  add_first_level(box, stencil);
}

template <int Dim>
void GeometricMultigrid<Dim>::add_first_level(const CellBox& box, StencilRows<Dim>& stencil) {
  int distributed = 0;
  for (std::int64_t cells = box.cells(); ranks_.size() > 1 && cells > settings_.gathered_cells; cells >>= Dim)
    ++distributed;
  const bool whole = distributed == 0;
  const std::vector<CellBox> homes = gather_blocks(stencil.rows.cells, ranks_);
  const std::vector<CellBox> blocks = whole ? std::vector{box} : aligned(homes, box, 1 << distributed);
  auto level = std::make_unique<TimeLevel>(blocks, periodic_, whole ? alone() : ranks_);
  if (ranks_.size() == 1) {
    level->face = std::move(stencil.face);
  } else {
    BlockPlan plan = all_take(homes, box), back{blocks, {}, {0, 0, 0}};
    for (std::size_t r = 0; r < homes.size() && !whole; ++r) plan.wanted[r] = {blocks[r]};
    for (const CellBox& home : homes) back.wanted.push_back({home});
    to_level_ = copies(plan, stencil.rows, level->rows, ranks_);
    to_home_ =
        whole ? own_part(homes, level->rows, stencil.rows, ranks_) : copies(back, level->rows, stencil.rows, ranks_);
    for (int a = 0; a < Dim; ++a) to_level_.run(stencil.face[a].data(), level->face[a].data());
    std::vector<float> excess(level->rows.size(), 0.0f);
    to_level_.run(excess_.data(), excess.data());
    excess_ = std::move(excess);
    home_b_.assign(stencil.rows.size(), 0.0f);
    home_x_.assign(stencil.rows.size(), 0.0f);
  }
  for (auto& field : level->face) level->fill_ghosts(field);
  level->finish(excess_);
  stages_.push_back({std::move(level), false, {}, {}});
  for (int n = 0; n < distributed; ++n) add_coarse_level();
  if (distributed > 0) add_whole_level();
  while (active_cells(*stages_.back().level) > settings_.coarsest_cells) add_coarse_level();
  coarsest_ = CoarsestSolve<Dim>(*stages_.back().level, excess_);
  excess_ = {};
}

template <int Dim>
void GeometricMultigrid<Dim>::add_coarse_level() {
  auto level = coarsen(*stages_.back().level, excess_);
  stages_.push_back({std::move(level), false, {}, {}});
}

template <int Dim>
void GeometricMultigrid<Dim>::add_whole_level() {
  Stage<Dim>& last = stages_.back();
  const TimeLevel& part = *last.level;
  CellBox box = part.blocks.front();
  for (const CellBox& b : part.blocks)
    for (int a = 0; a < 3 && b.cells() > 0; ++a) {
      if (box.cells() == 0) box = b;
      box.lower[a] = std::min(box.lower[a], b.lower[a]);
      box.upper[a] = std::max(box.upper[a], b.upper[a]);
    }
  auto level = std::make_unique<TimeLevel>(std::vector{box}, part.periodic, alone());
  last.gathers = true;
  last.gather = copies(all_take(part.blocks, box), part.rows, level->rows, ranks_);
  last.scatter = own_part(part.blocks, level->rows, part.rows, ranks_);
  for (int a = 0; a < Dim; ++a) last.gather.run(part.face[a].data(), level->face[a].data());
  std::vector<float> excess(level->rows.size(), 0.0f);
  last.gather.run(excess_.data(), excess.data());
  excess_ = std::move(excess);
  for (auto& field : level->face) level->fill_ghosts(field);
  level->finish(excess_);
  stages_.push_back({std::move(level), false, {}, {}});
}

template <int Dim>
void GeometricMultigrid<Dim>::cycle(std::size_t n) {
  TimeLevel& level = *stages_[n].level;
  if (n + 1 == stages_.size()) return coarsest_.apply(level);
  TimeLevel& next = *stages_[n + 1].level;
  if (stages_[n].gathers) {
    stages_[n].gather.run(level.b.data(), next.b.data());
    cycle(n + 1);
    return stages_[n].scatter.run(next.x.data(), level.x.data());
  }
  level.relax_from_zero(settings_.sweeps);
  level.restrict_residual(next);
  cycle(n + 1);
  level.add_correction(next);
  level.relax_back(settings_.sweeps);
}

template <int Dim>
void GeometricMultigrid<Dim>::apply(const Vector& r, Vector& z) {
  TimeLevel& first = *stages_.front().level;
  const bool shared = ranks_.size() > 1;
  std::vector<float>&b = shared ? home_b_ : first.b, &x = shared ? home_x_ : first.x;
  parallel_pieces(r.size(), entries_a_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      if (place_[row] >= 0) b[std::size_t(place_[row])] = float(r[row]);
  });
  if (shared) to_level_.run(b.data(), first.b.data());
  cycle(0);
  if (shared) to_home_.run(first.x.data(), x.data());
  parallel_pieces(r.size(), entries_a_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      if (place_[row] >= 0) z[row] = double(x[std::size_t(place_[row])]);
  });
  for (const LoneRow& lone : lone_) z[lone.row] = double(lone.inverse) * r[lone.row];
}

template <int Dim>
PreconditionerOrFailure make(const LinearSystem& system, const CellBox& box, const MultigridSettings& settings) {
  StencilRows<Dim> stencil;
  const std::string failure = assemble_stencil(system, box, stencil);
  if (!failure.empty()) return {nullptr, failure};
  return {std::make_unique<GeometricMultigrid<Dim>>(system, box, std::move(stencil), settings), {}};
}

}  // namespace

PreconditionerOrFailure make_geometric_multigrid(const LinearSystem& system, const MultigridSettings& settings) {
  const CellBox box = box_of_rows(system);
  if (box.cells() == 0) return {nullptr, "rows are not on a grid"};
  return system.grid().dimension == 2 ? make<2>(system, box, settings) : make<3>(system, box, settings);
}

}  // namespace seiche
