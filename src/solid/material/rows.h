#pragma once
// The rows of the table of materials; one file each.
#include "solid/material/material.h"

namespace seiche::elastic {

template <int Dim>
ElasticMaterial<Dim> stable_neo_hookean();
template <int Dim>
ElasticMaterial<Dim> neo_hookean();
template <int Dim>
ElasticMaterial<Dim> corotated();
template <int Dim>
ElasticMaterial<Dim> st_venant_kirchhoff();

}  // namespace seiche::elastic
