#include "solid/thinness.h"

namespace seiche {
namespace {

// A second or so.
constexpr double most_samples = 2e7, most_samples_of_mesh = 2e6;

}  // namespace

template <int Dim>
bool is_thinner_than(const Body<Dim>& body, double h, const Vec<Dim>& lower, const Vec<Dim>& upper) {
  if (body.spec().shape.kind == "expression") return false;
  Vec<Dim> low = upper, high = lower;
  for (const Vec3& x : body.contact_surface().points) {
    low = low.cwiseMin(truncate<Dim>(x));
    high = high.cwiseMax(truncate<Dim>(x));
  }
  low = low.cwiseMax(lower), high = high.cwiseMin(upper);
  const Vec<Dim> count = ((high - low) / (h / 4)).array().ceil() + 1;
  if (count.minCoeff() < 1 || count.prod() > (body.spec().shape.kind == "mesh" ? most_samples_of_mesh : most_samples))
    return false;
  for (int n = 0; n < int(count.prod()); ++n) {
    Vec<Dim> x = low;
    for (int a = 0, rest = n; a < Dim; rest /= int(count[a]), ++a)
      x[a] += (high[a] - low[a]) * (rest % int(count[a])) / std::max(1.0, count[a] - 1);
    if (body.distance_at_rest(x) < -0.499 * h) return false;
  }
  return true;
}

template bool is_thinner_than<2>(const Body<2>&, double, const Vec<2>&, const Vec<2>&);
template bool is_thinner_than<3>(const Body<3>&, double, const Vec<3>&, const Vec<3>&);

}  // namespace seiche
