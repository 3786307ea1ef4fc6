#include "coupling/solids/face_columns.h"

#include <algorithm>

#include "fluid/boundary/domain.h"
#include "linalg/core/matrix_entries.h"

namespace seiche {

template <int Dim>
void send_air_rows_to_owner(const Domain<Dim>& domain, const PressureRows<Dim>& rows, std::size_t known,
                            std::vector<FluxEntry>& entries) {
  if (!rows.air) return;
  const auto of_air = [&](const FluxEntry& e) { return e.row < 0 || e.row >= int(rows.liquid); };
  std::vector<MatrixEntry> moved;
  for (std::size_t n = known; n < entries.size(); ++n)
    if (of_air(entries[n])) moved.push_back({rows.first + entries[n].row, entries[n].column, entries[n].value});
  entries.erase(std::remove_if(entries.begin() + std::ptrdiff_t(known), entries.end(), of_air), entries.end());
  for (const MatrixEntry& e : send_sums_to_owner(moved, rows.first, rows.cells.size(), domain.ranks))
    entries.push_back({int(e.row - rows.first), int(e.column), e.value});
}

void sort_by_rows(std::vector<FluxEntry>& entries) {
  std::stable_sort(entries.begin(), entries.end(), [](const FluxEntry& a, const FluxEntry& b) {
    return std::pair(a.row, a.column) < std::pair(b.row, b.column);
  });
}

ColumnBlock make_block(const std::vector<FluxEntry>& entries, const std::vector<Freedom>& freedom, Freedom kind,
                       int first, int width) {
  ColumnBlock block;
  block.width = width;
  for (std::size_t n = 0; n < entries.size();) {
    double sum = 0;
    const FluxEntry& e = entries[n];
    for (; n < entries.size() && entries[n].row == e.row && entries[n].column == e.column; ++n) sum += entries[n].value;
    if (sum != 0 && freedom[std::size_t(first + e.column)] == kind) block.add(e.row, e.column, sum);
  }
  return block;
}

template <int Dim>
ColumnBlock translation_columns(const CoupledStep<Dim>& step, int k, const std::vector<Freedom>& freedom, int first) {
  const FaceShares& shares = *step.geometry.shares[std::size_t(k)];
  std::vector<FluxEntry> entries;
  for_each_cell_of_shares(step.setup.domain, shares, with_row(step.rows), [&](Site cell, double sign, std::size_t n) {
    entries.push_back({int(step.rows.row[cell] - step.rows.first), shares[n].axis, sign * shares[n].closed});
  });
  send_air_rows_to_owner(step.setup.domain, step.rows, 0, entries);
  sort_by_rows(entries);
  return make_block(entries, freedom, Freedom::free, first, Dim);
}

#define SEICHE_INSTANTIATE(D)                                                                    \
  template void send_air_rows_to_owner<D>(const Domain<D>&, const PressureRows<D>&, std::size_t, \
                                          std::vector<FluxEntry>&);                              \
  template ColumnBlock translation_columns<D>(const CoupledStep<D>&, int, const std::vector<Freedom>&, int);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
