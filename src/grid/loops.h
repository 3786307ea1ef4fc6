#pragma once
// The only loops over the grid. Bodies run on several threads unless the name says otherwise. Results do not depend on
// the number of threads: sums are formed row by row in a fixed order.
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

#include "grid/groups.h"
#include "grid/layout.h"

namespace seiche {

namespace detail {

// The rows of a box along the first axis.
template <int Dim>
struct Rows {
  const Layout<Dim>& layout;
  Box<Dim> box;
  int length = 0;
  std::int64_t count = 0;

  Rows(const Layout<Dim>& l, const Box<Dim>& b) : layout(l), box(b) {
    if (b.empty()) return;
    length = b.upper[0] - b.lower[0];
    count = b.size() / length;
  }
  IVec<Dim> first(std::int64_t row) const {
    IVec<Dim> i = box.lower;
    for (int a = 1; a < Dim; ++a) {
      const int n = box.upper[a] - box.lower[a];
      i[a] += int(row % n);
      row /= n;
    }
    return i;
  }
};

constexpr std::int64_t sites_a_task = 4096;
constexpr std::int64_t least_sites_to_share = 16384;  // a smaller loop ends about when another thread wakes

template <int Dim, class RowBody>
void for_each_row(const Rows<Dim>& rows, const RowBody& body) {
  if (rows.count == 0) return;
  const std::int64_t grain = std::max<std::int64_t>(1, sites_a_task / rows.length);
  if (rows.count * rows.length < least_sites_to_share) {
    for (std::int64_t r = 0; r < rows.count; ++r) body(r);
    return;
  }
  tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, rows.count, grain), [&](const auto& range) {
    for (std::int64_t r = range.begin(); r != range.end(); ++r) body(r);
  });
}

}  // namespace detail

// Calls body(site) for all sites of a box.
template <int Dim, class Body>
void for_each_site(const Layout<Dim>& layout, const Box<Dim>& box, const Body& body) {
  const detail::Rows<Dim> rows(layout, box);
  detail::for_each_row(rows, [&](std::int64_t r) {
    const Site begin = layout.site(rows.first(r)), end = begin + rows.length;
    for (Site s = begin; s < end; ++s) body(s);
  });
}

namespace detail {

// Calls body(s) for begin <= s < end, but not for groups of which may_matter(first site) is false. Sites that are no
// whole group are not tested.
template <class Test, class Body>
void for_each_group_of_row(Site begin, Site end, const Test& may_matter, const Body& body) {
  for (; begin + a_group <= end; begin += a_group)
    if (may_matter(begin))
      for (Site s = begin; s < begin + a_group; ++s) body(s);
  for (; begin < end; ++begin) body(begin);
}

}  // namespace detail

// Calls body(site) for the sites of a box. Leaves out groups of sites along a row for which may_matter(first site) is
// false (grid/groups.h).
template <int Dim, class Test, class Body>
void for_each_possible(const Layout<Dim>& layout, const Box<Dim>& box, const Test& may_matter, const Body& body) {
  const detail::Rows<Dim> rows(layout, box);
  detail::for_each_row(rows, [&](std::int64_t r) {
    const Site begin = layout.site(rows.first(r));
    detail::for_each_group_of_row(begin, begin + rows.length, may_matter, body);
  });
}

// Calls body(site, index) for all sites of a box.
template <int Dim, class Body>
void for_each_index(const Layout<Dim>& layout, const Box<Dim>& box, const Body& body) {
  const detail::Rows<Dim> rows(layout, box);
  detail::for_each_row(rows, [&](std::int64_t r) {
    IVec<Dim> i = rows.first(r);
    Site s = layout.site(i);
    for (int n = 0; n < rows.length; ++n, ++s, ++i[0]) body(s, i);
  });
}

// Calls body(first site, its index, number of sites) for each row of a box along the first axis.
template <int Dim, class Body>
void for_each_row(const Layout<Dim>& layout, const Box<Dim>& box, const Body& body) {
  const detail::Rows<Dim> rows(layout, box);
  detail::for_each_row(rows, [&](std::int64_t r) {
    const IVec<Dim> i = rows.first(r);
    body(layout.site(i), i, rows.length);
  });
}

// Calls body(site, index) in order on one thread: for formulas and for filling lists.
template <int Dim, class Body>
void for_each_index_in_order(const Layout<Dim>& layout, const Box<Dim>& box, const Body& body) {
  const detail::Rows<Dim> rows(layout, box);
  for (std::int64_t r = 0; r < rows.count; ++r) {
    IVec<Dim> i = rows.first(r);
    Site s = layout.site(i);
    for (int n = 0; n < rows.length; ++n, ++s, ++i[0]) body(s, i);
  }
}

namespace detail {

// Calls body(s) for the marked of the sites begin <= s < end. Skips eight at a time where none is marked.
template <class Body>
void for_each_marked_of_row(const char* marks, Site begin, Site end, const Body& body) {
  std::uint64_t eight = 0;
  for (Site s = begin; s < end;) {
    if (s + Site(sizeof eight) <= end) {
      std::memcpy(&eight, marks + s, sizeof eight);
      if (eight == 0) {
        s += Site(sizeof eight);
        continue;
      }
    }
    for (const Site stop = std::min(end, s + Site(sizeof eight)); s < stop; ++s)
      if (marks[s] != 0) body(s);
  }
}

}  // namespace detail

// Calls body(site) for the sites of a box whose mark is not 0. `marks`: one for each stored site.
template <int Dim, class Body>
void for_each_marked(const Layout<Dim>& layout, const Box<Dim>& box, const char* marks, const Body& body) {
  const detail::Rows<Dim> rows(layout, box);
  detail::for_each_row(rows, [&](std::int64_t r) {
    const Site begin = layout.site(rows.first(r));
    detail::for_each_marked_of_row(marks, begin, begin + rows.length, body);
  });
}

// Calls body(site, index) for the sites of a box whose mark is not 0.
template <int Dim, class Body>
void for_each_marked_index(const Layout<Dim>& layout, const Box<Dim>& box, const char* marks, const Body& body) {
  const detail::Rows<Dim> rows(layout, box);
  detail::for_each_row(rows, [&](std::int64_t r) {
    const IVec<Dim> first = rows.first(r);
    const Site begin = layout.site(first);
    detail::for_each_marked_of_row(marks, begin, begin + rows.length, [&](Site s) {
      IVec<Dim> i = first;
      i[0] += int(s - begin);
      body(s, i);
    });
  });
}

// Calls body(site) for all sites of a list.
template <class Body>
void for_each_listed(const std::vector<Site>& list, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, list.size(), detail::sites_a_task), [&](const auto& range) {
    for (std::size_t n = range.begin(); n != range.end(); ++n) body(list[n]);
  });
}

// The sites of a box for which wanted(site) is true, row by row. may_matter: as for for_each_possible().
template <int Dim, class Test, class Wanted>
std::vector<Site> listed_possible(const Layout<Dim>& layout, const Box<Dim>& box, const Test& may_matter,
                                  const Wanted& wanted) {
  const detail::Rows<Dim> rows(layout, box);
  std::vector<std::vector<Site>> found(std::size_t(rows.count));
  detail::for_each_row(rows, [&](std::int64_t r) {
    const Site begin = layout.site(rows.first(r));
    detail::for_each_group_of_row(begin, begin + rows.length, may_matter, [&](Site s) {
      if (wanted(s)) found[std::size_t(r)].push_back(s);
    });
  });
  std::vector<Site> all;
  for (const std::vector<Site>& row : found) all.insert(all.end(), row.begin(), row.end());
  return all;
}

// Sum of body(site, index), numbers or a type with += and zero {}, over a box on this rank only.
template <int Dim, class Body>
auto local_sum(const Layout<Dim>& layout, const Box<Dim>& box, const Body& body) {
  using Sum = std::decay_t<decltype(body(Site{}, IVec<Dim>{}))>;
  const detail::Rows<Dim> rows(layout, box);
  std::vector<Sum> partial(std::size_t(rows.count), Sum{});
  detail::for_each_row(rows, [&](std::int64_t r) {
    IVec<Dim> i = rows.first(r);
    Site s = layout.site(i);
    Sum sum{};
    for (int n = 0; n < rows.length; ++n, ++s, ++i[0]) sum += body(s, i);
    partial[std::size_t(r)] = sum;
  });
  Sum total{};
  for (const Sum& p : partial) total += p;
  return total;
}

// The same of body(site) without groups of sites along a row for which may_matter(first site) is false.
template <int Dim, class Test, class Body>
auto local_sum_of_possible(const Layout<Dim>& layout, const Box<Dim>& box, const Test& may_matter, const Body& body) {
  using Sum = std::decay_t<decltype(body(Site{}))>;
  const detail::Rows<Dim> rows(layout, box);
  std::vector<Sum> partial(std::size_t(rows.count), Sum{});
  detail::for_each_row(rows, [&](std::int64_t r) {
    const Site begin = layout.site(rows.first(r));
    Sum sum{};
    detail::for_each_group_of_row(begin, begin + rows.length, may_matter, [&](Site s) { sum += body(s); });
    partial[std::size_t(r)] = sum;
  });
  Sum total{};
  for (const Sum& p : partial) total += p;
  return total;
}

// Largest body(site) over a box on this rank only, at least `least`. may_matter: as for for_each_possible().
template <int Dim, class Test, class Body>
double local_max_of_possible(const Layout<Dim>& layout, const Box<Dim>& box, double least, const Test& may_matter,
                             const Body& body) {
  const detail::Rows<Dim> rows(layout, box);
  std::vector<double> partial(std::size_t(rows.count), least);
  detail::for_each_row(rows, [&](std::int64_t r) {
    const Site begin = layout.site(rows.first(r));
    double largest = least;
    detail::for_each_group_of_row(begin, begin + rows.length, may_matter,
                                  [&](Site s) { largest = std::max<double>(largest, body(s)); });
    partial[std::size_t(r)] = largest;
  });
  double largest = least;
  for (double p : partial) largest = std::max(largest, p);
  return largest;
}

template <int Dim, class Body>
double local_max(const Layout<Dim>& layout, const Box<Dim>& box, double least, const Body& body) {
  return local_max_of_possible(
      layout, box, least, [](Site) { return true; }, body);
}

}  // namespace seiche
