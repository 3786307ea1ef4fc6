#pragma once
// How an elastic solid of a scene stands and moves: as the last solve left it.
#include "solid/body/body.h"
#include "solid/elastic/step.h"

namespace seiche {

struct ElasticMotion {
  ElasticState state;        // displacements and velocities now, and one step earlier
  Eigen::VectorXd velocity;  // w: mean velocity of the nodes over the coming step, m/s
  // Of each patch of the surface: the number of the cavity with sealed liquid that it is a wall of, and the volume that
  // this must keep, m^Dim; else not numbers.
  Eigen::VectorXd cavity, kept_volume;
  // Force and torque about the origin from the liquid beyond its pressure on the faces, stacked (N, N m).
  Eigen::VectorXd extra_load;
  Eigen::VectorXd reaction;  // likewise, from the pins as the last solve found them
};

using ElasticMotions = std::vector<const ElasticMotion*>;  // of each solid; null: not elastic

// The rest shape, moving as the scene says.
template <int Dim>
ElasticMotion initial_elastic_motion(const Body<Dim>& body);

// u + dt w, and the velocity that the scheme has there. `load` was that of the solve that w is from, `pins` are those
// at the end of the step.
template <int Dim>
void advance(const ElasticBody<Dim>& body, ElasticScheme scheme, double dt, const StepLoad& load, const Pins& pins,
             ElasticMotion& motion);

// Positions of the surface's points (ElasticSurface::facets) after displacements u of the nodes.
template <int Dim>
std::vector<Vec<Dim>> surface_points(const ElasticSolid<Dim>& solid, const Eigen::VectorXd& u);

// M, sums over the nodes of mass times position, and times velocity: centre of mass and mean motion.
struct BodyAverage {
  Vec3 center{0, 0, 0}, velocity{0, 0, 0}, angular_velocity{0, 0, 0};
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // nearest to the deformation (Mueller et al. 2005)
};
template <int Dim>
BodyAverage average(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, const Eigen::VectorXd& v);

}  // namespace seiche
