#include "grid/partition.h"

#include <catch2/catch.hpp>

#include <numeric>

#include "grid/loops.h"

namespace partition_tests {
using namespace seiche;

namespace {

// A grid on one rank with the cells of a column of liquid active, as at the start of a dam break.
template <int Dim>
struct Dam {
  Layout<Dim> layout;
  CellField<Dim, char> active;

  Dam(const IVec<Dim>& cells, double wide, double high)
      : layout(geometry(cells), {IVec<Dim>::Zero(), cells}, 3), active(layout) {
    for_each_index_in_order(layout, layout.cells(), [&](Site s, const IVec<Dim>& i) {
      active[s] = i[0] < wide * cells[0] && i[1] < high * cells[1];
    });
  }
  static Geometry<Dim> geometry(const IVec<Dim>& cells) {
    Geometry<Dim> g;
    g.cells = cells;
    return g;
  }
  double imbalance_of(const std::vector<Box<Dim>>& blocks) const {
    return imbalance(work_of_blocks(layout, active, blocks, Communicator(MPI_COMM_SELF)));
  }
  std::vector<Box<Dim>> by_work(int count) const {
    return partition_by_work(layout, active, count, Communicator(MPI_COMM_SELF));
  }
};

template <int Dim>
void check_tiles(const std::vector<Box<Dim>>& blocks, const IVec<Dim>& cells) {
  std::int64_t sum = 0;
  for (std::size_t a = 0; a < blocks.size(); ++a) {
    sum += blocks[a].size();
    CHECK(blocks[a].cut({IVec<Dim>::Zero(), cells}).size() == blocks[a].size());
    for (std::size_t b = 0; b < a; ++b) CHECK(blocks[a].cut(blocks[b]).empty());
  }
  CHECK(sum == Box<Dim>{IVec<Dim>::Zero(), cells}.size());
}

}  // namespace

// The bar of 1.2 leaves room for layers of whole cells: 64 blocks have some 17 layers each way.
TEST_CASE("blocks by work share a dam break evenly, where blocks of equal size leave most ranks idle") {
  const IVec<3> cells(64, 64, 64);
  const Dam<3> dam(cells, 0.3, 0.6);
  for (const int ranks : {2, 3, 16, 64}) {
    CAPTURE(ranks);
    const auto blocks = dam.by_work(ranks);
    REQUIRE(int(blocks.size()) == ranks);
    check_tiles<3>(blocks, cells);
    CHECK(dam.imbalance_of(blocks) < 1.2);
  }
  CHECK(dam.imbalance_of(partition(dam.layout.geometry(), 16)) > 3);
  CHECK(dam.imbalance_of(partition(dam.layout.geometry(), 64)) > 3);
}

TEST_CASE("blocks by work tile grids of odd sizes, without liquid and with fewer cells than ranks") {
  for (const int ranks : {1, 2, 5, 7, 64}) {
    CAPTURE(ranks);
    check_tiles<2>(Dam<2>({31, 17}, 0.4, 0.5).by_work(ranks), {31, 17});
    check_tiles<2>(Dam<2>({31, 17}, 0, 0).by_work(ranks), {31, 17});
    check_tiles<2>(Dam<2>({3, 2}, 1, 1).by_work(ranks), {3, 2});
    check_tiles<3>(Dam<3>({1, 1, 1}, 1, 1).by_work(ranks), {1, 1, 1});
  }
}

TEST_CASE("the work of a block is its active cells and a small share of the others") {
  const Dam<2> dam({8, 4}, 0.5, 0.5);
  const std::vector<Box<2>> blocks{{{0, 0}, {4, 4}}, {{4, 0}, {8, 4}}};
  const auto work = work_of_blocks(dam.layout, dam.active, blocks, Communicator(MPI_COMM_SELF));
  CHECK(work == std::vector<double>{8 + 8 * idle_work, 16 * idle_work});
  CHECK(imbalance(work) == Approx(work[0] * 2 / (work[0] + work[1])));
  CHECK(imbalance({}) == 1);
}

}  // namespace partition_tests
