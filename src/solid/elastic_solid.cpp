#include "solid/elastic_solid.h"

namespace seiche {

template <int Dim>
ElasticSolid<Dim> make_elastic_solid(const SolidSpec& spec, const ShapeOptions&) {
  const Vec<Dim> lower = truncate<Dim>(spec.shape.lower), upper = truncate<Dim>(spec.shape.upper);
  IVec<Dim> cells;
  for (int a = 0; a < Dim; ++a)
    cells[a] = std::max(1, int(std::lround((upper[a] - lower[a]) / spec.elastic.element_size)));
  ElasticSolid<Dim> r;
  r.body = make_elastic_body<Dim>(box_mesh<Dim>(lower, upper, cells, spec.elastic.element_order),
                                  elastic_material<Dim>(spec.elastic.model),
                                  {spec.rigid.density, lame_of(spec.elastic.youngs_modulus, spec.elastic.poisson_ratio),
                                   spec.elastic.mass_damping, spec.elastic.damping});
  r.surface = surface_of(r.body.mesh);
  r.body_force = spec.elastic.body_force;
  return r;
}

template <int Dim>
Pins pins_at(const ElasticSolid<Dim>& solid, double) {
  std::vector<int> nodes;
  for (const PinnedNodes& p : solid.pins) nodes.insert(nodes.end(), p.nodes.begin(), p.nodes.end());
  return pin_nodes<Dim>(nodes);
}

template <int Dim>
Eigen::VectorXd body_force_at(const ElasticSolid<Dim>&, double) {
  return {};
}

#define SEICHE_INSTANTIATE(Dim)                                                              \
  template ElasticSolid<Dim> make_elastic_solid<Dim>(const SolidSpec&, const ShapeOptions&); \
  template Pins pins_at<Dim>(const ElasticSolid<Dim>&, double);                              \
  template Eigen::VectorXd body_force_at<Dim>(const ElasticSolid<Dim>&, double);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
