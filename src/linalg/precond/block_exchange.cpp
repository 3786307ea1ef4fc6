#include "linalg/precond/block_exchange.h"

#include <algorithm>
#include <cstring>

#include "linalg/precond/split_rows.h"

namespace seiche {
namespace {

using Cell = std::array<int, 3>;

Cell sum(Cell a, const Cell& b, int sign) {
  for (int d = 0; d < 3; ++d) a[d] += sign * b[d];
  return a;
}

// The part of `wanted` that images of `owned`, moved by `shift`, cover.
CellBox covered(const CellBox& wanted, const CellBox& owned, const Cell& shift) {
  CellBox part = wanted;
  for (int a = 0; a < 3; ++a) {
    part.lower[a] = std::max(part.lower[a], owned.lower[a] + shift[a]);
    part.upper[a] = std::min(part.upper[a], owned.upper[a] + shift[a]);
  }
  return part;
}

std::vector<Cell> period_shifts(const Cell& periodic) {
  std::vector<Cell> shifts{{0, 0, 0}};
  for (int a = 0; a < 3; ++a) {
    const std::size_t before = shifts.size();
    for (std::size_t n = 0; n < before && periodic[a] > 0; ++n)
      for (const int sign : {-1, 1}) {
        shifts.push_back(shifts[n]);
        shifts.back()[a] += sign * periodic[a];
      }
  }
  return shifts;
}

constexpr int tag = 7103;

}  // namespace

Communicator alone() {
  return Communicator(MPI_COMM_SELF);
}

std::vector<CellBox> gather_blocks(const CellBox& mine, const Communicator& ranks) {
  std::vector<CellBox> blocks;
  for (const std::string& bytes : ranks.all_gather(std::string(reinterpret_cast<const char*>(&mine), sizeof(mine)))) {
    blocks.emplace_back();
    std::memcpy(&blocks.back(), bytes.data(), sizeof(mine));
  }
  return blocks;
}

BlockPlan ghost_layers(const std::vector<CellBox>& blocks, const std::array<int, 3>& periodic, int dimension) {
  BlockPlan plan{blocks, std::vector<std::vector<CellBox>>(blocks.size()), periodic};
  for (std::size_t r = 0; r < blocks.size(); ++r) {
    if (blocks[r].cells() == 0) continue;
    for (int a = 0; a < dimension; ++a) {
      CellBox low = blocks[r], high = blocks[r];
      low.upper[a] = low.lower[a]--;
      high.lower[a] = high.upper[a]++;
      plan.wanted[r].insert(plan.wanted[r].end(), {low, high});
    }
  }
  return plan;
}

BlockExchange::BlockExchange(const BlockPlan& plan, const Place& from, const Place& to, const Choice& chosen,
                             const Communicator& ranks)
    : handle_(ranks.handle()) {
  const std::vector<Cell> shifts = period_shifts(plan.periodic);
  // visit(cell of the owner, the same cell as its receiver names it)
  const auto for_pairs = [&](int owner, int receiver, const auto& visit) {
    for (const CellBox& wanted : plan.wanted[std::size_t(receiver)])
      for (const Cell& shift : shifts)
        for_each_cell(covered(wanted, plan.owned[std::size_t(owner)], shift), [&](const Cell& c) {
          if (chosen(sum(c, shift, -1))) visit(sum(c, shift, -1), c);
        });
  };
  const int me = ranks.rank();
  for (int rank = 0; rank < ranks.size(); ++rank) {
    Peer peer{rank, {}, {}, {}, {}};
    for_pairs(me, rank, [&](const Cell& own, const Cell&) { peer.send.push_back(int(from(own))); });
    for_pairs(rank, me, [&](const Cell&, const Cell& here) { peer.receive.push_back(int(to(here))); });
    if (rank == me) {
      copy_from_ = std::move(peer.send);
      copy_to_ = std::move(peer.receive);
    } else if (!peer.send.empty() || !peer.receive.empty()) {
      peer.outgoing.resize(peer.send.size());
      peer.incoming.resize(peer.receive.size());
      peers_.push_back(std::move(peer));
    }
  }
  requests_.resize(2 * peers_.size());
}

void BlockExchange::run(const float* from, float* to) {
  auto request = requests_.begin();
  for (Peer& p : peers_)
    MPI_Irecv(p.incoming.data(), int(p.incoming.size()), MPI_FLOAT, p.rank, tag, handle_, &*request++);
  for (Peer& p : peers_) {
    for (std::size_t n = 0; n < p.send.size(); ++n) p.outgoing[n] = from[p.send[n]];
    MPI_Isend(p.outgoing.data(), int(p.outgoing.size()), MPI_FLOAT, p.rank, tag, handle_, &*request++);
  }
  for (std::size_t n = 0; n < copy_to_.size(); ++n) to[copy_to_[n]] = from[copy_from_[n]];
  if (peers_.empty()) return;
  MPI_Waitall(int(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
  for (const Peer& p : peers_)
    for (std::size_t n = 0; n < p.receive.size(); ++n) to[p.receive[n]] = p.incoming[n];
}

}  // namespace seiche
