#include "solid/contact/surface.h"

#include "solid/contact/friction.h"

#include "base/error.h"

namespace seiche {
namespace contact {
namespace {

// Assigns the degrees of freedom of a body and of its points.
template <int Dim>
void number(const ContactBody& body, typename ContactScene<Dim>::Data& data) {
  const Surface<Dim>& surface = data.surfaces.back();
  const int begin = data.size;
  const bool deforms = body.control == BodyControl::deformable;
  data.first_dof.push_back(body.control == BodyControl::prescribed ? -1 : begin);
  data.node_count.push_back(deforms ? body.node_count : 0);
  if (body.control == BodyControl::free) data.size += twist_size<Dim>;
  if (deforms) data.size += Dim * body.node_count;
  for (const int p : surface.source) {
    const int node = !deforms ? 0 : p < static_cast<int>(body.nodes.size()) ? body.nodes[p] : -1;
    if (deforms && (node < 0 || node >= body.node_count))
      throw Error(ExitCode::bad_input, data.names.back() + ": point " + std::to_string(p) +
                                           " of its surface coincides with no node of its mesh");
    data.point_dof.push_back(deforms ? begin + Dim * node : -1);
    data.pinned.push_back(std::size_t(p) < body.pinned.size() ? body.pinned[std::size_t(p)] : 0);
  }
}

}  // namespace

}  // namespace contact

template <int Dim>
ContactScene<Dim>::ContactScene(const std::vector<ContactBody>& bodies, const std::vector<ContactWall>& walls,
                                std::vector<std::array<int, 2>> apart, PairCoefficients friction) {
  auto data = std::make_shared<Data>();
  data->apart = std::move(apart);
  data->pair_friction = std::move(friction);
  data->point_begin = {0};
  for (const ContactBody& b : bodies) {
    data->names.push_back(b.name.empty() ? "body " + std::to_string(data->names.size()) : b.name);
    data->surfaces.push_back(build_surface_tree<Dim>(b.surface, data->names.back()));
    data->control.push_back(b.control);
    data->mass.push_back(b.mass);
    data->friction.push_back(b.friction);
    data->point_begin.push_back(data->point_begin.back() + static_cast<int>(data->surfaces.back().points.size()));
    contact::number<Dim>(b, *data);
  }
  for (const ContactWall& w : walls)
    data->walls.push_back({truncate<Dim>(w.point), truncate<Dim>(w.normal).normalized()});
  data_ = data;
}

template <int Dim>
double ContactScene<Dim>::Data::friction_between(int a, int b) const {
  const auto given = pair_friction.find(b < 0 ? std::array{a, b} : std::array{std::min(a, b), std::max(a, b)});
  if (given != pair_friction.end()) return given->second;
  return contact::pair_friction(friction[std::size_t(a)], b < 0 ? std::nullopt : friction[std::size_t(b)]);
}

template double ContactScene<2>::Data::friction_between(int, int) const;
template double ContactScene<3>::Data::friction_between(int, int) const;
template class ContactScene<2>;
template class ContactScene<3>;

}  // namespace seiche
