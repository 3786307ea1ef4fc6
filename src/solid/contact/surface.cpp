#include "solid/contact/surface.h"

#include <Eigen/Dense>
#include <algorithm>
#include <map>

#include "base/error.h"
#include "geometry/mesh/facets.h"

namespace seiche {
namespace contact {
namespace {

constexpr int leaf_size = 2;

template <int Dim>
void copy_used_points(const SurfaceMesh& mesh, const std::string& name, Surface<Dim>& s) {
  std::vector<int> place(mesh.points.size(), -1);
  for (Element<Dim> element : facets_of<Dim>(mesh)) {
    for (int& p : element) {
      if (p < 0 || p >= static_cast<int>(mesh.points.size()))
        throw Error(ExitCode::bad_input, name + ": its surface uses point " + std::to_string(p) + ", which it lacks");
      if (place[p] < 0) {
        place[p] = static_cast<int>(s.points.size());
        s.points.push_back(truncate<Dim>(mesh.points[p]));
        s.source.push_back(p);
      }
      p = place[p];
    }
    s.elements.push_back(element);
  }
}

template <int Dim>
void share_out_points(Surface<Dim>& s) {
  std::vector<char> taken(s.points.size(), 0);
  s.own_points.resize(s.elements.size());
  s.own_edges.resize(s.elements.size());
  for (size_t e = 0; e < s.elements.size(); ++e)
    for (int p : s.elements[e])
      if (!taken[p]) {
        taken[p] = 1;
        s.own_points[e].push_back(p);
      }
}

void share_out_edges(Surface<3>& s) {
  std::map<std::array<int, 2>, int> known;
  for (size_t e = 0; e < s.elements.size(); ++e)
    for (int side = 0; side < 3; ++side) {
      const int a = s.elements[e][side], b = s.elements[e][(side + 1) % 3];
      const std::array<int, 2> edge{std::min(a, b), std::max(a, b)};
      if (!known.try_emplace(edge, 0).second) continue;
      s.own_edges[e].push_back(static_cast<int>(s.edges.size()));
      s.edges.push_back(edge);
    }
}

template <int Dim>
Vec<Dim> middle(const Surface<Dim>& s, int element) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (int p : s.elements[element]) sum += s.points[p];
  return sum / Dim;
}

// Splits the elements at the median along the longest side of the box of their middles.
template <int Dim>
int grow_tree(Surface<Dim>& s, int first, int last) {
  const int node = static_cast<int>(s.nodes.size());
  s.nodes.push_back({first, last, 0, 0});
  if (last - first <= leaf_size) return node;
  Vec<Dim> lower = middle(s, s.order[first]), upper = lower;
  for (int i = first; i < last; ++i) {
    lower = lower.cwiseMin(middle(s, s.order[i]));
    upper = upper.cwiseMax(middle(s, s.order[i]));
  }
  int axis = 0;
  (upper - lower).maxCoeff(&axis);
  const int half = (first + last) / 2;
  std::nth_element(s.order.begin() + first, s.order.begin() + half, s.order.begin() + last,
                   [&](int a, int b) { return std::pair(middle(s, a)[axis], a) < std::pair(middle(s, b)[axis], b); });
  const int low = grow_tree(s, first, half), high = grow_tree(s, half, last);
  s.nodes[node].low_child = low;
  s.nodes[node].high_child = high;
  return node;
}

// Divergence theorem about the first point.
template <int Dim>
double signed_volume(const Surface<Dim>& s) {
  double sum = 0;
  for (const Element<Dim>& element : s.elements) {
    Eigen::Matrix<double, Dim, Dim> corners;
    for (int i = 0; i < Dim; ++i) corners.col(i) = s.points[element[i]] - s.points[0];
    sum += corners.determinant() / (Dim == 2 ? 2 : 6);
  }
  return sum;
}

}  // namespace

template <int Dim>
Surface<Dim> prepare_surface(const SurfaceMesh& mesh, const std::string& name) {
  Surface<Dim> s;
  copy_used_points(mesh, name, s);
  if (s.elements.empty()) return s;
  share_out_points(s);
  if constexpr (Dim == 3) share_out_edges(s);
  s.order.resize(s.elements.size());
  for (size_t e = 0; e < s.order.size(); ++e) s.order[e] = static_cast<int>(e);
  grow_tree(s, 0, static_cast<int>(s.order.size()));
  s.volume = signed_volume(s);
  return s;
}

template Surface<2> prepare_surface<2>(const SurfaceMesh&, const std::string&);
template Surface<3> prepare_surface<3>(const SurfaceMesh&, const std::string&);

namespace {

// The degrees of freedom of a body and of its points.
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
      throw Error(ExitCode::bad_input,
                  data.names.back() + ": point " + std::to_string(p) + " of its surface is at no node of its mesh");
    data.point_dof.push_back(deforms ? begin + Dim * node : -1);
    data.pinned.push_back(std::size_t(p) < body.pinned.size() ? body.pinned[std::size_t(p)] : 0);
  }
}

}  // namespace

}  // namespace contact

template <int Dim>
ContactScene<Dim>::ContactScene(const std::vector<ContactBody>& bodies, const std::vector<ContactWall>& walls) {
  auto data = std::make_shared<Data>();
  data->point_begin = {0};
  for (const ContactBody& b : bodies) {
    data->names.push_back(b.name.empty() ? "body " + std::to_string(data->names.size()) : b.name);
    data->surfaces.push_back(contact::prepare_surface<Dim>(b.surface, data->names.back()));
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

template class ContactScene<2>;
template class ContactScene<3>;

}  // namespace seiche
