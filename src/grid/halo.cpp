#include "grid/halo.h"

#include <algorithm>
#include <memory>

#include "grid/field_values.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Shifts by whole periods that can bring a block of the grid into the halo of another block, in a fixed order.
template <int Dim>
std::vector<IVec<Dim>> period_shifts(const Geometry<Dim>& g, int halo) {
  std::vector<IVec<Dim>> shifts{IVec<Dim>::Zero()};
  for (int a = 0; a < Dim; ++a) {
    if (!g.periodic[a]) continue;
    const int images = (halo + g.cells[a] - 1) / g.cells[a];
    std::vector<IVec<Dim>> more;
    for (const IVec<Dim>& s : shifts)
      for (int k = -images; k <= images; ++k) {
        IVec<Dim> moved = s;
        moved[a] += k * g.cells[a];
        more.push_back(moved);
      }
    shifts = more;
  }
  return shifts;
}

template <int Dim>
void append_sites(const Layout<Dim>& layout, const Box<Dim>& box, std::vector<Site>& list) {
  for_each_index_in_order(layout, box, [&](Site s, const IVec<Dim>&) { list.push_back(s); });
}

// Items in a buffer that is not filled first.
template <class T>
struct Items {
  std::unique_ptr<T[]> first;
  std::size_t count = 0;

  Items() = default;
  explicit Items(std::size_t n) : first(std::make_unique_for_overwrite<T[]>(n)), count(n) {}
  int bytes() const { return int(count * sizeof(T)); }
  T* begin() const { return first.get(); }
  T* end() const { return first.get() + count; }
};

// Sends out[p] to peer p and takes what it sends into in[p], as much as fits. Sets the counts in `in`.
template <class T, class Peers>
void exchange_items(const Communicator& ranks, const Peers& peers, const std::vector<Items<T>>& out,
                    std::vector<Items<T>>& in) {
  const std::size_t n = peers.size();
  std::vector<MPI_Request> requests(2 * n);
  for (std::size_t p = 0; p < n; ++p)
    MPI_Irecv(in[p].begin(), in[p].bytes(), MPI_BYTE, peers[p].rank, 0, ranks.handle(), &requests[p]);
  for (std::size_t p = 0; p < n; ++p)
    MPI_Isend(out[p].begin(), out[p].bytes(), MPI_BYTE, peers[p].rank, 0, ranks.handle(), &requests[n + p]);
  std::vector<MPI_Status> statuses(2 * n);
  MPI_Waitall(int(2 * n), requests.data(), statuses.data());
  for (std::size_t p = 0; p < n; ++p) {
    int bytes = 0;
    MPI_Get_count(&statuses[p], MPI_BYTE, &bytes);
    in[p].count = std::size_t(bytes) / sizeof(T);
  }
}

template <class T>
Items<T> copy_of(const std::vector<T>& items) {
  Items<T> copy(items.size());
  std::copy(items.begin(), items.end(), copy.begin());
  return copy;
}

}  // namespace

template <int Dim>
Halo<Dim>::Halo(const Layout<Dim>& layout, const std::vector<Box<Dim>>& boxes, const Communicator& ranks)
    : ranks_(ranks) {
  const auto shifts = period_shifts<Dim>(layout.geometry(), layout.halo());
  for (int r = 0; r < int(boxes.size()); ++r) {
    if (boxes[r].empty() || layout.cells().empty()) continue;
    const Layout<Dim> other(layout.geometry(), boxes[r], layout.halo());
    Peer peer{r, {}, {}};
    for (const IVec<Dim>& shift : shifts) {
      if (r == ranks.rank() && (shift.array() == 0).all()) continue;
      const Box<Dim> incoming = other.authority().shifted(shift).cut(layout.padded());
      const Box<Dim> outgoing = layout.authority().shifted(shift).cut(other.padded()).shifted(-shift);
      if (!incoming.empty()) append_sites(layout, incoming, peer.receive);
      if (!outgoing.empty()) append_sites(layout, outgoing, peer.send);
    }
    if (r == ranks.rank()) {
      copy_from_ = peer.send;
      copy_to_ = peer.receive;
    } else if (!peer.send.empty() || !peer.receive.empty()) {
      peers_.push_back(std::move(peer));
    }
  }
  list_outgoing();
}

template <int Dim>
void Halo<Dim>::list_outgoing() {
  for (std::size_t p = 0; p < peers_.size(); ++p)
    for (std::size_t k = 0; k < peers_[p].send.size(); ++k) outgoing_.push_back({peers_[p].send[k], int(p), Site(k)});
  for (std::size_t k = 0; k < copy_from_.size(); ++k) outgoing_.push_back({copy_from_[k], -1, copy_to_[k]});
  std::stable_sort(outgoing_.begin(), outgoing_.end(), [](const auto& a, const auto& b) { return a.site < b.site; });
  if (!outgoing_.empty()) is_sent_.resize(std::size_t(outgoing_.back().site) + 1);
  for (const Outgoing& o : outgoing_) is_sent_[std::size_t(o.site)] = true;
}

// Messages hold pairs of a place in the full message and the value there.
template <int Dim>
void Halo<Dim>::fill_changed(const std::vector<Site>& changed, char value, double* f, char* mark) const {
  struct Pair {
    Site place;
    double value;
  };
  std::vector<std::vector<Pair>> pairs(peers_.size());
  for (const Site s : changed) {
    if (std::size_t(s) >= is_sent_.size() || !is_sent_[std::size_t(s)]) continue;
    const auto below = [](const Outgoing& o, Site site) { return o.site < site; };
    for (auto to = std::lower_bound(outgoing_.begin(), outgoing_.end(), s, below);
         to != outgoing_.end() && to->site == s; ++to) {
      if (to->peer >= 0)
        pairs[std::size_t(to->peer)].push_back({to->place, f[s]});
      else
        f[to->place] = f[s], mark[to->place] = value;
    }
  }
  std::vector<Items<Pair>> out, in;
  for (std::size_t p = 0; p < peers_.size(); ++p) {
    out.push_back(copy_of(pairs[p]));
    in.emplace_back(peers_[p].receive.size());
  }
  exchange_items(ranks_, peers_, out, in);
  for (std::size_t p = 0; p < peers_.size(); ++p)
    for (const Pair& pair : in[p]) {
      const Site s = peers_[p].receive[std::size_t(pair.place)];
      f[s] = pair.value, mark[s] = value;
    }
}

// Each rank tells its peers which places of the full message it wants.
template <int Dim>
Halo<Dim> Halo<Dim>::part(const std::vector<Site>& wanted) const {
  const auto wants = [&](Site s) { return std::binary_search(wanted.begin(), wanted.end(), s); };
  std::vector<Items<int>> places, asked;
  for (const Peer& peer : peers_) {
    std::vector<int> mine;
    for (std::size_t k = 0; k < peer.receive.size(); ++k)
      if (wants(peer.receive[k])) mine.push_back(int(k));
    places.push_back(copy_of(mine));
    asked.emplace_back(peer.send.size());
  }
  exchange_items(ranks_, peers_, places, asked);
  Halo part(ranks_);
  for (std::size_t p = 0; p < peers_.size(); ++p) {
    Peer peer{peers_[p].rank, {}, {}};
    for (const int k : places[p]) peer.receive.push_back(peers_[p].receive[std::size_t(k)]);
    for (const int k : asked[p]) peer.send.push_back(peers_[p].send[std::size_t(k)]);
    if (!peer.send.empty() || !peer.receive.empty()) part.peers_.push_back(std::move(peer));
  }
  for (std::size_t k = 0; k < copy_to_.size(); ++k)
    if (wants(copy_to_[k])) part.copy_from_.push_back(copy_from_[k]), part.copy_to_.push_back(copy_to_[k]);
  return part;
}

template <int Dim>
template <class T>
void Halo<Dim>::exchange(std::initializer_list<T*> fields) const {
  std::vector<Items<T>> out, in;
  for (const Peer& peer : peers_) {
    in.emplace_back(fields.size() * peer.receive.size());
    T* next = out.emplace_back(fields.size() * peer.send.size()).begin();
    for (const T* f : fields)
      for (const Site s : peer.send) *next++ = f[s];
  }
  for (T* f : fields)
    for (std::size_t k = 0; k < copy_to_.size(); ++k) set_if_other(f[copy_to_[k]], f[copy_from_[k]]);
  exchange_items(ranks_, peers_, out, in);
  for (std::size_t p = 0; p < peers_.size(); ++p) {
    const T* next = in[p].begin();
    for (T* f : fields)
      for (const Site s : peers_[p].receive) set_if_other(f[s], *next++);
  }
}

template class Halo<2>;
template class Halo<3>;
template void Halo<2>::exchange(std::initializer_list<double*>) const;
template void Halo<3>::exchange(std::initializer_list<double*>) const;
template void Halo<2>::exchange(std::initializer_list<std::int64_t*>) const;
template void Halo<3>::exchange(std::initializer_list<std::int64_t*>) const;
template void Halo<2>::exchange(std::initializer_list<char*>) const;
template void Halo<3>::exchange(std::initializer_list<char*>) const;

}  // namespace seiche
