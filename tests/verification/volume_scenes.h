#pragma once
// Scenes whose liquid is kept in cells (liquid.volume = "cells").
#include "scenes.h"

namespace seiche::test {

// Liquid where phi < 0 in a box that is 1 m wide, with gravity.
inline Scene kept_in_cells(int dim, int cells, const Formula& phi) {
  Scene s = box_scene(dim, cells);
  s.gravity = {0, -9.81, 0};
  s.liquid.volume = VolumeKeeping::in_cells;
  add_liquid(s, phi);
  return s;
}

}  // namespace seiche::test
