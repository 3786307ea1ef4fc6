#include "linalg/precond/multigrid_level.h"

#include <algorithm>

namespace seiche {
namespace {

constexpr int chunk = 256;  // entries of a half row at a time, on the stack

bool is_red(const std::array<int, 3>& c) {
  return ((c[0] + c[1] + c[2]) & 1) == 0;
}

}  // namespace

// Cells of one color in a row, with their neighbours, all of the other color.
template <int Dim>
struct MultigridLevel<Dim>::HalfRow {
  static constexpr int others = 2 * Dim;
  float* x;
  const float *b, *inverse;
  const float *neighbour[others], *face[others];
  Span span;

  // b + sum of c_f x_j
  float gathered(int m) const {
    float sum = b[m];
    for (int n = 0; n < others; ++n) sum += face[n][m] * neighbour[n][m];
    return sum;
  }
  // b + c sum of x_j
  float gathered_evenly(int m) const {
    float sum = neighbour[0][m];
    for (int n = 1; n < others; ++n) sum += neighbour[n][m];
    return b[m] + span.c * sum;
  }
  // x_i = (b_i + sum of c_f x_j) / a_ii
  void relax() const {
    relax_unevenly(span.begin, span.even_begin);
    const float even_inverse = 1 / (float(others) * span.c);
#pragma GCC ivdep
    for (int m = span.even_begin; m < span.even_end; ++m) x[m] = even_inverse * gathered_evenly(m);
    relax_unevenly(span.even_end, span.end);
  }
  // to[m - first] += b - A x from entry `first` on; 0 without an equation.
  void add_residual(int first, int count, float* to) const {
    const auto cut = [=](int m) { return std::clamp(m, first, first + count); };
    add_uneven_residual(cut(span.begin), cut(span.even_begin), to - first);
    const float diagonal = float(others) * span.c;
    const int end = cut(span.even_end);
#pragma GCC ivdep
    for (int m = cut(span.even_begin); m < end; ++m) to[m - first] += gathered_evenly(m) - diagonal * x[m];
    add_uneven_residual(cut(span.even_end), cut(span.end), to - first);
  }

 private:
  void relax_unevenly(int begin, int end) const {
#pragma GCC ivdep
    for (int m = begin; m < end; ++m) x[m] = inverse[m] * gathered(m);
  }
  void add_uneven_residual(int begin, int end, float* to) const {
    constexpr float tiny = 1e-36f;
#pragma GCC ivdep
    for (int m = begin; m < end; ++m) to[m] += (inverse[m] * gathered(m) - x[m]) / (inverse[m] + tiny);
  }
};

template <int Dim>
MultigridLevel<Dim>::MultigridLevel(std::vector<CellBox> all_blocks, const std::array<int, 3>& periods,
                                    const Communicator& sharing)
    : rows(all_blocks[std::size_t(sharing.rank())]), blocks(std::move(all_blocks)), ranks(sharing), periodic(periods) {
  for (std::vector<float>* field : {&x, &b, &inverse}) field->assign(rows.size(), 0.0f);
  for (auto& field : face) field.assign(rows.size(), 0.0f);
  const BlockPlan plan = ghost_layers(blocks, periodic, Dim);
  const auto at = [this](const std::array<int, 3>& c) { return rows.at(c); };
  all_ = BlockExchange(
      plan, at, at, [](const auto&) { return true; }, ranks);
  red_ = BlockExchange(plan, at, at, is_red, ranks);
  black_ = BlockExchange(
      plan, at, at, [](const auto& c) { return !is_red(c); }, ranks);
}

template <int Dim>
void MultigridLevel<Dim>::fill_ghosts(std::vector<float>& field) {
  all_.run(field.data(), field.data());
}

template <int Dim>
void MultigridLevel<Dim>::finish(const std::vector<float>& excess) {
  span_.assign(std::size_t(rows.own_rows()), {});
  for_own_rows(rows, [&](std::size_t n, int j, int k) {
    Span& span = span_[n];
    for (int i = rows.cells.lower[0]; i < rows.cells.upper[0]; ++i) {
      const std::size_t cell = rows.at({i, j, k});
      float diagonal = excess[cell];
      for (int a = 0; a < Dim; ++a) diagonal += face[a][cell] + face[a][rows.neighbour(cell, i, a, -1)];
      if (!(diagonal > 0)) continue;
      inverse[cell] = 1 / diagonal;
      const int m = (i - rows.base) >> 1;
      if (span.end == 0) span.begin = m;
      span.end = m + 1;
    }
    find_even_part(span, j, k);
  });
}

// c if all faces of a cell have it and e is 0, else 0.
template <int Dim>
float MultigridLevel<Dim>::even_coefficient(std::size_t cell, int i) const {
  const float c = face[0][cell];
  bool even = c > 0 && inverse[cell] == 1 / (2 * Dim * c);
  for (int a = 0; a < Dim; ++a) even = even && face[a][cell] == c && face[a][rows.neighbour(cell, i, a, -1)] == c;
  return even ? c : 0;
}

// The longest run of pairs of cells with one coefficient.
template <int Dim>
void MultigridLevel<Dim>::find_even_part(Span& span, int j, int k) const {
  span.even_begin = span.even_end = span.begin;
  int begin = span.begin;
  float c = 0;
  for (int m = span.begin; m < span.end; ++m) {
    const int i = rows.base + 2 * m;
    const std::size_t cell = rows.row_begin(j, k) + std::size_t(m);
    const float low = even_coefficient(cell, i),
                high = low > 0 ? even_coefficient(cell + std::size_t(rows.half), i + 1) : 0;
    const float both = low == high ? low : 0;
    if (both != c) begin = m, c = both;
    if (c == 0 || m + 1 - begin <= span.even_end - span.even_begin) continue;
    span.even_begin = begin, span.even_end = m + 1, span.c = c;
  }
}

template <int Dim>
typename MultigridLevel<Dim>::HalfRow MultigridLevel<Dim>::half_row(std::size_t row, int j, int k, Color color) const {
  const int odd = (j + k + (color == Color::red ? 0 : 1)) & 1;
  const std::size_t begin = rows.row_begin(j, k);
  const std::size_t own = begin + std::size_t(odd) * rows.half, other = begin + std::size_t(1 - odd) * rows.half;
  HalfRow h;
  h.x = const_cast<float*>(x.data()) + own;
  h.b = b.data() + own;
  h.inverse = inverse.data() + own;
  h.span = span_[row];
  // The other cell of the first and of the last pair may be a ghost.
  h.span.begin = std::max(h.span.begin, (rows.cells.lower[0] - rows.base - odd + 1) >> 1);
  h.span.end = std::min(h.span.end, (rows.cells.upper[0] - rows.base - odd + 1) >> 1);
  h.span.even_begin = std::max(h.span.even_begin, h.span.begin);
  h.span.even_end = std::max(h.span.even_end, h.span.even_begin);
  const float *before = x.data() + other + odd - 1, *after = x.data() + other + odd;
  h.neighbour[0] = before, h.face[0] = face[0].data() + other + odd - 1;
  h.neighbour[1] = after, h.face[1] = face[0].data() + own;
  for (int a = 1; a < Dim; ++a) {
    h.neighbour[2 * a] = x.data() + own - rows.stride(a), h.face[2 * a] = face[a].data() + own - rows.stride(a);
    h.neighbour[2 * a + 1] = x.data() + own + rows.stride(a), h.face[2 * a + 1] = face[a].data() + own;
  }
  return h;
}

template <int Dim>
void MultigridLevel<Dim>::relax(Color color) {
  for_own_rows(rows, [&](std::size_t row, int j, int k) { half_row(row, j, k, color).relax(); });
  (color == Color::red ? red_ : black_).run(x.data(), x.data());
}

template <int Dim>
void MultigridLevel<Dim>::scale_red() {
  for_own_rows(rows, [&](std::size_t row, int j, int k) {
    const HalfRow h = half_row(row, j, k, Color::red);
#pragma GCC ivdep
    for (int m = h.span.begin; m < h.span.end; ++m) h.x[m] = h.inverse[m] * h.b[m];
  });
  red_.run(x.data(), x.data());
}

template <int Dim>
void MultigridLevel<Dim>::relax_from_zero(int sweeps) {
  // Across an odd period cells of one color meet: black ones then see what is left of black ghosts.
  const bool odd = std::any_of(periodic.begin(), periodic.end(), [](int n) { return n & 1; });
  if (odd) std::fill(x.begin(), x.end(), 0.0f);
  for (int s = 0; s < sweeps; ++s) {
    s == 0 ? scale_red() : relax(Color::red);
    relax(Color::black);
  }
}

template <int Dim>
void MultigridLevel<Dim>::relax_back(int sweeps) {
  for (int s = 0; s < sweeps; ++s) {
    relax(Color::black);
    relax(Color::red);
  }
}

template <int Dim>
float MultigridLevel<Dim>::residual(const Outsider& o) const {
  float sum = b[o.cell];
  for (int a = 0; a < Dim; ++a) {
    const std::size_t low = rows.neighbour(o.cell, o.odd, a, -1), high = rows.neighbour(o.cell, o.odd, a, 1);
    sum += face[a][low] * x[low] + face[a][o.cell] * x[high];
  }
  return sum - x[o.cell] / inverse[o.cell];
}

// Visits the fine rows within a coarse row: visit(number among own rows, j, k).
template <int Dim, class Visit>
static void for_fine_rows(const SplitRows<Dim>& fine, int J, int K, const Visit& visit) {
  const CellBox& c = fine.cells;
  for (int k = Dim == 3 ? std::max(2 * K, c.lower[2]) : 0; k < (Dim == 3 ? std::min(2 * K + 2, c.upper[2]) : 1); ++k)
    for (int j = std::max(2 * J, c.lower[1]); j < std::min(2 * J + 2, c.upper[1]); ++j)
      visit(std::size_t(j - c.lower[1] + fine.extent(1) * (k - c.lower[2])), j, k);
}

// Entry m of a fine half row lies in coarse cell m + fine.base / 2, whose entry is at m + shift of the row of all
// cells.
template <int Dim>
void MultigridLevel<Dim>::restrict_residual(MultigridLevel& coarse) const {
  const int shift = rows.base / 2 - coarse.rows.base;
  for_own_rows(coarse.rows, [&](std::size_t, int J, int K) {
    Span all{rows.half, 0};
    for_fine_rows(rows, J, K, [&](std::size_t row, int, int) {
      if (span_[row].end == 0) return;
      all = {std::min(all.begin, span_[row].begin), std::max(all.end, span_[row].end)};
    });
    float* even = coarse.b.data() + coarse.rows.row_begin(J, K);
    float* odd = even + coarse.rows.half;
    all.begin -= (all.begin + shift) & 1;  // an even coarse cell
    for (int first = all.begin; first < all.end; first += chunk) {
      float sum[chunk] = {};
      for_fine_rows(rows, J, K, [&](std::size_t row, int j, int k) {
        half_row(row, j, k, Color::red).add_residual(first, chunk, sum);
      });
      const int count = (std::min(first + chunk, all.end) - first + 1) / 2, to = (first + shift) / 2;
      for (int n = 0; n < count; ++n) {
        even[to + n] = sum[2 * n];
        odd[to + n] = sum[2 * n + 1];
      }
    }
  });
  for (const Outsider& o : outsiders) {
    const float r = residual(o);
    coarse.b[o.around] -= r;
    if (o.host > 0) coarse.b[o.host] += r;
  }
}

template <int Dim>
void MultigridLevel<Dim>::add_correction(const MultigridLevel& coarse) {
  const int shift = rows.base / 2 - coarse.rows.base;
  for_own_rows(coarse.rows, [&](std::size_t, int J, int K) {
    const float* even = coarse.x.data() + coarse.rows.row_begin(J, K);
    const float* odd = even + coarse.rows.half;
    for_fine_rows(rows, J, K, [&](std::size_t row, int j, int k) {
      const HalfRow h = half_row(row, j, k, Color::red);
      for (int m = h.span.begin; m < h.span.end; ++m) {
        const int at = m + shift;
        h.x[m] += at & 1 ? odd[at >> 1] : even[at >> 1];
      }
    });
  });
  for (const Outsider& o : outsiders) x[o.cell] += (o.host > 0 ? coarse.x[o.host] : 0) - coarse.x[o.around];
  red_.run(x.data(), x.data());
}

template class MultigridLevel<2>;
template class MultigridLevel<3>;

}  // namespace seiche
