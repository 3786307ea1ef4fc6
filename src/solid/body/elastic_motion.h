#pragma once
// State of an elastic solid of a scene after the last solve.
#include "solid/body/body.h"
#include "solid/elastic/step.h"

namespace seiche {

struct ElasticMotion {
  ElasticState state;        // displacements and velocities now, and one step earlier
  Eigen::VectorXd velocity;  // w: mean velocity of the nodes over the coming step, m/s
  // Per patch of the surface: the number of the cavity of sealed liquid that the patch is a wall of, and the volume to
  // keep (m^Dim). Both are NaN for patches without such a cavity.
  Eigen::VectorXd cavity, kept_volume;
  // Force and torque about the origin (N, N m, stacked) from the liquid, without the pressure on the faces.
  Eigen::VectorXd extra_load;
  Eigen::VectorXd reaction;  // force and torque from the pins in the last solve, stacked likewise
};

using ElasticMotions = std::vector<const ElasticMotion*>;  // one a solid; null: not elastic

// The rest shape with the scene's initial velocities, or a sequence of meshes at t = 0.
template <int Dim>
ElasticMotion initial_elastic_motion(const Body<Dim>& body);

// Displacements (m) of all nodes of a solid that follows meshes, at time t (s).
template <int Dim>
Eigen::VectorXd places_in_sequence(const ElasticSolid<Dim>& solid, double t);

// Moves to u + dt w and sets the velocity by the time scheme. `load` is the load of the solve that gave w; `pins` are
// those at the end of the step.
template <int Dim>
void advance(const ElasticBody<Dim>& body, ElasticScheme scheme, double dt, const StepLoad& load, const Pins& pins,
             ElasticMotion& motion);

// Positions of the surface's points (ElasticSurface::facets) at nodal displacements u.
template <int Dim>
std::vector<Vec<Dim>> surface_points(const ElasticSolid<Dim>& solid, const Eigen::VectorXd& u);

// Mean motion: centre of mass, mean velocity, angular velocity and rotation, weighted by nodal mass.
struct BodyAverage {
  Vec3 center{0, 0, 0}, velocity{0, 0, 0}, angular_velocity{0, 0, 0};
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // nearest to the deformation (Mueller et al. 2005)
};
template <int Dim>
BodyAverage average(const ElasticBody<Dim>& body, const Eigen::VectorXd& u, const Eigen::VectorXd& v);

}  // namespace seiche
