// Solids that deform as a sequence of meshes prescribes. Their nodes are the points of the meshes, all fixed unknowns.
#include <fmt/format.h>

#include "coupling/solids/elastic_coupling.h"
#include "coupling/solids/kind_elastic.h"
#include "coupling/solids/solid_kinds.h"
#include "geometry/mesh/facets.h"

namespace seiche {
namespace {

template <int Dim>
class DeformingParticipant : public ElasticParticipant<Dim> {
 public:
  using ElasticParticipant<Dim>::ElasticParticipant;
  using ElasticParticipant<Dim>::motion;
  std::unique_ptr<Participant<Dim>> copy() const override { return std::make_unique<DeformingParticipant>(*this); }

  void couple(const CoupledStep<Dim>& step, int block, CouplingParts<Dim>& parts) const override {
    couple_deforming_body(step, this->index(), motion(), block, parts);
  }

  // The nodes stand where the meshes are at the end of the step.
  void advance(const Stride<Dim>& stride) override {
    ElasticState& state = motion().state;
    motion().velocity = stride.velocity;
    state.u_old = state.u;
    state.v_old = state.v;
    state.u = places_in_sequence(this->elements(), stride.before.time + stride.dt);
    state.v = (state.u - state.u_old) / stride.dt;
    state.dt_old = stride.dt;
  }

  double possible_share(const Eigen::VectorXd&) const override { return 1; }
  double limit_of_start(double dt) const override { return dt; }
  double pull(double) const override { return 0; }
  void measure(const Gravity&, const TimeSpec&, const State<Dim>&, StepStats&) const override {}

  // The mean motion, at the centroid of the volume within the surface.
  void describe(const TimeSpec& time, const State<Dim>& state, SolidState& out) const override {
    ElasticParticipant<Dim>::describe(time, state, out);
    SurfaceMesh surface = this->elements().surface.facets;
    this->place_points(this->place(0, 0, 0), surface.points);
    const Vec3 centroid = mass_of_surface<Dim>(surface, 1).center;
    out.velocity += out.angular_velocity.cross(centroid - out.position);
    out.position = centroid;
  }

  // The points alone.
  VolumeFrame volume() const override {
    VolumeFrame frame;
    const std::vector<Vec<Dim>>& rest = this->elements().body.mesh.nodes;
    for (std::size_t n = 0; n < rest.size(); ++n) {
      const auto first = Eigen::Index(Dim * n);
      frame.rest.push_back(extend<Dim>(rest[n]));
      frame.displacement.push_back(extend<Dim>(Vec<Dim>(motion().state.u.template segment<Dim>(first))));
      frame.velocity.push_back(extend<Dim>(Vec<Dim>(motion().velocity.template segment<Dim>(first))));
      frame.surface_nodes.push_back(int(n));
    }
    frame.von_mises.resize(rest.size());
    return frame;
  }
  std::string describe_mesh() const override {
    const MeshSequence& meshes = *this->elements().sequence;
    return fmt::format("solid '{}': {} {} of {} points and {} {}", this->body().spec().name, meshes.count(),
                       Dim == 2 ? "outlines" : "meshes", meshes.first().points.size(),
                       facets_of<Dim>(meshes.first()).size(), Dim == 2 ? "lines" : "triangles");
  }
};

}  // namespace

SolidKindRow deforming_solid() {
  const SolidKind kind{.name = "deforming", .drive = Drive::prescribed, .follows_meshes = true};
  return {kind,
          "takes on a sequence of meshes",
          {},
          make_participant<DeformingParticipant<2>>,
          make_participant<DeformingParticipant<3>>};
}

}  // namespace seiche
