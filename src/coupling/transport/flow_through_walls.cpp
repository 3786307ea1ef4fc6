#include "coupling/transport/flow_through_walls.h"

#include "coupling/transport/beside_solids.h"
#include "fluid/transport/advection.h"
#include "grid/loops.h"

namespace seiche {
namespace {

constexpr double near_sample = 1, far_sample = 1.5;  // distance of the samples from the surface, cells: within the halo
constexpr double shallow = 1;                        // cells: faces less deep have samples of their own
constexpr double deepest = 3;                        // cells that transport reads
constexpr int deep_layers = 2;                       // of faces between `shallow` and `deepest`
constexpr int wall_turns = 3;                        // samples read faces within the solid, too

// u' = slope s + bend s^2 at s cells outside the surface, for the component along the face's axis.
template <int Dim>
struct WallProfile {
  FaceField<Dim> slope, bend;  // m/s
  FaceField<Dim, char> known;

  explicit WallProfile(const Layout<Dim>& layout) : slope(layout), bend(layout), known(layout) {}
  void fill_ghosts(const Halo<Dim>& halo) {
    halo.fill_ghosts(slope);
    halo.fill_ghosts(bend);
    halo.fill_ghosts(known);
  }
};

// Calls body(axis, face, place) for the owned faces within the solids.
template <int Dim, class Body>
void for_each_within(const Layout<Dim>& layout, const NoSlipSolids<Dim>& solids, const Body& body) {
  for (int a = 0; a < Dim; ++a)
    for_each_index(layout, layout.faces(a), [&](Site f, const IVec<Dim>& i) {
      if (const auto place = solids.find(a, f, i, deepest)) body(a, f, *place);
    });
}

// Profile from the samples along the normal. The tangential part t has t(0) = 0, t(near_sample), t(far_sample).
template <int Dim>
void sample_profile(const Layout<Dim>& layout, const NoSlipSolids<Dim>& solids, const FaceField<Dim>& u, int axis,
                    Site f, const FaceInSolid<Dim>& place, WallProfile<Dim>& profile) {
  const Vec<Dim>& n = place.normal;
  const Vec<Dim> surface = place.center + place.depth * layout.h() * n;
  const auto relative = [&](double cells) -> Vec<Dim> {
    const Vec<Dim> x = surface + cells * layout.h() * n;
    return sample_velocity(layout, u, x) - solids.velocity(place.solid, x);
  };
  const auto along = [&](const Vec<Dim>& w) { return w[axis] - w.dot(n) * n[axis]; };
  const Vec<Dim> near = relative(near_sample), far = relative(far_sample);
  const double t1 = along(near) / near_sample, t2 = along(far) / far_sample;
  profile.slope.at(axis, f) = (t1 * far_sample - t2 * near_sample) / (far_sample - near_sample);
  profile.bend.at(axis, f) =
      (t2 - t1) / (far_sample - near_sample) + near.dot(n) * n[axis] / (near_sample * near_sample);
  profile.known.at(axis, f) = 1;
}

// Faces that are not known yet take the mean profile of the known ones beside them. Ghosts filled. Collective.
template <int Dim>
void deepen(const Domain<Dim>& domain, const NoSlipSolids<Dim>& solids, WallProfile<Dim>& profile) {
  const WallProfile<Dim> old = profile;
  for_each_within(domain.layout, solids, [&](int a, Site f, const FaceInSolid<Dim>&) {
    if (old.known.at(a, f)) return;
    double slope = 0, bend = 0;
    int count = 0;
    for (int b = 0; b < Dim; ++b)
      for (const Site g : {f - domain.layout.stride(b), f + domain.layout.stride(b)})
        if (old.known.at(a, g)) slope += old.slope.at(a, g), bend += old.bend.at(a, g), ++count;
    if (count == 0) return;
    profile.slope.at(a, f) = slope / count;
    profile.bend.at(a, f) = bend / count;
    profile.known.at(a, f) = 1;
  });
  profile.fill_ghosts(domain.halo);
}

}  // namespace

template <int Dim>
void continue_through_walls(const Domain<Dim>& domain, const NoSlipSolids<Dim>& solids, FaceField<Dim>& u) {
  if (!solids.any()) return;
  const Layout<Dim>& layout = domain.layout;
  for (int turn = 0; turn < wall_turns; ++turn) {
    WallProfile<Dim> profile(layout);
    for_each_within(layout, solids, [&](int a, Site f, const FaceInSolid<Dim>& place) {
      if (place.depth < shallow) sample_profile(layout, solids, u, a, f, place, profile);
    });
    profile.fill_ghosts(domain.halo);
    for (int n = 0; n < deep_layers; ++n) deepen(domain, solids, profile);
    for_each_within(layout, solids, [&](int a, Site f, const FaceInSolid<Dim>& place) {
      if (!profile.known.at(a, f)) return;
      const double y = place.depth;
      u.at(a, f) =
          solids.velocity(place.solid, place.center)[a] - profile.slope.at(a, f) * y + profile.bend.at(a, f) * y * y;
    });
    fill_velocity_ghosts(layout, domain.halo, domain.sides, u);
  }
}

template void continue_through_walls<2>(const Domain<2>&, const NoSlipSolids<2>&, FaceField<2>&);
template void continue_through_walls<3>(const Domain<3>&, const NoSlipSolids<3>&, FaceField<3>&);

}  // namespace seiche
