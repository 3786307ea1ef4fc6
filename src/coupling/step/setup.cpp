// From a scene to its grid, solids and initial state.
#include <fmt/format.h>

#include "base/domain_spec.h"
#include "base/error.h"
#include "base/scene.h"
#include "base/time_spec.h"
#include "coupling/exterior/exteriors.h"
#include "coupling/report/measures.h"
#include "coupling/solids/contact_setup.h"
#include "coupling/solids/joint_leaving.h"
#include "coupling/solids/prescribed_loads.h"
#include "coupling/solids/solid_kinds.h"
#include "coupling/state/contact_pairs.h"
#include "coupling/state/features.h"
#include "coupling/state/fluids.h"
#include "coupling/state/operator_perturbation.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/source.h"
#include "coupling/state/state.h"
#include "coupling/step/initial_state.h"
#include "coupling/step/leapfrog.h"
#include "coupling/step/step_size.h"
#include "coupling/thin/gap_flow.h"
#include "coupling/thin/liquid_beside.h"
#include "coupling/thin/thin_solids.h"
#include "coupling/transport/formula_checks.h"
#include "coupling/transport/initial_surface.h"
#include "coupling/transport/liquid_viscosity.h"
#include "coupling/transport/prescribed_flow.h"
#include "coupling/transport/restore.h"
#include "coupling/transport/sponges.h"
#include "coupling/transport/tracked_volume.h"
#include "coupling/transport/transport.h"
#include "fluid/boundary/domain.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Smallest density of a free body over the liquid's. Less inertia is lost in round-off. The pressure on the body has a
// relative error of 1e-16, and the error of its velocity is that over its mass.
constexpr double least_density_ratio = 1e-7;

SolidSpec heavy_enough(SolidSpec spec, const LiquidSpec& liquid, std::vector<std::string>& notes) {
  const double least = least_density_ratio * liquid.density;
  if (!spec.kind.is_free() || spec.rigid.mass || spec.rigid.density >= least) return spec;
  notes.push_back(fmt::format("solid '{}': density {:g} kg/m^3 is taken as {:g}, {:g} of the liquid's", spec.name,
                              spec.rigid.density, least, least_density_ratio));
  spec.rigid.density = least;
  return spec;
}

void append_name(const std::string& name, std::string& list) {
  list += (list.empty() ? "'" : ", '") + name + "'";
}

template <int Dim>
std::vector<Body<Dim>> make_bodies(const Scene& scene, std::vector<std::string>& notes) {
  std::vector<Body<Dim>> bodies;
  const double h = scene.domain.cell_size;
  const Vec<Dim> lower = truncate<Dim>(scene.domain.lower), upper = truncate<Dim>(scene.domain.upper);
  for (const SolidSpec& spec : scene.solids)
    bodies.emplace_back(heavy_enough(spec, scene.liquid, notes), ShapeOptions{h, &notes}, lower, upper);
  return bodies;
}

// Tells that the liquid sees thin solids as steps.
template <int Dim>
void note_thin(Setup<Dim>& s) {
  std::string thin;
  for (const Body<Dim>& body : s.solids.bodies)
    if (body.is_thin()) append_name(body.spec().name, thin);
  if (thin.empty() || !s.may_have_fluid()) return;
  s.notes.push_back(fmt::format("thinner than a cell of {:g} m: {}; the liquid sees them as steps of whole cells",
                                s.domain.layout.h(), thin));
}

// Extends a box of liquid that ends at a side of the domain beyond it, since the wall is no free surface.
ShapeSpec open_to_sides(ShapeSpec shape, const DomainSpec& domain) {
  const TransformSpec& t = shape.transform;
  const bool plain = t.scale == 1 && t.rotate.degrees == 0 && t.translate.isZero(0) && !shape.invert;
  if (shape.kind != "box" || !plain) return shape;
  const double near = 1e-6 * domain.cell_size;
  for (int a = 0; a < 3; ++a) {
    const double size = domain.upper[a] - domain.lower[a];
    if (shape.lower[a] <= domain.lower[a] + near) shape.lower[a] = domain.lower[a] - size;
    if (shape.upper[a] >= domain.upper[a] - near) shape.upper[a] = domain.upper[a] + size;
  }
  return shape;
}

template <int Dim>
std::vector<std::unique_ptr<ShapeField<Dim>>> regions_of_liquid(const Setup<Dim>& s) {
  std::vector<std::unique_ptr<ShapeField<Dim>>> shapes;
  for (const auto& region : s.fluids.liquid.regions)
    shapes.push_back(make_shape<Dim>(open_to_sides(region.shape, s.scene->domain), {s.domain.layout.h(), nullptr}));
  return shapes;
}

// True if liquid fills the domain and nothing lets air in. Collective.
template <int Dim>
bool will_stay_full(const Setup<Dim>& s) {
  const bool sinks = s.fluids.gravity.may_act();
  if (s.fluids.gas.present || s.fluids.liquid.separates || !s.feeds.empty()) return false;
  return !(sinks && s.domain.sides.any_passes()) && fill_domain(s.domain, regions_of_liquid(s));
}

// Why a shift of the surface keeps the volume better than cells would, or as well for less
// (docs/decisions/0061-volumes-and-level-set.md); empty if it does not. Collective.
template <int Dim>
std::string reason_to_shift(const Setup<Dim>& s) {
  constexpr double longest_steps = 4;  // cells
  const bool keeps_shapes = !s.sources.empty() || !s.drains.empty();
  if (s.fluids.has_prescribed_flow())
    return keeps_shapes || s.domain.sides.any_inflow() ? "liquid enters or leaves a prescribed flow" : "";
  for (const Body<Dim>& body : s.solids.bodies)
    if (body.is_thin()) return fmt::format("solid '{}' is thinner than a cell", body.spec().name);
  if (s.fluids.has_gas()) return s.fluids.has_surface_tension() ? "the surface to the gas has tension" : "";
  if (!s.may_have_fluid()) return "there is no liquid";
  if (keeps_shapes) return "a source or drain without a rate keeps its shape full or empty";
  for (const Body<Dim>& body : s.solids.bodies) {
    if (body.kind().has_elements) return fmt::format("solid '{}' is elastic", body.spec().name);
    if (body.moves() && s.fluids.keeps_air())
      return fmt::format("solid '{}' moves, and enclosed air keeps its volume", body.spec().name);
  }
  if (s.scene->time.cfl > longest_steps) return fmt::format("time.cfl is above {:g}", longest_steps);
  return will_stay_full(s) ? "liquid fills the domain for good" : "";
}

template <int Dim>
void make_sources(const Scene& scene, Setup<Dim>& setup) {
  const auto make = [&](const std::vector<LiquidSourceSpec>& specs, const char* list, double sign,
                        std::vector<Source<Dim>>& kept) {
    for (std::size_t n = 0; n < specs.size(); ++n) {
      const bool moves = specs[n].motion || specs[n].attached_to;
      const ShapeSpec shape = moves ? specs[n].shape : open_to_sides(specs[n].shape, scene.domain);
      (specs[n].rate ? setup.feeds : kept)
          .emplace_back(specs[n], fmt::format("liquid.{}.{}", list, n), sign,
                        make_shape<Dim>(shape, {scene.domain.cell_size, &setup.notes}));
      Source<Dim>& made = (specs[n].rate ? setup.feeds : kept).back();
      const auto named = std::ranges::find(scene.solids, specs[n].attached_to.value_or(""), &SolidSpec::name);
      if (specs[n].attached_to) made.solid = int(named - scene.solids.begin());
    }
  };
  make(scene.liquid.sources, "source", 1, setup.sources);
  make(scene.liquid.drains, "drain", -1, setup.drains);
}

template <int Dim>
std::vector<Force<Dim>> make_forces(const Scene& scene, std::vector<std::string>& notes) {
  std::vector<Force<Dim>> forces;
  for (const ForceSpec& spec : scene.forces) forces.emplace_back(spec, ShapeOptions{scene.domain.cell_size, &notes});
  return forces;
}

// Message for an initial velocity that is not finite. `region`: its index; -1: the liquid's own velocity.
template <int Dim>
std::string velocity_fault(const Fluids& fluids, int region, int axis, double value, const Vec<Dim>& x) {
  const LiquidSpec& liquid = fluids.liquid;
  const std::string key = region < 0 ? "liquid" : fmt::format("liquid.region.{}", region);
  const Formula& formula = (region < 0 ? liquid.velocity : *liquid.regions[region].velocity)[axis];
  return not_finite_text<Dim>(fmt::format("{}.velocity[{}]", key, axis), formula, value, x, 0);
}

// Initial velocity on faces next to liquid: that of the regions in which they lie, else the liquid's. `fault`: message
// if a formula is not finite.
template <int Dim>
FaceField<Dim> initial_velocity(const Domain<Dim>& domain, const Fluids& fluids, const FaceField<Dim, char>& near,
                                const std::vector<std::unique_ptr<ShapeField<Dim>>>& shapes, std::string& fault) {
  FaceField<Dim> u(domain.layout);
  const VectorExpression everywhere(fluids.liquid.velocity);
  std::vector<std::optional<VectorExpression>> own;
  for (const auto& region : fluids.liquid.regions) {
    own.emplace_back();
    if (region.velocity) own.back().emplace(*region.velocity);
  }
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(domain.layout, domain.layout.faces(a), [&](Site f, const IVec<Dim>& i) {
      if (!near.at(a, f)) return;
      const Vec<Dim> x = domain.layout.position(i, face_offset<Dim>(a));
      int region = -1;
      for (std::size_t k = 0; k < shapes.size(); ++k)
        if (own[k] && (*shapes[k])(x) < domain.layout.h()) region = int(k);
      const VectorExpression& v = region < 0 ? everywhere : *own[region];
      u.at(a, f) = v.component(a, extend<Dim>(x), 0);
      if (fault.empty() && !std::isfinite(u.at(a, f))) fault = velocity_fault(fluids, region, a, u.at(a, f), x);
    });
  return u;
}

}  // namespace

template <int Dim>
Solids<Dim>::Solids(const Scene& scene, const Domain<Dim>& domain, const std::vector<Force<Dim>>& forces,
                    const OperatorPerturbation& perturbation, std::vector<std::string>& notes)
    : bodies(make_bodies<Dim>(scene, notes)),
      joints(scene, bodies),
      restitutions(pair_coefficients(scene, &ContactSpec::restitution)),
      apart(pairs_apart(scene, joints.pairs_apart())),
      geometry(domain.layout, domain.sides, bodies, apart),
      at_start(make_participants(bodies)),
      interactions(make_interactions(domain, bodies, joints, forces)),
      still_pieces(pieces_of_still_solids(domain, bodies)) {
  if (has_unknowns())
    contact.emplace(make_contact_scene(scene.domain, at_start, apart, pair_coefficients(scene, &ContactSpec::friction),
                                       perturbation));
}

template <int Dim>
bool Solids<Dim>::has_unknowns() const {
  return at_start.any([](const Participant<Dim>& p) { return p.unknowns() > 0; });
}

template <int Dim>
bool Solids<Dim>::plans_steps() const {
  return at_start.any([](const Participant<Dim>& p) { return p.plans_steps(); });
}

template <int Dim>
bool Solids<Dim>::may_seal() const {
  return at_start.any([](const Participant<Dim>& p) { return p.may_seal(); });
}

namespace {

// Throws Error(bad_input).
template <int Dim>
void refuse_thin(const Solids<Dim>& solids, const std::string& does_not_work_with, const std::string& remedy) {
  for (const Body<Dim>& body : solids.bodies)
    if (body.is_thin())
      throw Error(ExitCode::bad_input,
                  fmt::format("{}: solid '{}' is thinner than a cell, which does not work with {} yet; {}, or use "
                              "smaller cells",
                              body.spec().shape.where, body.spec().name, does_not_work_with, remedy));
}

}  // namespace

template <int Dim>
Setup<Dim>::Setup(const Scene& from, const Communicator& ranks, const OperatorPerturbation& operators,
                  std::vector<Box<Dim>> blocks)
    : scene(std::make_shared<const Scene>(from)),
      perturbation(operators),
      fluids(from),
      domain(from.domain, fluids.is_viscous() ? WallFlow::sticks : WallFlow::slips, int(std::ceil(from.time.cfl)),
             ranks, std::move(blocks), fluids.gravity.at(0)),
      forces(make_forces<Dim>(from, notes)),
      solids(from, domain, forces, perturbation, notes),
      exterior(make_exterior(fluids, domain)),
      sponges(make_sponges(from.liquid, from.domain)),
      followed(find_followed_points(from.probes, solids)) {
  make_sources(from, *this);
  note_thin(*this);
  fluids.rheology.yield_stress *= perturbation.yield_stress;
  features = Features(*this);
  if (fluids.liquid.volume == VolumeKeeping::automatic) shift_because = reason_to_shift(*this);
  if (!fluids.liquid.spray) refuse_thin(solids, "liquid.spray = false", "remove spray");
  if (!fluids.liquid.spray && !shift_because.empty())
    notes.push_back(fmt::format("liquid.spray = false does nothing here, since {} (liquid.volume)", shift_because));
  if (!tracks_volume() || solids.bodies.empty()) return;
  refuse_thin(solids, "liquid.volume = \"cells\"", "set \"shift\"");
  if (any_moves(solids) || fluids.liquid.separates) return;
  const StepGeometry<Dim> still = solids.geometry.measure(std::vector<Placement>(solids.bodies.size()), 0);
  open_parts =
      std::make_shared<OpenParts<Dim>>(measure_open_parts(domain.layout, domain.halo, still.psi, still.faces.open));
}

// Throws Error(bad_input) if a fixed step is too long for the initial velocity or the solids' motions. Checks a bounded
// number of steps, evenly spread over the run.
template <int Dim>
void check_fixed_step(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids, const TimeSpec& time,
                      const State<Dim>& start) {
  constexpr double most_looks = 1e4, budget = 2e6;  // steps checked; steps times bodies: a second or two
  if (!time.fixed_step || time.end <= 0) return;
  const double dt = std::min({*time.fixed_step, 1 / time.frame_rate, time.end});
  const double most = std::min(most_looks, budget / double(solids.bodies.size() + 1));
  const double looks = std::clamp(std::floor(time.end / dt), 1.0, most);
  std::string fault = fault_of_pinned_flow(domain, fluids, time, start, dt);
  for (int n = 0; fault.empty() && n < looks; ++n) {
    const double t = time.end * n / looks;
    std::vector<Placement> placed;
    for (std::size_t k = 0; k < start.solids.size(); ++k) {
      placed.push_back(start.solids[k].place(t, t + dt, t + dt));
      if (n == 0) start.solids[k].set_velocity(placed.back());
    }
    fault = fault_of_pinned_solids(domain, solids, time, placed, t, dt);
  }
  if (!fault.empty()) throw Error(ExitCode::bad_input, fault);
}

template <int Dim>
State<Dim> initial_state(const Setup<Dim>& s) {
  const std::vector<std::unique_ptr<ShapeField<Dim>>> shapes = regions_of_liquid(s);
  State<Dim> state;
  state.pressure = CellField<Dim>(s.domain.layout);
  if (s.fluids.liquid.separates) state.separation = Separation<Dim>(s.domain.layout);
  if (s.solids.may_seal()) state.sealed = CellField<Dim, char>(s.domain.layout);
  state.solids = s.solids.at_start;
  for (const Joint& joint : s.solids.joints.list) {
    state.joints.emplace_back();
    state.joints.back().q = state.joints.back().shown_q = joint.q_at_start;
  }
  refuse_overlaps(s.domain, s.solids, s.scene->domain, state);
  refuse_outside_at_start(s.solids.joints, s.domain, state);
  const StepGeometry<Dim> g = s.solids.geometry.measure(place_moving_bodies(state), 0);
  state.phi = initial_surface(s.domain, s.fluids, s.solids, g, shapes);
  if (has_thin_elastic(s.solids))
    keep_sides_apart(s.domain, s.solids, place_bodies(state), CellField<Dim>(state.phi), g, state.phi);
  state.expected_volume = liquid_volume(s.domain, state.phi, g.psi) - volume_beyond(s.domain, s.solids, g, state.phi);

  std::string fault;
  const FaceField<Dim, char> wet = faces_near_liquid(s.domain, state.phi);
  FaceField<Dim> u = initial_velocity(s.domain, s.fluids, wet, shapes, fault);
  state.exterior = s.exterior;
  state.exterior->start(s.domain, s.fluids, s.solids, g, state.phi, u, fault);
  check_formulas_at_start(s.domain, s.fluids, s.sources, s.scene->domain, g, fault);
  state.open = s.open_parts;
  if (s.room_changes())
    state.open =
        std::make_shared<OpenParts<Dim>>(measure_open_parts(s.domain.layout, s.domain.halo, g.psi, g.faces.open));
  if (s.tracks_volume()) start_volume(s.domain, g.psi, state);
  if (s.volume_lags()) state.liquid_phi = state.phi;
  if (s.volume_meets_void()) state.liquid_beyond = CellField<Dim>(s.domain.layout);
  state.now = s.fluids.has_prescribed_flow() ? prescribed_level(s.domain, s.fluids, state, 0)
                                             : initial_level(s.domain, s.fluids, s.solids, g, wet, std::move(u));
  state.gap_flow = measure_gap_flow(s.domain, g.faces, state.now->u);
  check_fixed_step(s.domain, s.fluids, s.solids, s.scene->time, state);
  return state;
}

template struct Solids<2>;
template struct Solids<3>;
template struct Setup<2>;
template struct Setup<3>;
template State<2> initial_state<2>(const Setup<2>&);
template State<3> initial_state<3>(const Setup<3>&);

}  // namespace seiche
