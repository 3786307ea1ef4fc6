#include "coupling/state/checkpoint_state.h"

#include <fmt/format.h>

#include <cstring>

#include "base/error.h"
#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "fluid/boundary/domain.h"
#include "grid/loops.h"
#include "levelset/redistance.h"

namespace seiche {
namespace {

// Record names of the time levels. All levels are always stored. Levels that do not exist yet are zero; the scalar
// "levels" is the number that exist.
using LevelNames = std::array<const char*, 3>;
constexpr LevelNames level_names{"now", "before", "earlier"};
constexpr LevelNames gas_level_names{"gas.now", "gas.before", "gas.earlier"};

template <int Dim>
FieldRecord empty_record(const std::string& name, const Box<Dim>& box) {
  FieldRecord r;
  r.name = name;
  for (int a = 0; a < Dim; ++a) r.lower[a] = box.lower[a], r.upper[a] = box.upper[a];
  if (Dim == 2) r.upper[2] = box.empty() ? 0 : 1;
  return r;
}

template <int Dim, class Array>
FieldRecord record(const Domain<Dim>& domain, const std::string& name, const Box<Dim>& box, const Array& f) {
  FieldRecord r = empty_record<Dim>(name, box);
  for_each_index_in_order(domain.layout, box, [&](Site c, const IVec<Dim>&) { r.values.push_back(double(f[c])); });
  return r;
}

template <int Dim, class Array>
void restore(const Domain<Dim>& domain, const CheckpointData& data, const std::string& name, const Box<Dim>& box,
             Array& f) {
  const auto found =
      std::find_if(data.fields.begin(), data.fields.end(), [&](const auto& r) { return r.name == name; });
  if (found == data.fields.end() || std::int64_t(found->values.size()) != box.size())
    throw Error(ExitCode::bad_checkpoint, "the checkpoint lacks the field '" + name + "' of this rank");
  std::size_t n = 0;
  for_each_index_in_order(domain.layout, box,
                          [&](Site c, const IVec<Dim>&) { f[c] = std::decay_t<decltype(f[c])>(found->values[n++]); });
}

// visit(name, initial of the field, axis) for each component of the face fields of a level.
template <int Dim, class Visit>
void for_each_level_field(const Fluids& fluids, const std::string& level, const Visit& visit) {
  std::vector<const char*> fields{"u", "valid", "q"};
  if (fluids.is_viscous()) fields.push_back("n");
  for (int a = 0; a < Dim; ++a)
    for (const char* field : fields) visit(level + "." + field + "[" + "xyz"[a] + "]", field[0], a);
}

// visit(name, component, axis) for each component of the gap flow's fields.
template <int Dim, class AnyGapFlow, class Visit>
void for_each_gap_flow_field(AnyGapFlow& gap_flow, const Visit& visit) {
  for (int a = 0; a < Dim; ++a) {
    visit(std::string("film.open[") + "xyz"[a] + "]", gap_flow.open[a], a);
    visit(std::string("film.u[") + "xyz"[a] + "]", gap_flow.u[a], a);
  }
}

template <int Dim>
void save_level(const Domain<Dim>& domain, const Fluids& fluids, const std::string& name, const TimeLevel<Dim>& level,
                CheckpointData& data) {
  for_each_level_field<Dim>(fluids, name, [&](const std::string& field, char which, int a) {
    const Box<Dim> box = domain.layout.faces(a);
    if (which == 'u') data.fields.push_back(record<Dim>(domain, field, box, level.u[a]));
    if (which == 'v') data.fields.push_back(record<Dim>(domain, field, box, level.valid[a]));
    if (which == 'q') data.fields.push_back(record<Dim>(domain, field, box, level.q[a]));
    if (which == 'n') data.fields.push_back(record<Dim>(domain, field, box, level.n[a]));
  });
}

template <int Dim>
std::shared_ptr<const TimeLevel<Dim>> load_level(const Domain<Dim>& domain, const Fluids& fluids,
                                                 const std::string& name, const CheckpointData& data) {
  auto level = std::make_shared<TimeLevel<Dim>>(empty_level(domain.layout, fluids.is_viscous()));
  for_each_level_field<Dim>(fluids, name, [&](const std::string& field, char which, int a) {
    const Box<Dim> box = domain.layout.faces(a);
    if (which == 'u') restore<Dim>(domain, data, field, box, level->u[a]);
    if (which == 'v') restore<Dim>(domain, data, field, box, level->valid[a]);
    if (which == 'q') restore<Dim>(domain, data, field, box, level->q[a]);
    if (which == 'n') restore<Dim>(domain, data, field, box, level->n[a]);
  });
  fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, level->u);
  domain.halo.fill_ghosts(level->valid);
  return level;
}

// Missing levels are saved as `none`.
template <int Dim>
void save_flow(const Domain<Dim>& domain, const Fluids& fluids, const LevelNames& names, const Flow<Dim>& flow,
               const TimeLevel<Dim>& none, CheckpointData& data) {
  save_level(domain, fluids, names[0], *flow.now, data);
  save_level(domain, fluids, names[1], flow.before ? *flow.before : none, data);
  save_level(domain, fluids, names[2], flow.earlier ? *flow.earlier : none, data);
}

template <int Dim>
Flow<Dim> load_flow(const Domain<Dim>& domain, const Fluids& fluids, const LevelNames& names, int levels,
                    const CheckpointData& data) {
  Flow<Dim> flow;
  flow.now = load_level(domain, fluids, names[0], data);
  if (levels >= 2) flow.before = load_level(domain, fluids, names[1], data);
  if (levels >= 3) flow.earlier = load_level(domain, fluids, names[2], data);
  return flow;
}

// visit(name, value) for each number of the loads of a state.
template <class AnyState, class Visit>
void for_each_load(AnyState& state, const Visit& visit) {
  const auto visit_all = [&](const char* cause, auto& loads) {
    for (std::size_t k = 0; k < loads.size(); ++k)
      for (int c = 0; c < 3; ++c) {
        visit(fmt::format("{}.{}.force{}", cause, k, c), loads[k].force[c]);
        visit(fmt::format("{}.{}.torque{}", cause, k, c), loads[k].torque[c]);
      }
  };
  visit_all("viscous", state.viscous_loads);
  visit_all("convected", state.convected_loads);
}

// Saves vectors as texts that hold their bytes.
class Saver : public StateVisitor {
 public:
  explicit Saver(CheckpointData& data) : data_(data) {}
  void number(const std::string& name, double& value) override { data_.scalars[name] = value; }
  void vector(const std::string& name, Eigen::VectorXd& v) override {
    data_.texts[name] = std::string(reinterpret_cast<const char*>(v.data()), std::size_t(v.size()) * sizeof(double));
  }

 private:
  CheckpointData& data_;
};

class Loader : public StateVisitor {
 public:
  explicit Loader(const CheckpointData& data) : data_(data) {}
  void number(const std::string& name, double& value) override {
    const auto found = data_.scalars.find(name);
    if (found == data_.scalars.end()) throw Error(ExitCode::bad_checkpoint, "the checkpoint lacks '" + name + "'");
    value = found->second;
  }
  void vector(const std::string& name, Eigen::VectorXd& v) override {
    const auto size = std::size_t(v.size());
    const auto found = data_.texts.find(name);
    if (found == data_.texts.end() || found->second.size() != size * sizeof(double))
      throw Error(ExitCode::bad_checkpoint,
                  fmt::format("the checkpoint lacks '{}' of {} numbers; the solid's mesh is another one", name, size));
    std::memcpy(v.data(), found->second.data(), found->second.size());
  }

 private:
  const CheckpointData& data_;
};

template <int Dim>
void visit_all(Participants<Dim>& solids, StateVisitor&& visitor) {
  for (std::size_t k = 0; k < solids.size(); ++k) solids[k].visit(visitor);
}

// Loads the loads on solids. state.step must be set. Checkpoints of earlier versions have no convected ones.
template <int Dim, class Scalar>
void load_loads(const CheckpointData& data, const Fluids& fluids, const Solids<Dim>& solids, const Scalar& scalar,
                State<Dim>& state) {
  if (fluids.is_viscous() && state.step > 0) state.viscous_loads.resize(solids.bodies.size());
  if (data.scalars.count("convected.0.force0") > 0) state.convected_loads.resize(solids.bodies.size());
  for_each_load(state, [&](const std::string& n, double& x) { x = scalar(n); });
}

// Saves enclosed air: the region of each cell, the volumes as bytes, and the volume lost.
template <int Dim>
void save_air(const Domain<Dim>& domain, const State<Dim>& state, CheckpointData& data) {
  data.fields.push_back(record<Dim>(domain, "air", domain.layout.cells(), state.air.label));
  const std::vector<double>& v = state.air.volume;
  data.texts["air.volume"] = std::string(reinterpret_cast<const char*>(v.data()), v.size() * sizeof(double));
  data.scalars["air.lost"] = state.lost_air;
}

template <int Dim, class Scalar>
void load_air(const Domain<Dim>& domain, const Fluids& fluids, const CheckpointData& data, const Scalar& scalar,
              State<Dim>& state) {
  if (!fluids.keeps_air()) return;
  state.lost_air = scalar("air.lost");
  const auto found = data.texts.find("air.volume");
  if (found == data.texts.end()) throw Error(ExitCode::bad_checkpoint, "the checkpoint lacks 'air.volume'");
  state.air.volume.resize(found->second.size() / sizeof(double));
  if (!found->second.empty()) std::memcpy(state.air.volume.data(), found->second.data(), found->second.size());
  state.air.label = CellField<Dim, std::int64_t>(domain.layout, no_air);
  restore<Dim>(domain, data, "air", domain.layout.cells(), state.air.label);
  domain.halo.fill_ghosts({state.air.label.data()});
}

// Loads the cell fields that only some scenes have: gaps at separating walls, and sealed liquid.
template <int Dim>
void load_marks(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids, const CheckpointData& data,
                State<Dim>& state) {
  if (fluids.liquid.separates) {
    state.separation = Separation<Dim>(domain.layout);
    restore<Dim>(domain, data, "gap", domain.layout.cells(), state.separation.gap);
  }
  if (solids.may_seal()) {
    state.sealed = CellField<Dim, char>(domain.layout);
    restore<Dim>(domain, data, "sealed", domain.layout.cells(), state.sealed);
    domain.halo.fill_ghosts({state.sealed.data()});
  }
}

}  // namespace

template <int Dim>
CheckpointData save_state(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                          const State<Dim>& state) {
  CheckpointData data;
  data.scalars = {{"time", state.time},
                  {"step", double(state.step)},
                  {"dt_now", state.dt_now},
                  {"dt_before", state.dt_before},
                  {"since_solve", state.since_solve},
                  {"horizon", state.horizon},
                  {"viscous_rate", state.viscous_rate},
                  {"levels", state.earlier  ? 3.0
                             : state.before ? 2.0
                                            : 1.0},
                  {"expected_volume", state.expected_volume},
                  {"corrected_volume", state.corrected_volume}};
  Participants<Dim> saved = state.solids;
  visit_all(saved, Saver(data));
  for_each_load(state, [&](const std::string& n, double x) { data.scalars[n] = x; });
  data.fields.push_back(record<Dim>(domain, "phi", domain.layout.cells(), state.phi));
  data.fields.push_back(record<Dim>(domain, "pressure", domain.layout.cells(), state.pressure));
  if (fluids.liquid.separates)
    data.fields.push_back(record<Dim>(domain, "gap", domain.layout.cells(), state.separation.gap));
  if (solids.may_seal()) data.fields.push_back(record<Dim>(domain, "sealed", domain.layout.cells(), state.sealed));
  if (fluids.keeps_air()) save_air(domain, state, data);
  for_each_gap_flow_field<Dim>(state.gap_flow, [&](const std::string& name, const auto& f, int a) {
    data.fields.push_back(record<Dim>(domain, name, domain.layout.faces(a), f));
  });
  const TimeLevel<Dim> none = empty_level(domain.layout, fluids.is_viscous());
  save_flow(domain, fluids, level_names, liquid_flow(state), none, data);
  if (fluids.has_gas()) save_flow(domain, fluids, gas_level_names, state.gas, none, data);
  return data;
}

template <int Dim>
State<Dim> load_state(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                      const CheckpointData& data) {
  const auto scalar = [&](const std::string& name) {
    const auto found = data.scalars.find(name);
    if (found == data.scalars.end()) throw Error(ExitCode::bad_checkpoint, "the checkpoint lacks '" + name + "'");
    return found->second;
  };
  State<Dim> state;
  state.time = scalar("time");
  state.step = std::int64_t(scalar("step"));
  state.dt_now = scalar("dt_now");
  state.dt_before = scalar("dt_before");
  state.since_solve = data.scalars.count("since_solve") > 0 ? scalar("since_solve") : 0;  // earlier versions: none
  state.horizon = scalar("horizon");
  state.viscous_rate = scalar("viscous_rate");
  state.expected_volume = scalar("expected_volume");
  state.corrected_volume = scalar("corrected_volume");
  load_loads(data, fluids, solids, scalar, state);
  load_air(domain, fluids, data, scalar, state);
  state.solids = solids.at_start;
  visit_all(state.solids, Loader(data));
  state.phi = CellField<Dim>(domain.layout);
  state.pressure = CellField<Dim>(domain.layout);
  restore<Dim>(domain, data, "phi", domain.layout.cells(), state.phi);
  restore<Dim>(domain, data, "pressure", domain.layout.cells(), state.pressure);
  load_marks(domain, fluids, solids, data, state);
  state.gap_flow = {FaceField<Dim>(domain.layout), FaceField<Dim>(domain.layout)};
  for_each_gap_flow_field<Dim>(state.gap_flow, [&](const std::string& name, auto& f, int a) {
    restore<Dim>(domain, data, name, domain.layout.faces(a), f);
  });
  fill_level_set_ghosts(domain.layout, domain.halo, state.phi);
  domain.halo.fill_ghosts(state.pressure);
  const int levels = int(scalar("levels"));
  const Flow<Dim> liquid = load_flow(domain, fluids, level_names, levels, data);
  std::tie(state.now, state.before, state.earlier) = std::tie(liquid.now, liquid.before, liquid.earlier);
  if (fluids.has_gas()) state.gas = load_flow(domain, fluids, gas_level_names, levels, data);
  return state;
}

template <int Dim>
std::vector<FieldRecord> state_boxes(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids) {
  std::vector<FieldRecord> boxes{empty_record<Dim>("phi", domain.layout.cells()),
                                 empty_record<Dim>("pressure", domain.layout.cells())};
  if (fluids.liquid.separates) boxes.push_back(empty_record<Dim>("gap", domain.layout.cells()));
  if (solids.may_seal()) boxes.push_back(empty_record<Dim>("sealed", domain.layout.cells()));
  if (fluids.keeps_air()) boxes.push_back(empty_record<Dim>("air", domain.layout.cells()));
  const GapFlow<Dim> gap_flow;
  for_each_gap_flow_field<Dim>(gap_flow, [&](const std::string& name, const auto&, int a) {
    boxes.push_back(empty_record<Dim>(name, domain.layout.faces(a)));
  });
  const auto add_levels = [&](const LevelNames& names) {
    for (const char* level : names)
      for_each_level_field<Dim>(fluids, level, [&](const std::string& field, char, int a) {
        boxes.push_back(empty_record<Dim>(field, domain.layout.faces(a)));
      });
  };
  add_levels(level_names);
  if (fluids.has_gas()) add_levels(gas_level_names);
  return boxes;
}

#define SEICHE_INSTANTIATE(D)                                                                                \
  template CheckpointData save_state<D>(const Domain<D>&, const Fluids&, const Solids<D>&, const State<D>&); \
  template State<D> load_state<D>(const Domain<D>&, const Fluids&, const Solids<D>&, const CheckpointData&); \
  template std::vector<FieldRecord> state_boxes<D>(const Domain<D>&, const Fluids&, const Solids<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
