// The level set behind inflow sides.
#include <cstring>
#include <set>

#include "fluid/boundary/inflow.h"
#include "fluid/boundary/inflow_places.h"
#include "grid/loops.h"

namespace seiche {
namespace {

using FaceNumbers = std::set<std::int64_t>;

// Number of the face of a side at a cell: brought around periodic sides, the outermost one beyond others.
template <int Dim>
std::int64_t number_of_face(const Geometry<Dim>& g, int axis, const IVec<Dim>& cell) {
  std::int64_t n = 0;
  for (int b = Dim - 1; b >= 0; --b) {
    if (b == axis) continue;
    const int length = g.cells[b], around = (cell[b] % length + length) % length;
    n = n * length + (g.periodic[b] ? around : std::clamp(cell[b], 0, length - 1));
  }
  return n;
}

// The union of all ranks' numbers. Collective.
FaceNumbers gather(const Communicator& ranks, const std::vector<std::int64_t>& mine) {
  const std::string sent(reinterpret_cast<const char*>(mine.data()), mine.size() * sizeof(std::int64_t));
  FaceNumbers all;
  for (const std::string& bytes : ranks.all_gather(sent)) {
    std::vector<std::int64_t> theirs(bytes.size() / sizeof(std::int64_t));
    if (!theirs.empty()) std::memcpy(theirs.data(), bytes.data(), bytes.size());
    all.insert(theirs.begin(), theirs.end());
  }
  return all;
}

// The streams that enter through a side at one time: faces that let liquid in, and the drift of the liquid beyond along
// the side as it comes nearer by one. A stream's rim is where dry faces begin; liquid beside it goes on into it. Walls
// around the side continue its outermost faces. Lengths are cells.
template <int Dim>
class Streams {
 public:
  Streams(const Layout<Dim>& layout, const DomainBoundary<Dim>& sides, int axis, int side, double t)
      : axis_(axis), reach_(layout.halo()), box_(layout.padded().grown(2 * layout.halo())) {
    if (layout.cells().empty()) box_ = layout.cells();
    box_.lower[axis] = 0, box_.upper[axis] = 1;
    const std::size_t size = std::size_t(box_.size());
    drift_.resize(size);
    dry_.resize(size);
    for (std::size_t n = 0; n < size; ++n) {
      Vec<Dim> x = layout.position(index(n), cell_offset<Dim>());
      x[axis] = side_position(layout, axis, side);
      drift_[n] = drift_at(sides, side, center_of_face(layout, axis, bring_inside(layout, axis, x)), t);
      any_ = any_ || drift_[n];
    }
  }

  // The owned faces where a rim may be: dry ones next to others; `cells` are those before the side.
  std::vector<std::int64_t> rims(const Layout<Dim>& layout, const Box<Dim>& cells, const CellField<Dim>& phi) const {
    std::vector<std::int64_t> mine;
    const auto is_dry = [&](Site s, const IVec<Dim>& i) { return phi[s] >= 0 && !feeds(i); };
    for_each_index_in_order(layout, any_ ? cells : Box<Dim>(), [&](Site s, const IVec<Dim>& i) {
      bool alone = is_dry(s, i);
      around(i, 1, [&](const IVec<Dim>& j) { alone = alone && is_dry(layout.site(j), j); });
      if (is_dry(s, i) && !alone) mine.push_back(number_of_face(layout.geometry(), axis_, i));
    });
    return mine;
  }
  void set_rims(const Geometry<Dim>& g, const FaceNumbers& rims) {
    for (std::size_t n = 0; n < dry_.size(); ++n) dry_[n] = rims.contains(number_of_face(g, axis_, index(n)));
  }

  bool any() const { return any_; }

  // Of a point `depth` behind the side, at cell i along it: distance to the stream where it lies outside, less than 0
  // where it lies within, by the distance to its rim. Empty where no stream is near.
  std::optional<double> distance(const IVec<Dim>& i, double depth) const {
    const auto near = nearest_drift(i, int(std::ceil(depth)));
    if (!near) return {};
    const Vec<Dim> x = i.template cast<double>();
    const auto ahead = nearest_drift(nearest(x + within_reach(depth * *near)), 1).value_or(*near);
    const Vec<Dim> there = x + within_reach(depth * ahead);
    const double slant = std::sqrt(1 + ahead.squaredNorm());
    return (feeds(nearest(there)) ? -distance_to_rim(there) : distance_along(there)) / slant;
  }

  // From a point on the side to the nearest face that lets liquid in; as far as the halo reaches.
  double distance_along(const Vec<Dim>& x) const {
    return least_gap(x, [&](const IVec<Dim>& j) { return feeds(j); });
  }

 private:
  using Drift = std::optional<Vec<Dim>>;

  Drift drift_at(const DomainBoundary<Dim>& sides, int side, const Vec<Dim>& x, double t) const {
    const double inward = sides.inward_speed(axis_, side, x, t);
    if (inward <= 0) return {};
    Vec<Dim> r;
    for (int b = 0; b < Dim; ++b) r[b] = b == axis_ ? 0 : sides.velocity(axis_, side, b, x, t) / inward;
    return r;
  }

  // Drift cut to two halos: the box holds three around owned cells, the third is the way to a rim.
  Vec<Dim> within_reach(const Vec<Dim>& drifted) const {
    const double most = 2 * reach_;
    return drifted.norm() > most ? Vec<Dim>(drifted * (most / drifted.norm())) : drifted;
  }
  IVec<Dim> nearest(const Vec<Dim>& x) const { return x.array().round().template cast<int>(); }
  IVec<Dim> index(std::size_t n) const {
    IVec<Dim> i = box_.lower;
    for (int b = 0; b < Dim; ++b) {
      const std::size_t length = std::size_t(box_.upper[b] - box_.lower[b]);
      i[b] += int(n % length);
      n /= length;
    }
    return i;
  }
  // Beyond the box that of the outermost faces.
  std::size_t number(const IVec<Dim>& i) const {
    std::size_t n = 0;
    for (int b = Dim - 1; b >= 0; --b) {
      const int k = b == axis_ ? 0 : std::clamp(i[b], box_.lower[b], box_.upper[b] - 1) - box_.lower[b];
      n = n * std::size_t(box_.upper[b] - box_.lower[b]) + std::size_t(k);
    }
    return n;
  }
  bool feeds(const IVec<Dim>& i) const { return drift_[number(i)].has_value(); }

  // body(face) for the faces within `reach` along the side.
  template <class Body>
  void around(const IVec<Dim>& i, int reach, const Body& body) const {
    const int width = 2 * reach + 1, count = Dim == 2 ? width : width * width;
    for (int n = 0; n < count; ++n) {
      IVec<Dim> at = i;
      for (int b = 1, left = n; b < Dim; ++b, left /= width) at[(axis_ + b) % Dim] += left % width - reach;
      body(at);
    }
  }
  Drift nearest_drift(const IVec<Dim>& i, int reach) const {
    if (const Drift own = drift_[number(i)]) return own;
    Drift best;
    double closest = std::numeric_limits<double>::infinity();
    around(i, reach, [&](const IVec<Dim>& j) {
      const double d = (j - i).template cast<double>().squaredNorm();
      if (const Drift r = drift_[number(j)]; r && d < closest) best = r, closest = d;
    });
    return best;
  }
  template <class Wanted>
  double least_gap(const Vec<Dim>& x, const Wanted& wanted) const {
    double least = reach_;
    around(nearest(x), reach_, [&](const IVec<Dim>& j) {
      if (!wanted(j)) return;
      Vec<Dim> gap = ((x - j.template cast<double>()).cwiseAbs().array() - 0.5).max(0.0);
      gap[axis_] = 0;
      least = std::min(least, gap.norm());
    });
    return least;
  }
  double distance_to_rim(const Vec<Dim>& x) const {
    return least_gap(x, [&](const IVec<Dim>& j) { return dry_[number(j)] != 0; });
  }

  int axis_, reach_;
  Box<Dim> box_;
  std::vector<Drift> drift_;
  std::vector<char> dry_;
  bool any_ = false;
};

// Level set at a point `depth` behind a side, at the distance d from the stream there, both m; `straight` is phi
// continued straight, `first` that of the first cell inside. Beside the rim of a stream into air that is the stream's
// own; elsewhere liquid that stands before the side goes on beyond.
double join_behind(double straight, double first, double d, double depth, double h) {
  if (d >= 0) return first > 0 && d < 2 * h ? d : std::min(straight, d);
  return std::max(std::min(straight, std::max(d, -depth)), d);
}

// Cells up to `reach` layers on both sides of a domain side, in `within`.
template <int Dim>
Box<Dim> side_layers(const Layout<Dim>& layout, int axis, int side, int reach, Box<Dim> within) {
  const int edge = side == 0 ? 0 : layout.geometry().cells[axis];
  within.lower[axis] = std::max(within.lower[axis], edge - reach);
  within.upper[axis] = std::min(within.upper[axis], edge + reach);
  return within;
}

// Joins the streams of one side. Before it phi is at most the distance to the faces that let liquid in.
template <int Dim>
void join_streams(const Layout<Dim>& layout, const Streams<Dim>& streams, int axis, int side, CellField<Dim>& phi) {
  const int reach = layout.halo(), edge = side == 0 ? 0 : layout.geometry().cells[axis] - 1;
  const double h = layout.h();
  const CellField<Dim> before = phi;
  const Site inward = (side == 0 ? 1 : -1) * layout.stride(axis);
  for_each_index(layout, side_layers(layout, axis, side, reach, layout.padded()), [&](Site s, const IVec<Dim>& i) {
    const int k = (side == 0 ? 1 : -1) * (i[axis] - edge);  // cells from the first inside
    IVec<Dim> along = i;
    along[axis] = 0;
    if (k >= 0) {
      const double beside = streams.distance_along(along.template cast<double>());
      if (beside < reach) phi[s] = std::min(phi[s], std::hypot(k + 0.5, beside) * h);
    } else if (const auto d = streams.distance(along, -k - 0.5)) {
      phi[s] = join_behind(phi[s], before[s - k * inward], *d * h, (-k - 0.5) * h, h);
    }
  });
}

}  // namespace

// Ghosts take what the ranks found that own the cells: only these know all that a stream's distance hangs on.
template <int Dim>
void join_inflow(const Layout<Dim>& layout, const Halo<Dim>& halo, const Communicator& ranks,
                 const DomainBoundary<Dim>& sides, double t, CellField<Dim>& phi) {
  for (int a = 0; a < Dim; ++a)
    for (int side = 0; side < 2; ++side) {
      if (sides.type(a, side) != SideType::inflow) continue;
      Streams<Dim> streams(layout, sides, a, side, t);
      Box<Dim> first = side_layers(layout, a, side, 1, layout.cells());
      streams.set_rims(layout.geometry(), gather(ranks, streams.rims(layout, first, phi)));
      if (streams.any()) join_streams(layout, streams, a, side, phi);
    }
  halo.fill_ghosts(phi);
}

template void join_inflow<2>(const Layout<2>&, const Halo<2>&, const Communicator&, const DomainBoundary<2>&, double,
                             CellField<2>&);
template void join_inflow<3>(const Layout<3>&, const Halo<3>&, const Communicator&, const DomainBoundary<3>&, double,
                             CellField<3>&);

}  // namespace seiche
