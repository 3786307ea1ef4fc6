#pragma once
// Copies values of cells between the blocks of all ranks: ghost layers, blocks cut differently, whole levels.
#include <functional>
#include <vector>

#include "base/communicator.h"
#include "linalg/core/grid_stencil.h"

namespace seiche {

// Cells that each rank owns and wants, the same on all ranks. Wanted cells may lie beyond a periodic side.
struct BlockPlan {
  std::vector<CellBox> owned;                // of each rank
  std::vector<std::vector<CellBox>> wanted;  // of each rank
  std::array<int, 3> periodic{0, 0, 0};      // cells along a periodic axis, else 0
};

// The cells beside each block, without edges and corners.
BlockPlan ghost_layers(const std::vector<CellBox>& blocks, const std::array<int, 3>& periodic, int dimension);

// A communicator of this rank alone.
Communicator alone();

// One block from every rank. Collective.
std::vector<CellBox> gather_blocks(const CellBox& mine, const Communicator& ranks);

class BlockExchange {
 public:
  using Place = std::function<std::size_t(const std::array<int, 3>&)>;
  using Choice = std::function<bool(const std::array<int, 3>&)>;
  BlockExchange() = default;
  // Values go from places `from` of owned cells to places `to` of wanted ones, for the owned cells that `chosen` names.
  BlockExchange(const BlockPlan& plan, const Place& from, const Place& to, const Choice& chosen,
                const Communicator& ranks);

  // Collective. Allocates nothing.
  void run(const float* from, float* to);

 private:
  struct Peer {
    int rank;
    std::vector<int> send, receive;  // places in the order of the message
    std::vector<float> outgoing, incoming;
  };
  MPI_Comm handle_ = MPI_COMM_NULL;
  std::vector<Peer> peers_;
  std::vector<int> copy_from_, copy_to_;  // within this rank
  std::vector<MPI_Request> requests_;
};

}  // namespace seiche
