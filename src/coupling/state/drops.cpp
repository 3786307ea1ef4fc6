#include "coupling/state/drops.h"

#include <algorithm>

namespace seiche {
namespace {

template <int Dim>
constexpr std::size_t numbers_of_drop = 2 * Dim + 2;

}  // namespace

template <int Dim>
void sort_drops(std::vector<Drop<Dim>>& drops) {
  std::sort(drops.begin(), drops.end(), [](const Drop<Dim>& a, const Drop<Dim>& b) { return a.id < b.id; });
}

template <int Dim>
std::vector<double> pack_drops(const std::vector<Drop<Dim>>& drops) {
  std::vector<double> numbers;
  for (const Drop<Dim>& d : drops) {
    numbers.insert(numbers.end(), d.place.begin(), d.place.end());
    numbers.insert(numbers.end(), d.velocity.begin(), d.velocity.end());
    numbers.insert(numbers.end(), {d.volume, double(d.id)});
  }
  return numbers;
}

template <int Dim>
std::vector<Drop<Dim>> unpack_drops(const std::vector<double>& numbers) {
  constexpr std::size_t count = numbers_of_drop<Dim>;
  std::vector<Drop<Dim>> drops;
  for (std::size_t n = 0; n + count <= numbers.size(); n += count) {
    const double* v = numbers.data() + n;
    Drop<Dim> d{{}, {}, v[2 * Dim], std::int64_t(v[2 * Dim + 1])};
    for (int a = 0; a < Dim; ++a) d.place[a] = v[a], d.velocity[a] = v[Dim + a];
    drops.push_back(d);
  }
  return drops;
}

#define SEICHE_INSTANTIATE(D)                                              \
  template void sort_drops<D>(std::vector<Drop<D>>&);                      \
  template std::vector<double> pack_drops<D>(const std::vector<Drop<D>>&); \
  template std::vector<Drop<D>> unpack_drops<D>(const std::vector<double>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
