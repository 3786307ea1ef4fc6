#include "coupling/step/checks.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "grid/loops.h"

namespace seiche {
namespace {

template <int Dim>
std::string name_non_finite(const Layout<Dim>& layout, const std::string& name, const Box<Dim>& box, const double* f) {
  std::string first;
  for_each_index_in_order(layout, box, [&](Site c, const IVec<Dim>& i) {
    if (!first.empty() || std::isfinite(f[c])) return;
    first = fmt::format("{} is not a number at cell ({}", name, i[0]);
    for (int a = 1; a < Dim; ++a) first += fmt::format(", {}", i[a]);
    first += ")";
  });
  return first;
}

}  // namespace

template <int Dim>
std::string find_non_finite(const Domain<Dim>& domain, const std::string& name, const Box<Dim>& box, const double* f) {
  std::string mine;
  if (local_max_of_possible(
          domain.layout, box, 0, [&](Site c) { return !all_finite(f + c); },
          [&](Site c) { return std::isfinite(f[c]) ? 0 : 1; }) > 0)
    mine = name_non_finite(domain.layout, name, box, f);
  if (!domain.ranks.any(!mine.empty())) return {};
  for (const std::string& text : domain.ranks.all_gather(mine))
    if (!text.empty()) return text;
  return {};
}

template <int Dim>
std::string find_non_finite(const Domain<Dim>& domain, const std::string& name, const FaceField<Dim>& u) {
  for (int a = 0; a < Dim; ++a)
    if (auto text = find_non_finite(domain, name + "[" + "xyz"[a] + "]", domain.layout.faces(a), u[a].data());
        !text.empty())
      return text;
  return {};
}

template <int Dim>
void inject(const Domain<Dim>& domain, PhaseFault fault, double* f) {
  if (fault == PhaseFault::poison && !domain.layout.cells().empty())
    f[domain.layout.site(domain.layout.cells().lower)] = std::numeric_limits<double>::quiet_NaN();
}

template <int Dim>
void inject(const Domain<Dim>& domain, PhaseFault fault, PagedValues<double>& f) {
  if (fault == PhaseFault::poison && !domain.layout.cells().empty())
    f.set(domain.layout.site(domain.layout.cells().lower), std::numeric_limits<double>::quiet_NaN());
}

#define SEICHE_INSTANTIATE(D)                                                                                  \
  template std::string find_non_finite<D>(const Domain<D>&, const std::string&, const Box<D>&, const double*); \
  template std::string find_non_finite<D>(const Domain<D>&, const std::string&, const FaceField<D>&);          \
  template void inject<D>(const Domain<D>&, PhaseFault, double*);                                              \
  template void inject<D>(const Domain<D>&, PhaseFault, PagedValues<double>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
