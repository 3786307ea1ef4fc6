#include "render/placed_shape.h"

#include <cmath>

#include "base/expression.h"
#include "base/solid_spec.h"

namespace seiche::render {

template <int Dim>
PlacedShape<Dim>::PlacedShape(const SolidSpec& solid, double cell_size, double time)
    : PlacedShape(solid, make_shape<Dim>(solid.shape, {cell_size, nullptr}), time) {}

template <int Dim>
PlacedShape<Dim>::PlacedShape(const SolidSpec& solid, std::shared_ptr<const ShapeField<Dim>> shape, double time)
    : center_(solid.motion.center), shape_(std::move(shape)) {
  if (!solid.kind.is_prescribed()) return;
  translate_ = VectorExpression(solid.motion.translate)(Vec3::Zero(), time);
  const double degrees = Expression(solid.motion.degrees)(Vec3::Zero(), time);
  back_ = Eigen::AngleAxisd(-degrees * M_PI / 180, solid.motion.axis.normalized()).toRotationMatrix();
}

template <int Dim>
double PlacedShape<Dim>::operator()(const Vec3& x) const {
  return (*shape_)(to_rest(x).template head<Dim>());
}

template class PlacedShape<2>;
template class PlacedShape<3>;

}  // namespace seiche::render
