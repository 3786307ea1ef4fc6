#include "linalg/precond/near_null_space.h"

#include <algorithm>

namespace seiche {
namespace {

constexpr std::size_t most_regions = 16;
constexpr int most_slabs = 12;

struct Extent {
  std::array<double, 3> low{}, high{};
  int longest = 0;
  double length(int axis) const { return high[std::size_t(axis)] - low[std::size_t(axis)]; }
};

Extent measure(const ViscousRegion& region, const FacePlaces& places, int dimension, const Communicator& ranks) {
  Extent e;
  for (int a = 0; a < dimension; ++a) {
    double low = INFINITY, high = -INFINITY;
    for (const int i : region.row) {
      const double x = places.position[std::size_t(i)][std::size_t(a)];
      low = std::min(low, x), high = std::max(high, x);
    }
    e.low[std::size_t(a)] = ranks.global_min(low), e.high[std::size_t(a)] = ranks.global_max(high);
    if (e.length(a) > e.length(e.longest)) e.longest = a;
  }
  return e;
}

// Slabs about as long as the region is wide: at 0.7, 1.4 and 2.8 times a thread takes 16, 16 and 18 iterations of
// conjugate gradients, and 34 without (docs/decisions/0017-viscous-speed.md). None where that leaves fewer than two.
int count_slabs(const ViscousRegion& region, const Extent& extent, int dimension) {
  const double length = extent.length(extent.longest) + 1, cells = double(region.size) / dimension;
  const double width = std::pow(cells / length, 1.0 / (dimension - 1));
  const int slabs = int(std::min<double>(most_slabs, length / width));
  return slabs < 2 ? 0 : slabs;
}

// Along the longest axis: 1 at node `slab` of `slabs` + 1, 0 at the others.
struct Hats {
  const Extent& extent;
  int slabs;
  double spacing() const { return extent.length(extent.longest) / slabs; }
  double operator()(int slab, const std::array<double, 3>& x) const {
    if (slabs == 0) return 1;
    const auto a = std::size_t(extent.longest);
    return std::max(0.0, 1 - std::abs((x[a] - extent.low[a]) / spacing() - slab));
  }
  // About which to turn, and what makes that as large as a translation.
  std::array<double, 3> centre(int slab) const {
    std::array<double, 3> c{};
    for (std::size_t a = 0; a < 3; ++a) c[a] = 0.5 * (extent.low[a] + extent.high[a]);
    const auto a = std::size_t(extent.longest);
    if (slabs > 0) c[a] = extent.low[a] + slab * spacing();
    return c;
  }
  double reach() const { return std::max(1.0, slabs > 0 ? spacing() : 0.5 * extent.length(extent.longest)); }
};

std::vector<SparseVector> weighted_motions(const ViscousRegion& region, const FacePlaces& places, int dimension,
                                           const Hats& hats, int slab) {
  std::vector<SparseVector> motions(dimension == 2 ? 3 : 6);
  const auto set = [&](int motion, int row, double value) {
    motions[std::size_t(motion)].row.push_back(row), motions[std::size_t(motion)].value.push_back(value);
  };
  const std::array<double, 3> centre = hats.centre(slab);
  for (const int i : region.row) {
    const std::array<double, 3>& x = places.position[std::size_t(i)];
    const double weight = hats(slab, x);
    if (weight == 0) continue;
    const int a = places.axis[std::size_t(i)], b = (a + 1) % 3, c = (a + 2) % 3;
    const auto arm = [&](int k) { return weight * (x[std::size_t(k)] - centre[std::size_t(k)]) / hats.reach(); };
    set(a, i, weight);
    if (dimension == 2) {
      set(2, i, a == 0 ? -arm(1) : arm(0));
    } else {
      set(3 + b, i, arm(c));
      set(3 + c, i, -arm(b));
    }
  }
  return motions;
}

// z'F z / z'D z, D the diagonal of F.
double stiffness(const LinearSystem& F, const SparseVector& z, SparseProduct& multiply) {
  const SparseVector Fz = multiply(z);
  std::array<double, 2> sums{0, 0};
  for (std::size_t n = 0, m = 0; n < z.row.size(); ++n) {
    while (m < Fz.row.size() && Fz.row[m] < z.row[n]) ++m;
    if (m < Fz.row.size() && Fz.row[m] == z.row[n]) sums[0] += z.value[n] * Fz.value[m];
    sums[1] += F.diagonal(z.row[n]) * z.value[n] * z.value[n];
  }
  F.ranks().global_sum(sums);
  return sums[1] > 0 ? sums[0] / sums[1] : 1;
}

}  // namespace

// Of what F resists more multigrid takes care: of motions of the whole, and of slabs that bend against each other.
std::vector<NearNullVector> find_near_null_space(const LinearSystem& F, const FacePlaces& places, int dimension) {
  constexpr double soft = 1e-3, soft_slab = 0.1;
  SparseProduct multiply(F);
  std::vector<NearNullVector> motions;
  int number = 0;
  for (const ViscousRegion& region : find_viscous_regions(F, dimension * (dimension + 1), most_regions)) {
    const Extent extent = measure(region, places, dimension, F.ranks());
    const Hats hats{extent, count_slabs(region, extent, dimension)};
    for (int slab = 0; slab <= hats.slabs; ++slab)
      for (SparseVector& z : weighted_motions(region, places, dimension, hats, slab)) {
        const double q = stiffness(F, z, multiply);
        if (q > 0 && q <= (hats.slabs > 0 ? soft_slab : soft))
          motions.push_back({std::move(z), number, slab, hats.slabs == 0});
      }
    ++number;
  }
  return motions;
}

SparseProduct::SparseProduct(const LinearSystem& F)
    : F_(F), x_(std::size_t(F.rows() + F.halo().ghosts())), reached_(std::size_t(F.rows())) {
  const DistributedMatrix& P = F.pattern();
  for (int i = 0; i < F.rows(); ++i) {
    const auto begin = P.column.begin() + P.row_start[i], end = P.column.begin() + P.row_start[i + 1];
    const auto foreign = [&](Row c) { return c < P.first_row || c >= P.first_row + F.rows(); };
    if (std::any_of(begin, end, foreign)) border_.push_back(i);
  }
}

SparseVector SparseProduct::operator()(const SparseVector& x) {
  const DistributedMatrix& P = F_.pattern();
  const auto local = [&](int k) { return F_.halo().local_index(P.column[std::size_t(k)]); };
  add_scaled(x_, 1, x);
  F_.halo().fill_ghosts(x_);
  std::vector<int> rows = border_;
  for (const int i : border_) reached_[std::size_t(i)] = 1;
  for (const int i : x.row)
    for (int k = P.row_start[i]; k < P.row_start[i + 1]; ++k)
      if (const int j = local(k); j < F_.rows() && !reached_[std::size_t(j)])
        reached_[std::size_t(j)] = 1, rows.push_back(j);
  std::sort(rows.begin(), rows.end());
  SparseVector y;
  for (const int i : rows) {
    double sum = 0;
    for (int k = P.row_start[i]; k < P.row_start[i + 1]; ++k)
      sum += F_.values()[std::size_t(k)] * x_[std::size_t(local(k))];
    if (sum != 0) y.row.push_back(i), y.value.push_back(sum);
    reached_[std::size_t(i)] = 0;
  }
  for (const int i : x.row) x_[std::size_t(i)] = 0;
  return y;
}

}  // namespace seiche
