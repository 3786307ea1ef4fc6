#pragma once
// for_each_closing_body of step_geometry.h.

namespace seiche {

template <int Dim, class Visit>
void for_each_closing_body(const Layout<Dim>& layout, const StepGeometry<Dim>& g, int axis, Site face,
                           const Visit& visit) {
  const double closed = 1 - g.faces.open.at(axis, face);
  if (closed == 0) return;
  constexpr int corners = 1 << (Dim - 1);
  std::array<int, corners> body;
  std::array<double, corners> depth;
  double total = 0;
  for (int k = 0; k < corners; ++k) {
    Site node = face;
    for (int b = 1; b < Dim; ++b) node += ((k >> (b - 1)) & 1) * layout.stride((axis + b) % Dim);
    body[k] = g.body[node];
    depth[k] = std::max(-g.psi[node], 0.0);
    total += depth[k];
  }
  for (int k = 0; k < corners; ++k) {
    if (total == 0)
      visit(body[k], closed / corners);
    else if (depth[k] > 0)
      visit(body[k], closed * depth[k] / total);
  }
}

}  // namespace seiche
