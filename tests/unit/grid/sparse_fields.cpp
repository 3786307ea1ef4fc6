// Fields that are the same almost everywhere: memory of zeros, pages, and loops over marked sites.
#include <catch2/catch.hpp>
#include <fstream>
#include <random>

#include "grid/field_memory.h"
#include "grid/fields.h"
#include "grid/loops.h"
#include "grid/paged_fields.h"

namespace sparse_fields_tests {
using namespace seiche;

namespace {

constexpr std::size_t large_size = 300001;  // 2.4 MB

// Values at places of their own, 0 elsewhere.
FieldValues<double> scattered(unsigned seed) {
  FieldValues<double> values(large_size);
  std::mt19937 random(seed);
  for (int n = 0; n < 40; ++n) values[random() % large_size] = n + 1.0;
  return values;
}

std::vector<double> listed(const FieldValues<double>& values) {
  return {values.begin(), values.end()};
}

// Memory of this process, bytes.
double resident() {
  std::ifstream statm("/proc/self/statm");
  double whole = 0, pages = 0;
  statm >> whole >> pages;
  return pages * 4096;
}

}  // namespace

// Each field has 80 MB and one page that is written to.
TEST_CASE("large fields take memory only where they are not zero, and so do their copies") {
  constexpr std::size_t size = 10000000, each = size * sizeof(double);
  if (!is_large_field(each)) return;  // under AddressSanitizer
  const double before = resident();
  std::vector<FieldValues<double>> fields(1, FieldValues<double>(size));
  fields[0][size / 2] = 1;
  for (int n = 0; n < 20; ++n) fields.push_back(fields[std::size_t(n)]);
  CHECK(std::all_of(fields.begin(), fields.end(), [](const auto& f) { return f[size / 2] == 1; }));
  CHECK(resident() - before < 0.5 * each);  // the kernel's own tables, and other pages of this process
}

// Memory that is used again must not show what was there before.
TEST_CASE("a new large field is zero, whatever its memory held before") {
  for (unsigned turn = 0; turn < 40; ++turn) {
    {
      FieldValues<double> used(large_size, turn % 3 == 0 ? 0.0 : 7.0);
      used[turn * 7000] = 3;
    }
    const FieldValues<double> fresh(large_size);
    CHECK(std::all_of(fresh.begin(), fresh.end(), [](double v) { return v == 0; }));
  }
}

TEST_CASE("copies of large fields are equal, whatever their memory held before") {
  FieldValues<double> target = scattered(1);
  for (unsigned turn = 2; turn < 20; ++turn) {
    const FieldValues<double> source = turn % 4 == 0 ? FieldValues<double>(large_size, 5.0) : scattered(turn);
    const FieldValues<double> copy = source;
    target = source;
    CHECK(listed(copy) == listed(source));
    CHECK(listed(target) == listed(source));
  }
}

TEST_CASE("set_if_other writes other values and NaN") {
  double at = 1;
  set_if_other(at, 2.0);
  CHECK(at == 2);
  set_if_other(at, std::nan(""));
  CHECK(std::isnan(at));
  set_if_other(at, 0.0);
  CHECK(at == 0);
}

TEST_CASE("paged values hold what is set, and the one value elsewhere") {
  PagedValues<double> values(1000, 1.0);
  values.set(130, 4);
  values.add(130, 0.5);
  values.add(999, -1);
  values.set(500, 1);  // the value that holds everywhere
  PagedValues<double> copy = values;
  copy.set(130, 9);
  CHECK(values[130] == 4.5);
  CHECK(copy[130] == 9);
  CHECK(values[999] == 0);
  CHECK((values[0] == 1 && values[131] == 1 && values[500] == 1));
  std::vector<Site> others;
  values.for_each_stored([&](Site s, double v) {
    if (v != 1) others.push_back(s);
    CHECK(v == values[s]);
  });
  CHECK(others == std::vector<Site>{130, 999});
  values.fill(3);
  CHECK((values[130] == 3 && values[7] == 3));
}

TEST_CASE("loops over marked sites visit these alone, with their indices") {
  Geometry<3> g;
  g.cells = {21, 5, 4};
  const Layout<3> layout(g, g.box(), 2);
  std::mt19937 random(3);
  for (const unsigned share : {0u, 1u, 3u, 10u}) {
    CellField<3, char> marks(layout), visited(layout), by_index(layout);
    for_each_index_in_order(layout, layout.padded(),
                            [&](Site s, const IVec<3>&) { marks[s] = char(random() % 10 < share ? 2 : 0); });
    for_each_marked(layout, layout.cells(), marks.data(), [&](Site s) { visited[s] += 1; });
    for_each_marked_index(layout, layout.cells(), marks.data(),
                          [&](Site s, const IVec<3>& i) { by_index[s] = char(layout.site(i) == s); });
    for_each_index_in_order(layout, layout.padded(), [&](Site s, const IVec<3>& i) {
      const bool wanted = layout.cells().contains(i) && marks[s] != 0;
      CHECK(visited[s] == char(wanted));
      CHECK(by_index[s] == char(wanted));
    });
  }
}

}  // namespace sparse_fields_tests
