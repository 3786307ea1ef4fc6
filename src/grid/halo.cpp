#include "grid/halo.h"

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
}

template <int Dim>
template <class T>
void Halo<Dim>::exchange(std::initializer_list<T*> fields) const {
  const std::size_t n = fields.size();
  std::vector<std::vector<T>> incoming(peers_.size()), outgoing(peers_.size());
  std::vector<MPI_Request> requests;
  for (std::size_t p = 0; p < peers_.size(); ++p) {
    incoming[p].resize(n * peers_[p].receive.size());
    requests.emplace_back();
    MPI_Irecv(incoming[p].data(), int(incoming[p].size() * sizeof(T)), MPI_BYTE, peers_[p].rank, 0, ranks_.handle(),
              &requests.back());
  }
  for (std::size_t p = 0; p < peers_.size(); ++p) {
    outgoing[p].reserve(n * peers_[p].send.size());
    for (const T* f : fields)
      for (Site s : peers_[p].send) outgoing[p].push_back(f[s]);
    requests.emplace_back();
    MPI_Isend(outgoing[p].data(), int(outgoing[p].size() * sizeof(T)), MPI_BYTE, peers_[p].rank, 0, ranks_.handle(),
              &requests.back());
  }
  for (T* f : fields)
    for (std::size_t k = 0; k < copy_to_.size(); ++k) set_if_other(f[copy_to_[k]], f[copy_from_[k]]);
  MPI_Waitall(int(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  for (std::size_t p = 0; p < peers_.size(); ++p) {
    std::size_t k = 0;
    for (T* f : fields)
      for (Site s : peers_[p].receive) set_if_other(f[s], incoming[p][k++]);
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
