// Volumes of cells beside solids that have moved: covered cells, excess of full ones, what neighbours can take.
#include <catch2/catch.hpp>

#include "fluid/volume/moved_solids.h"
#include "fluid/volume/spill.h"
#include "grid/loops.h"

namespace moved_solids_tests {
using namespace seiche;

namespace {

// A box of 8 cells an axis. All of it is liquid, deep below a surface, unless phi is set.
template <int Dim>
struct Tank {
  Layout<Dim> layout;
  Communicator ranks;
  Halo<Dim> halo;
  CellField<Dim> phi, share;
  OpenParts<Dim> before, after;

  Tank() : Tank(geometry()) {}
  explicit Tank(const Geometry<Dim>& g)
      : layout(g, g.box(), 4),
        halo(layout, {g.box()}, ranks),
        phi(layout, -10),
        share(layout, 1),
        before(layout),
        after(layout) {}
  static Geometry<Dim> geometry() {
    Geometry<Dim> g;
    g.h = 1;
    g.cells = IVec<Dim>::Constant(8);
    return g;
  }
  Site cell(int i) const { return layout.site(IVec<Dim>(IVec<Dim>::Constant(4) + (i - 4) * IVec<Dim>::Unit(0))); }
  LedgerRules<Dim> ledger() const { return {Divergence::stays, Room<Dim>(before), Room<Dim>(after)}; }
  // No flow.
  RoomChange<Dim> change() const { return change_of_room(layout, ledger(), FaceField<Dim>(layout), 1); }
  double total() const {
    return local_sum(layout, layout.cells(), [&](Site c, const IVec<Dim>&) { return share[c]; });
  }
  double worst_excess() const {
    double worst = 0;
    for_each_index_in_order(layout, layout.cells(), [&](Site c, const IVec<Dim>&) {
      worst = std::max(worst, std::abs(share[c] - after.cells[c]));
    });
    return worst;
  }
};

// A solid moves from cell 3 to cell 4. The flow moved a tenth of a cell too little.
template <int Dim>
void check_full_cells() {
  Tank<Dim> t;
  t.before.cells.set(t.cell(3), 0), t.after.cells.set(t.cell(4), 0);
  t.share[t.cell(3)] = 0.9, t.share[t.cell(4)] = 0.1;
  fill_share_ghosts(t.layout, t.halo, t.share);
  const double total = t.total();
  follow_moved_solids(t.layout, t.halo, t.phi, t.ledger(), t.change(), t.share);
  CHECK(t.total() == Approx(total).epsilon(1e-14));
  CHECK(t.share[t.cell(4)] == 0);
  CHECK(t.worst_excess() < 0.04);
  CHECK(hand_on_excess(t.layout, t.halo, t.ranks, t.phi, t.ledger(), t.change(), t.share).moved ==
        0);  // deep cells keep it
}

// The solver's tolerance moves a solid at rest by less than counts: full cells beside it keep what they have.
template <int Dim>
void check_solid_at_rest() {
  Tank<Dim> t;
  t.before.cells.set(t.cell(4), 0.5), t.after.cells.set(t.cell(4), 0.5 + 1e-11);
  t.share[t.cell(3)] = 0.99, t.share[t.cell(4)] = 0.51;
  fill_share_ghosts(t.layout, t.halo, t.share);
  follow_moved_solids(t.layout, t.halo, t.phi, t.ledger(), t.change(), t.share);
  CHECK(t.share[t.cell(3)] == 0.99);
  CHECK(t.share[t.cell(4)] == 0.51);
}

// Cells in the air are no business of these rounds.
template <int Dim>
void check_surface_cells() {
  Tank<Dim> t;
  t.phi = CellField<Dim>(t.layout, 0.2);
  t.before.cells.set(t.cell(3), 0.5);
  t.share[t.cell(3)] = 0.7, t.share[t.cell(5)] = 0.4;
  fill_share_ghosts(t.layout, t.halo, t.share);
  follow_moved_solids(t.layout, t.halo, t.phi, t.ledger(), t.change(), t.share);
  CHECK(t.share[t.cell(3)] == 0.7);
  CHECK(t.share[t.cell(5)] == 0.4);
}

// The surface passes a cell beside a solid that moves: nine tenths are all that it is to hold.
template <int Dim>
void check_cut_surface_cell() {
  Tank<Dim> t;
  t.phi = CellField<Dim>(t.layout, -0.1 * t.layout.h());
  t.before.cells.set(t.cell(3), 0.5), t.after.cells.set(t.cell(3), 0.5 + 1e-15);
  t.share[t.cell(3)] = 0.5, t.share[t.cell(4)] = 0.95;
  fill_share_ghosts(t.layout, t.halo, t.share);
  follow_moved_solids(t.layout, t.halo, t.phi, t.ledger(), t.change(), t.share);
  CHECK(t.share[t.cell(4)] == Approx(0.95).epsilon(1e-14));
}

// All neighbours of a nearly empty cell lack liquid, and ask it for all that it has.
template <int Dim>
void check_no_overdraft() {
  Tank<Dim> t;
  t.phi = CellField<Dim>(t.layout, 0.2);
  t.share = CellField<Dim>(t.layout);
  t.share[t.cell(4)] = 0.01;
  for (int a = 0; a < Dim; ++a)
    for (const int way : {-1, 1}) t.share[t.cell(4) + way * t.layout.stride(a)] = -0.01;
  fill_share_ghosts(t.layout, t.halo, t.share);
  const double total = t.total();
  (void)hand_on_excess(t.layout, t.halo, t.ranks, t.phi, t.ledger(), t.change(), t.share);
  CHECK(t.total() == Approx(total).margin(1e-16));
  CHECK(t.share[t.cell(4)] >= -1e-17);
}

// phi tells the fraction of cells in a solid, which hold nothing.
template <int Dim>
void check_counted_groups() {
  Tank<Dim> t;
  t.share = CellField<Dim>(t.layout);
  for_each_index_in_order(t.layout, t.layout.padded(), [&](Site c, const IVec<Dim>&) { t.before.cells.set(c, 0); });
  const CountedShares<Dim> counted(t.layout, t.ledger(), t.phi, t.share);
  CHECK(counted[t.cell(4)] == 1);
  CHECK_FALSE(counted.all_empty(t.cell(0)));
}

}  // namespace

TEST_CASE("full cells beside a solid that moved keep their sum, and even out what they have too much") {
  check_full_cells<2>();
  check_full_cells<3>();
}

TEST_CASE("a solid that rounding moves leaves the liquid beside it as it is") {
  check_solid_at_rest<2>();
  check_solid_at_rest<3>();
}

TEST_CASE("cells that are not full stay as they are beside a solid that moved") {
  check_surface_cells<2>();
  check_surface_cells<3>();
  check_cut_surface_cell<2>();
  check_cut_surface_cell<3>();
}

TEST_CASE("cells that are asked for liquid give no more than they have") {
  check_no_overdraft<2>();
  check_no_overdraft<3>();
}

TEST_CASE("groups of cells in a solid count as phi tells") {
  check_counted_groups<2>();
  check_counted_groups<3>();
}

}  // namespace moved_solids_tests
