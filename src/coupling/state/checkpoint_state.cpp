#include "coupling/state/checkpoint_state.h"

#include <fmt/format.h>

#include <cstring>

#include "base/error.h"
#include "coupling/state/impact_numbers.h"
#include "fluid/volume/spill.h"
#include "grid/loops.h"
#include "levelset/redistance.h"

namespace seiche {
namespace {

template <int Dim>
FieldRecord empty_record(const std::string& name, const Box<Dim>& box) {
  FieldRecord r;
  r.name = name;
  for (int a = 0; a < Dim; ++a) r.lower[a] = box.lower[a], r.upper[a] = box.upper[a];
  if (Dim == 2) r.upper[2] = box.empty() ? 0 : 1;
  return r;
}

std::string bytes_of(const double* values, std::size_t count) {
  return {reinterpret_cast<const char*>(values), count * sizeof(double)};
}

using Get = std::function<double(Site)>;
using Set = std::function<void(Site, double)>;

// Saves vectors as texts that hold their bytes.
template <int Dim>
class Saver : public FieldVisitor<Dim> {
 public:
  Saver(const Layout<Dim>& layout, CheckpointData& data) : layout_(layout), data_(data) {}
  bool loads() const override { return false; }
  void number(const std::string& name, double& value) override { data_.scalars[name] = value; }
  void vector(const std::string& name, Eigen::VectorXd& v) override {
    data_.texts[name] = bytes_of(v.data(), std::size_t(v.size()));
  }
  void numbers(const std::string& name, std::vector<double>& v) override {
    data_.texts[name] = bytes_of(v.data(), v.size());
  }

 private:
  void values(const std::string& name, const Box<Dim>& box, const Get& get, const Set&) override {
    FieldRecord r = empty_record<Dim>(name, box);
    for_each_index_in_order(layout_, box, [&](Site s, const IVec<Dim>&) { r.values.push_back(get(s)); });
    data_.fields.push_back(std::move(r));
  }

  const Layout<Dim>& layout_;
  CheckpointData& data_;
};

template <int Dim>
class Loader : public FieldVisitor<Dim> {
 public:
  Loader(const Layout<Dim>& layout, const CheckpointData& data) : layout_(layout), data_(data) {}
  bool loads() const override { return true; }
  bool has(const std::string& name) const override {
    return data_.scalars.count(name) > 0 || data_.texts.count(name) > 0;
  }
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
  void numbers(const std::string& name, std::vector<double>& v) override {
    const auto found = data_.texts.find(name);
    if (found == data_.texts.end()) throw Error(ExitCode::bad_checkpoint, "the checkpoint lacks '" + name + "'");
    v.resize(found->second.size() / sizeof(double));
    if (!v.empty()) std::memcpy(v.data(), found->second.data(), v.size() * sizeof(double));
  }

 private:
  void values(const std::string& name, const Box<Dim>& box, const Get&, const Set& set) override {
    const auto found =
        std::find_if(data_.fields.begin(), data_.fields.end(), [&](const auto& r) { return r.name == name; });
    if (found == data_.fields.end() || std::int64_t(found->values.size()) != box.size())
      throw Error(ExitCode::bad_checkpoint, "the checkpoint lacks the field '" + name + "' of this rank");
    const std::vector<double> values = found->values.unpack();
    auto next = values.begin();
    for_each_index_in_order(layout_, box, [&](Site s, const IVec<Dim>&) { set(s, *next++); });
  }

  const Layout<Dim>& layout_;
  const CheckpointData& data_;
};

// Lists names and boxes of the fields.
template <int Dim>
class Lister : public FieldVisitor<Dim> {
 public:
  std::vector<FieldRecord> boxes;
  bool loads() const override { return false; }
  void number(const std::string&, double&) override {}
  void vector(const std::string&, Eigen::VectorXd&) override {}
  void numbers(const std::string&, std::vector<double>&) override {}

 private:
  void values(const std::string& name, const Box<Dim>& box, const Get&, const Set&) override {
    boxes.push_back(empty_record<Dim>(name, box));
  }
};

template <int Dim>
void visit_level(const Domain<Dim>& domain, const Fluids& fluids, const std::string& name, TimeLevel<Dim>& level,
                 FieldVisitor<Dim>& visitor) {
  for (int a = 0; a < Dim; ++a) {
    const auto visit = [&](const char* field, auto& values) {
      visitor.field(fmt::format("{}.{}[{}]", name, field, "xyz"[a]), domain.layout.faces(a), values);
    };
    visit("u", level.u[a]);
    visit("valid", level.valid[a]);
    visit("q", level.q[a]);
    if (fluids.is_viscous()) visit("n", level.n[a]);
  }
  if (!visitor.loads()) return;
  fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, level.u);
  domain.halo.fill_ghosts(level.valid);
}

template <int Dim>
void visit_loads(const std::string& cause, std::vector<SolidLoad>& loads, FieldVisitor<Dim>& visitor) {
  for (std::size_t k = 0; k < loads.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      visitor.number(fmt::format("{}.{}.force{}", cause, k, c), loads[k].force[c]);
      visitor.number(fmt::format("{}.{}.torque{}", cause, k, c), loads[k].torque[c]);
    }
}

void visit_sized(const std::string& name, Eigen::VectorXd& values, StateVisitor& visitor) {
  double size = double(values.size());
  visitor.number(name + "_size", size);
  values.conservativeResize(Eigen::Index(size));
  visitor.vector(name, values);
}

void visit_joint(std::size_t k, JointState& joint, StateVisitor& visitor) {
  const std::string prefix = fmt::format("joint.{}.", k);
  double broken = joint.broken, rows = double(joint.bend.size());
  visitor.number(prefix + "q", joint.q);
  visitor.number(prefix + "rate", joint.rate);
  visitor.number(prefix + "shown_q", joint.shown_q);
  visitor.number(prefix + "gap", joint.gap);
  visitor.number(prefix + "power", joint.power);
  visitor.number(prefix + "broken", broken);
  visitor.number(prefix + "rows", rows);
  for (int a = 0; a < 3; ++a) {
    visitor.number(fmt::format("{}force{}", prefix, a), joint.force[a]);
    visitor.number(fmt::format("{}torque{}", prefix, a), joint.torque[a]);
    visitor.number(fmt::format("{}point{}", prefix, a), joint.point[a]);
  }
  joint.broken = broken != 0;
  joint.bend.conservativeResize(Eigen::Index(rows));
  visitor.vector(prefix + "bend", joint.bend);
  if (!visitor.has(prefix + "interval")) return;  // checkpoints of earlier versions
  visitor.number(prefix + "interval", joint.interval);
  visit_sized(prefix + "bow", joint.bow, visitor);
  visit_sized(prefix + "bow_rows", joint.bow_rows, visitor);
  visit_sized(prefix + "bow_load", joint.bow_load, visitor);
}

// "impacts" and "impacts.under_way" of earlier versions held other numbers: impacts under way are over after a step or
// two, and left out.
template <int Dim>
void visit_impacts(const Solids<Dim>& solids, Impacts& impacts, FieldVisitor<Dim>& visitor) {
  if (solids.restitutions.empty() || !visitor.has("impacts.due")) return;
  std::vector<double> all = pack_impacts(impacts);
  visitor.numbers("impacts.due", all);
  if (!visitor.loads()) return;
  std::optional<Impacts> known = unpack_impacts(all, solids.bodies.size());
  if (!known) throw Error(ExitCode::bad_checkpoint, "the checkpoint's impacts of solids make no sense");
  impacts = std::move(*known);
}

// The drops of all ranks, by id; each rank takes those in its cells. Checkpoints of earlier versions have none.
// Collective.
template <int Dim>
void visit_drops(const Domain<Dim>& domain, Drops<Dim>& drops, FieldVisitor<Dim>& visitor) {
  if (!visitor.has("drops")) return;
  visitor.number("left_out_volume", drops.left_out);
  std::vector<double> all;
  if (!visitor.loads()) {
    std::vector<Drop<Dim>> gathered;
    const std::vector<double> own = pack_drops(drops.list);
    for (const std::string& bytes : domain.ranks.all_gather(bytes_of(own.data(), own.size()))) {
      std::vector<double> numbers(bytes.size() / sizeof(double));
      if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
      const std::vector<Drop<Dim>> of_rank = unpack_drops<Dim>(numbers);
      gathered.insert(gathered.end(), of_rank.begin(), of_rank.end());
    }
    sort_drops(gathered);
    all = pack_drops(gathered);
  }
  visitor.numbers("drops", all);
  if (!visitor.loads()) return;
  drops.list = unpack_drops<Dim>(all);
  std::erase_if(drops.list, [&](const Drop<Dim>& d) {
    return !domain.layout.cells().contains(cell_around(domain.layout.geometry(), d.place));
  });
}

void visit_work(Work& work, StateVisitor& visitor) {
  visitor.number("work.gravity", work.gravity);
  visitor.number("work.tension", work.tension);
  visitor.number("work.sides", work.sides);
  visitor.number("work.solids", work.solids);
  visitor.number("work.lost_viscous", work.lost_viscous);
  visitor.number("work.lost_numerical", work.lost_numerical);
}

void visit_power(ViscousPower& power, StateVisitor& visitor) {
  visitor.number("viscous.dissipation", power.dissipation);
  visitor.number("viscous.sides", power.sides);
}

// Checkpoints of earlier versions have neither since_solve, volume_lag nor convected loads nor work.
template <int Dim>
void visit_numbers(const Fluids& fluids, std::size_t solids, State<Dim>& state, FieldVisitor<Dim>& visitor) {
  double step = double(state.step);
  visitor.number("time", state.time);
  visitor.number("step", step);
  visitor.number("dt_now", state.dt_now);
  visitor.number("dt_before", state.dt_before);
  if (visitor.has("since_solve")) visitor.number("since_solve", state.since_solve);
  if (visitor.loads()) state.volume_lag = state.since_solve;
  if (visitor.has("volume_lag")) visitor.number("volume_lag", state.volume_lag);
  visitor.number("horizon", state.horizon);
  if (visitor.loads()) state.planned = state.horizon;
  if (visitor.has("planned")) visitor.number("planned", state.planned);
  visitor.number("viscous_rate", state.viscous_rate);
  if (visitor.has("work.gravity")) visit_work(state.work, visitor);
  if (visitor.has("viscous.dissipation")) visit_power(state.viscous_power, visitor);
  visitor.number("expected_volume", state.expected_volume);
  visitor.number("corrected_volume", state.corrected_volume);
  if (visitor.has("spilled_volume")) visitor.number("spilled_volume", state.spilled_volume);
  state.step = std::int64_t(step);
  if (visitor.loads() && fluids.is_viscous() && state.step > 0) state.viscous_loads.resize(solids);
  if (visitor.loads() && visitor.has("convected.0.force0")) state.convected_loads.resize(solids);
  visit_loads("viscous", state.viscous_loads, visitor);
  visit_loads("convected", state.convected_loads, visitor);
}

template <int Dim>
void visit_cells(const Setup<Dim>& s, State<Dim>& state, FieldVisitor<Dim>& visitor) {
  const Domain<Dim>& domain = s.domain;
  visitor.field("phi", domain.layout.cells(), state.phi);
  visitor.field("pressure", domain.layout.cells(), state.pressure);
  if (s.tracks_volume()) visitor.field("liquid", domain.layout.cells(), state.liquid);
  if (s.volume_lags()) visitor.field("liquid_phi", domain.layout.cells(), state.liquid_phi);
  if (s.volume_meets_void()) visitor.field("liquid_beyond", domain.layout.cells(), state.liquid_beyond);
  if (s.fluids.liquid.separates) visitor.field("gap", domain.layout.cells(), state.separation.gap);
  if (s.solids.may_seal()) visitor.field("sealed", domain.layout.cells(), state.sealed);
  if (!visitor.loads()) return;
  fill_level_set_ghosts(domain.layout, domain.halo, state.phi);
  domain.halo.fill_ghosts(state.pressure);
  if (s.tracks_volume()) fill_share_ghosts(domain.layout, domain.halo, state.liquid);
  if (s.volume_lags()) fill_level_set_ghosts(domain.layout, domain.halo, state.liquid_phi);
  if (s.solids.may_seal()) domain.halo.fill_ghosts({state.sealed.data()});
}

template <int Dim>
void visit_room(const Setup<Dim>& s, State<Dim>& state, FieldVisitor<Dim>& visitor) {
  if (!s.room_changes()) return;
  const Layout<Dim>& layout = s.domain.layout;
  auto parts =
      visitor.loads() ? std::make_shared<OpenParts<Dim>>(layout) : std::const_pointer_cast<OpenParts<Dim>>(state.open);
  visitor.field("room", layout.cells(), parts->cells);
  for (int a = 0; a < Dim; ++a)
    visitor.field(fmt::format("room.through[{}]", "xyz"[a]), layout.faces(a), parts->faces[a]);
  if (!visitor.loads()) return;
  fill_open_ghosts(layout, s.domain.halo, *parts);
  state.open = std::move(parts);
}

// All that a state keeps, for saving, loading and the layout of checkpoints. Collective.
template <int Dim>
void visit_state(const Setup<Dim>& s, State<Dim>& state, FieldVisitor<Dim>& visitor) {
  double levels = state.earlier ? 3 : state.before ? 2 : 1;
  visitor.number("levels", levels);
  visit_numbers(s.fluids, s.solids.bodies.size(), state, visitor);
  visit_impacts(s.solids, state.impacts, visitor);
  if (s.volume_meets_void()) visit_drops(s.domain, state.drops, visitor);
  for (std::size_t k = 0; k < state.solids.size(); ++k) state.solids[k].visit(visitor);
  for (std::size_t k = 0; k < state.joints.size(); ++k) visit_joint(k, state.joints[k], visitor);
  visit_cells(s, state, visitor);
  visit_room(s, state, visitor);
  for (int a = 0; a < Dim; ++a) {
    visitor.field(std::string("film.open[") + "xyz"[a] + "]", s.domain.layout.faces(a), state.gap_flow.open[a]);
    visitor.field(std::string("film.u[") + "xyz"[a] + "]", s.domain.layout.faces(a), state.gap_flow.u[a]);
  }
  visit_flow(s.domain, s.fluids, "", int(levels), state, visitor);
  state.exterior->visit(s.domain, s.fluids, int(levels), visitor);
}

// A state without levels, whose fields have their size.
template <int Dim>
State<Dim> blank_state(const Setup<Dim>& s) {
  const Layout<Dim>& layout = s.domain.layout;
  State<Dim> state;
  state.exterior = s.exterior;
  state.solids = s.solids.at_start;
  state.joints.resize(s.solids.joints.list.size());
  state.phi = CellField<Dim>(layout);
  state.pressure = CellField<Dim>(layout);
  if (s.tracks_volume()) state.liquid = CellField<Dim>(layout);
  if (s.volume_lags()) state.liquid_phi = CellField<Dim>(layout);
  if (s.volume_meets_void()) state.liquid_beyond = CellField<Dim>(layout);
  state.open = s.open_parts;
  if (s.room_changes()) state.open = std::make_shared<OpenParts<Dim>>(layout);
  state.gap_flow = GapFlow<Dim>(layout);
  if (s.fluids.liquid.separates) state.separation = Separation<Dim>(layout);
  if (s.solids.may_seal()) state.sealed = CellField<Dim, char>(layout);
  return state;
}

}  // namespace

template <int Dim>
void visit_flow(const Domain<Dim>& domain, const Fluids& fluids, const std::string& prefix, int levels, Flow<Dim>& flow,
                FieldVisitor<Dim>& visitor) {
  const std::array<std::pair<const char*, std::shared_ptr<const TimeLevel<Dim>>*>, 3> all{
      {{"now", &flow.now}, {"before", &flow.before}, {"earlier", &flow.earlier}}};
  for (int n = 0; n < (visitor.loads() ? levels : 3); ++n) {
    const auto& [name, level] = all[std::size_t(n)];
    auto visited =
        *level && !visitor.loads()
            ? std::const_pointer_cast<TimeLevel<Dim>>(*level)
            : std::make_shared<TimeLevel<Dim>>(*level ? **level : empty_level(domain.layout, fluids.is_viscous()));
    visit_level(domain, fluids, prefix + name, *visited, visitor);
    if (visitor.loads()) *level = std::move(visited);
  }
}

template <int Dim>
CheckpointData save_state(const Setup<Dim>& setup, const State<Dim>& state) {
  CheckpointData data;
  Saver<Dim> saver(setup.domain.layout, data);
  visit_state(setup, const_cast<State<Dim>&>(state),
              saver);  // a Saver only reads; a copy would be as large as the state
  return data;
}

template <int Dim>
State<Dim> load_state(const Setup<Dim>& setup, const CheckpointData& data) {
  State<Dim> state = blank_state(setup);
  Loader<Dim> loader(setup.domain.layout, data);
  visit_state(setup, state, loader);
  return state;
}

template <int Dim>
std::vector<FieldRecord> state_boxes(const Setup<Dim>& setup) {
  State<Dim> state = blank_state(setup);
  Lister<Dim> lister;
  visit_state(setup, state, lister);
  return lister.boxes;
}

#define SEICHE_INSTANTIATE(D)                                                                                        \
  template void visit_flow<D>(const Domain<D>&, const Fluids&, const std::string&, int, Flow<D>&, FieldVisitor<D>&); \
  template CheckpointData save_state<D>(const Setup<D>&, const State<D>&);                                           \
  template State<D> load_state<D>(const Setup<D>&, const CheckpointData&);                                           \
  template std::vector<FieldRecord> state_boxes<D>(const Setup<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
