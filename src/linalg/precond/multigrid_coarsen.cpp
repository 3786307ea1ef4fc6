#include "linalg/precond/multigrid_coarsen.h"

#include <algorithm>

namespace seiche {
namespace {

using Cell = std::array<int, 3>;

// A link joins two cells if it is this share of the smaller diagonal.
constexpr float strong = 0.02f;

CellBox coarse_box(const CellBox& fine) {
  CellBox box;
  if (fine.cells() == 0) return {{0, 0, 0}, {0, 0, 0}};
  for (int a = 0; a < 3; ++a) {
    box.lower[a] = fine.lower[a] >> 1;
    box.upper[a] = (fine.upper[a] + 1) >> 1;
  }
  return box;
}

// The cells of `fine` within a coarse cell.
template <int Dim>
CellBox children_of(const Cell& coarse, const CellBox& fine) {
  CellBox box = fine;
  for (int a = 0; a < Dim; ++a) {
    box.lower[a] = std::max(box.lower[a], 2 * coarse[a]);
    box.upper[a] = std::min(box.upper[a], 2 * coarse[a] + 2);
  }
  return box;
}

// The parts of a coarse cell that links within it hold together.
template <int Dim>
class Parts {
 public:
  Parts(const MultigridLevel<Dim>& fine, const Cell& coarse) : fine_(fine) {
    for_each_cell(children_of<Dim>(coarse, fine.rows.cells), [&](const Cell& c) {
      unsigned child = 0;
      for (int a = 0; a < Dim; ++a) child |= unsigned(c[a] & 1) << a;
      place_[child] = fine.rows.at(c);
      if (fine.inverse[place_[child]] > 0) active_ |= 1u << child;
    });
  }

  // The part that has most to do with cells around.
  unsigned main() const {
    unsigned best = part_of_first(active_), left = active_ & ~best;
    float most = left ? outward(best) : 0;
    while (left) {
      const unsigned part = part_of_first(left);
      left &= ~part;
      if (const float weight = outward(part); weight > most) best = part, most = weight;
    }
    return best;
  }
  unsigned active() const { return active_; }
  std::size_t place(unsigned child) const { return place_[child]; }

  // The part of `among` that its first child belongs to.
  unsigned part_of_first(unsigned among) const {
    unsigned part = among & (~among + 1), before = 0;
    while (part != before) {
      before = part;
      for (unsigned child = 0; child < 1u << Dim; ++child)
        for (unsigned axis = 0; axis < Dim && (part >> child & 1u); ++axis) {
          const unsigned other = child ^ (1u << axis);
          if ((among >> other & 1u) && joined(child, axis)) part |= 1u << other;
        }
    }
    return part;
  }
  // visit(axis, step, cell across, c) for the links of a child that leave the coarse cell.
  template <class Visit>
  void for_outward(unsigned child, Visit visit) const {
    for (int axis = 0; axis < Dim; ++axis) {
      const int step = (child >> axis & 1u) ? 1 : -1;
      const std::size_t at = place_[child], across = fine_.rows.neighbour(at, int(child & 1u), axis, step);
      visit(axis, step, across, fine_.face[axis][step > 0 ? at : across]);
    }
  }

 private:
  bool joined(unsigned child, unsigned axis) const {
    const std::size_t low = place_[child & ~(1u << axis)], high = place_[child | (1u << axis)];
    return fine_.face[axis][low] * std::max(fine_.inverse[low], fine_.inverse[high]) >= strong;
  }
  // Sum over the cells of a part of the share of links that leave the coarse cell.
  float outward(unsigned part) const {
    float sum = 0;
    for (unsigned child = 0; child < 1u << Dim; ++child)
      if (part >> child & 1u)
        for_outward(child, [&](int, int, std::size_t, float c) { sum += c * fine_.inverse[place_[child]]; });
    return sum;
  }

  const MultigridLevel<Dim>& fine_;
  std::array<std::size_t, 1 << Dim> place_{};
  unsigned active_ = 0;
};

// 1 where a cell belongs to the coarse cell around it, else 0. Notes the coarse cells that have such cells.
template <int Dim>
std::vector<float> find_outsiders(const MultigridLevel<Dim>& fine, const SplitRows<Dim>& coarse,
                                  std::vector<Cell>& divided) {
  std::vector<float> belongs(fine.rows.size(), 1.0f);
  std::vector<std::vector<Cell>> of_row(std::size_t(coarse.own_rows()));
  for_own_rows(coarse, [&](std::size_t n, int J, int K) {
    for (int I = coarse.cells.lower[0]; I < coarse.cells.upper[0]; ++I) {
      const Parts<Dim> parts(fine, {I, J, K});
      const unsigned out = parts.active() & ~parts.main();
      for (unsigned child = 0; child < 1u << Dim; ++child)
        if (out >> child & 1u) belongs[parts.place(child)] = 0;
      if (out) of_row[n].push_back({I, J, K});
    }
  });
  for (const auto& row : of_row) divided.insert(divided.end(), row.begin(), row.end());
  return belongs;
}

// The neighbouring coarse cell that a part is linked to most strongly, on this rank and through cells that belong to
// it; 0 if there is none.
template <int Dim>
std::size_t find_host(const Parts<Dim>& parts, unsigned part, const Cell& around, const SplitRows<Dim>& coarse,
                      const std::vector<float>& belongs) {
  std::size_t host = 0;
  float most = 0;
  for (unsigned child = 0; child < 1u << Dim; ++child) {
    if (!(part >> child & 1u)) continue;
    parts.for_outward(child, [&](int axis, int step, std::size_t across, float c) {
      Cell next = around;
      next[axis] += step;
      const bool here = next[axis] >= coarse.cells.lower[axis] && next[axis] < coarse.cells.upper[axis];
      if (here && c * belongs[across] > most) host = coarse.at(next), most = c * belongs[across];
    });
  }
  return host;
}

// Parts beside the main one join a neighbouring coarse cell, with their e.
template <int Dim>
void place_outsiders(MultigridLevel<Dim>& fine, const SplitRows<Dim>& coarse, const std::vector<Cell>& divided,
                     const std::vector<float>& belongs, const std::vector<float>& excess,
                     std::vector<float>& coarse_e) {
  for (const Cell& around : divided) {
    const Parts<Dim> parts(fine, around);
    for (unsigned left = parts.active() & ~parts.main(), part = 0; left; left &= ~part) {
      part = parts.part_of_first(left);
      const std::size_t host = find_host(parts, part, around, coarse, belongs);
      for (unsigned child = 0; child < 1u << Dim; ++child) {
        if (!(part >> child & 1u)) continue;
        const bool red = ((child ^ child >> 1 ^ child >> 2) & 1u) == 0;
        if (red) fine.outsiders.push_back({parts.place(child), coarse.at(around), host, int(child & 1u)});
        if (host > 0) coarse_e[host] += excess[parts.place(child)];
      }
    }
  }
}

// c between a child and the one beside it in the same coarse cell.
template <int Dim>
float inner_link(const MultigridLevel<Dim>& fine, std::size_t cell, const Cell& at, int axis) {
  return fine.face[axis][at[axis] & 1 ? fine.rows.neighbour(cell, at[0], axis, -1) : cell];
}

// The surface that holds e lies where links are missing. Towards the outside of the coarse cell it is half a cell
// further from the middle than from the child, so in series with half a link: 1 / (1 / e + 1 / 2c). Between children
// the middle is the child's own. The mean over the missing links is taken.
template <int Dim>
float coarse_excess(const MultigridLevel<Dim>& fine, float e, std::size_t cell, const Cell& at) {
  if (e == 0) return 0;
  float sum = 0, most = 0;
  int missing = 0;
  for (int a = 0; a < Dim; ++a)
    for (const int step : {-1, 1}) {
      const float c = fine.face[a][step > 0 ? cell : fine.rows.neighbour(cell, at[0], a, -1)];
      most = std::max(most, c);
      if (c > 0) continue;
      const bool outward = (at[a] & 1) == (step > 0);
      const float inner = outward ? inner_link(fine, cell, at, a) : 0;
      sum += inner > 0 ? e / (1 + e / (2 * inner)) : e;
      ++missing;
    }
  return missing > 0 ? sum / float(missing) : e / (1 + e / (2 * most));
}

// c of a coarse face from one of its fine faces: the distance between the middles is that of the children and half a
// cell more on each side where a child has another one behind it.
template <int Dim>
float coarse_link(const MultigridLevel<Dim>& fine, const std::vector<float>& belongs, std::size_t cell, const Cell& at,
                  int axis) {
  const std::size_t beyond = fine.rows.neighbour(cell, at[0], axis, 1);
  const float link = belongs[cell] * belongs[beyond] * fine.face[axis][cell];
  const bool behind = (at[axis] & 1) && inner_link(fine, cell, at, axis) > 0, ahead = fine.face[axis][beyond] > 0;
  return link / (1 + 0.5f * float(behind) + 0.5f * float(ahead));
}

template <int Dim>
void fill_coefficients(const MultigridLevel<Dim>& fine, const std::vector<float>& belongs,
                       const std::vector<float>& excess, MultigridLevel<Dim>& coarse, std::vector<float>& coarse_e) {
  for_own_rows(coarse.rows, [&](std::size_t, int J, int K) {
    for (int I = coarse.rows.cells.lower[0]; I < coarse.rows.cells.upper[0]; ++I) {
      const std::size_t to = coarse.rows.at({I, J, K});
      for_each_cell(children_of<Dim>({I, J, K}, fine.rows.cells), [&](const Cell& c) {
        const std::size_t cell = fine.rows.at(c);
        coarse_e[to] += belongs[cell] * coarse_excess(fine, excess[cell], cell, c);
        for (int a = 0; a < Dim; ++a) {
          const bool wraps = fine.periodic[a] > 0 && c[a] + 1 == fine.periodic[a];
          if (!((c[a] & 1) || wraps) || (wraps && coarse.periodic[a] == 0)) continue;
          coarse.face[a][to] += coarse_link(fine, belongs, cell, c, a);
        }
      });
    }
  });
}

}  // namespace

template <int Dim>
std::unique_ptr<MultigridLevel<Dim>> coarsen(MultigridLevel<Dim>& fine, std::vector<float>& excess) {
  std::vector<CellBox> blocks;
  for (const CellBox& block : fine.blocks) blocks.push_back(coarse_box(block));
  std::array<int, 3> periodic{0, 0, 0};
  for (int a = 0; a < Dim; ++a)
    if (fine.periodic[a] > 2) periodic[a] = (fine.periodic[a] + 1) / 2;
  auto coarse = std::make_unique<MultigridLevel<Dim>>(std::move(blocks), periodic, fine.ranks);
  std::vector<Cell> divided;
  std::vector<float> belongs = find_outsiders(fine, coarse->rows, divided);
  fine.fill_ghosts(belongs);
  std::vector<float> coarse_e(coarse->rows.size(), 0.0f);
  place_outsiders(fine, coarse->rows, divided, belongs, excess, coarse_e);
  fill_coefficients(fine, belongs, excess, *coarse, coarse_e);
  for (auto& field : coarse->face) coarse->fill_ghosts(field);
  coarse->finish(coarse_e);
  excess = std::move(coarse_e);
  return coarse;
}

template std::unique_ptr<MultigridLevel<2>> coarsen(MultigridLevel<2>&, std::vector<float>&);
template std::unique_ptr<MultigridLevel<3>> coarsen(MultigridLevel<3>&, std::vector<float>&);

}  // namespace seiche
