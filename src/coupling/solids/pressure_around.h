#pragma once
// Pressure of the liquid around an elastic body, continued into it.
#include "coupling/state/setup.h"
#include "fluid/boundary/domain.h"
#include "solid/elastic/body.h"

namespace seiche {

// Pressure (Pa), one a quadrature point of the body: p(x) = p_0 + b.x, fitted to the last step's pressure in the cells
// beside the faces that the body cuts or closes. Least squares, weighted with the closed shares of these faces. x is
// the middle of the point's element. Empty if no cell beside the body has a row. Collective.
template <int Dim>
std::vector<double> pressure_around(const Domain<Dim>& domain, const FaceShares& shares, const PressureRows<Dim>& rows,
                                    const CellField<Dim>& pressure, const ElasticBody<Dim>& body,
                                    const Eigen::VectorXd& u);

}  // namespace seiche
