// The Python module `seiche`: scenes, simulations, frames.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <optional>

#include "base/error.h"
#include "base/scene.h"
#include "base/signals.h"
#include "base/thread_limit.h"
#include "base/version.h"
#include "coupling/state/simulation.h"
#include "exporting/liquid.h"
#include "files/csv.h"
#include "geometry/vdb/openvdb_adapter.h"
#include "scene/materials.h"
#include "scene/reader.h"
#include "scene/values.h"
#include "scene/writer.h"

namespace py = pybind11;

namespace seiche {
namespace {

using Path = std::filesystem::path;

// MPI for the life of the interpreter. A program that was started without mpirun is one rank.
const Communicator& ranks() {
  static int argc = 0;
  static char** argv = nullptr;
  static const MpiSession session(argc, argv);
  static const Communicator all;
  return all;
}

// The text of a value given for a key: Python's lists and booleans as TOML has them.
std::string toml_text(const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  if (py::isinstance<py::int_>(value)) return py::str(value).cast<std::string>();
  const bool is_list =
      py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value) || py::isinstance<py::array>(value);
  if (!is_list) return py::repr(py::float_(py::reinterpret_borrow<py::object>(value))).cast<std::string>();
  std::string text = "[";
  for (const py::handle item : py::iter(value)) {
    const std::string one = toml_text(item);
    text += (text.size() > 1 ? ", " : "") + (py::isinstance<py::str>(item) ? quote_toml(one) : one);
  }
  return text + "]";
}

std::vector<Override> overrides_of(const py::dict& settings) {
  std::vector<Override> overrides;
  for (const auto& [key, value] : settings)
    overrides.push_back(parse_override(key.cast<std::string>() + "=" + toml_text(value)));
  return overrides;
}

// An array of numbers. The constructor that takes the numbers would make two arrays.
py::array_t<double> array_of_numbers(const double* values, py::ssize_t count) {
  py::array_t<double> array(count);
  std::copy_n(values, count, array.mutable_data());
  return array;
}

py::array_t<double> vector_of(const Vec3& v) {
  return array_of_numbers(v.data(), 3);
}

template <std::size_t N>
py::array_t<int> triangles_of(const std::vector<std::array<int, N>>& elements) {
  py::array_t<int> array({py::ssize_t(elements.size()), py::ssize_t(N)});
  int* to = array.mutable_data();
  for (const auto& element : elements) to = std::copy(element.begin(), element.end(), to);
  return array;
}

py::array_t<double> points_of(const std::vector<Vec3>& points) {
  py::array_t<double> array({py::ssize_t(points.size()), py::ssize_t(3)});
  double* to = array.mutable_data();
  for (const Vec3& point : points) to = std::copy_n(point.data(), 3, to);
  return array;
}

// Points and triangles (2D: segments) of a surface.
py::tuple mesh_of(const SurfaceMesh& mesh) {
  const bool flat = mesh.triangles.empty();
  return py::make_tuple(points_of(mesh.points),
                        flat ? triangles_of(mesh.segments).cast<py::object>() : triangles_of(mesh.triangles));
}

// Columns of a table as a dictionary of floating-point numbers.
void add_columns(const std::vector<TableColumn>& row, py::dict& values) {
  for (const TableColumn& column : row)
    values[column.name] = std::visit([](auto value) { return double(value); }, column.value);
}

py::dict solid_of(const SolidState& s) {
  py::dict solid;
  solid["name"] = s.name;
  solid["position"] = vector_of(s.position);
  solid["orientation"] = array_of_numbers(s.orientation.data(), 4);
  solid["velocity"] = vector_of(s.velocity);
  solid["angular_velocity"] = vector_of(s.angular_velocity);
  solid["force"] = vector_of(s.force);
  solid["torque"] = vector_of(s.torque);
  return solid;
}

// A read-only array on the values themselves.
py::array array_of(const FieldView& view, int dimension) {
  auto* owner = new std::shared_ptr<const void>(view.owner);
  const py::capsule keeps(owner, [](void* p) { delete static_cast<std::shared_ptr<const void>*>(p); });
  std::vector<py::ssize_t> shape(view.shape.begin(), view.shape.begin() + dimension), strides;
  for (int a = 0; a < dimension; ++a) strides.push_back(py::ssize_t(view.strides[std::size_t(a)] * sizeof(double)));
  py::array_t<double> array(shape, strides, view.first, keeps);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

// A scene with all values in SI units.
class PyScene {
 public:
  explicit PyScene(Scene scene) : scene_(std::move(scene)) {}
  const Scene& get() const { return scene_; }
  std::string text() const { return write_scene(scene_); }

 private:
  Scene scene_;
};

PyScene read_from(const Path& file, const py::dict& settings) {
  return PyScene(read_scene(file, overrides_of(settings)));
}

PyScene parse_from(const std::string& text, const Path& folder, const py::dict& settings) {
  return PyScene(parse_scene(text, "scene", folder, overrides_of(settings)));
}

class PySimulation {
 public:
  PySimulation(const PyScene& scene, std::optional<int> threads) : scene_(scene.get()) {
    if (threads && *threads < 1) throw Error(ExitCode::bad_input, "threads must be at least 1");
    if (threads) limit_ = std::make_unique<ThreadLimit>(*threads);
    declare_signals(scene_.signals);
    simulation_ = make_simulation(scene_, ranks());
  }

  double time() const { return simulation_->time(); }
  std::int64_t steps() const { return simulation_->step_count(); }
  py::dict stats() const {
    py::dict row;
    add_columns(columns_of(simulation_->stats()), row);
    return row;
  }

  // Signals and the interpreter's lock stay with other threads while a step runs.
  void step(std::optional<double> until) {
    const double end = until.value_or(scene_.time.end);
    if (!(end > time())) throw Error(ExitCode::bad_input, "until must be later than the simulation's time");
    py::gil_scoped_release others;
    simulation_->step(end);
  }

  std::int64_t run(std::optional<double> until, const py::object& callback) {
    const double end = until.value_or(scene_.time.end);
    std::int64_t count = 0;
    for (; time() < end; ++count) {
      step(end);
      if (!callback.is_none() && callback(py::cast(this)).is(py::bool_(false))) return count + 1;
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
    return count;
  }

  py::dict solids() const {
    py::dict all;
    for (const SolidState& solid : simulation_->solids()) all[py::str(solid.name)] = solid_of(solid);
    return all;
  }

  py::dict joints() const {
    py::dict all;
    for (const JointReport& joint : simulation_->joints()) {
      py::dict row;
      row["time"] = time();
      row["name"] = joint.name;
      add_columns(columns_of(joint), row);
      all[py::str(joint.name)] = row;
    }
    return all;
  }

  py::object probe(const std::string& name) const {
    const std::size_t k = index_of(scene_.probes, name, "probe");
    const ProbeSample sample = simulation_->probe(k);
    if (!sample.defined) return py::none();
    return sample.is_vector ? py::object(vector_of(sample.vector)) : py::object(py::float_(sample.value));
  }

  py::array field(const std::string& name) { return array_of(simulation_->view(name), scene_.dimension); }

  py::tuple solid_mesh(const std::string& name) const {
    return mesh_of(simulation_->solid_surface(index_of(scene_.solids, name, "solid")));
  }

  std::vector<std::string> warnings() { return simulation_->take_warnings(); }
  std::vector<std::string> describe() const { return simulation_->describe_start(); }

 private:
  template <class Spec>
  static std::size_t index_of(const std::vector<Spec>& specs, const std::string& name, const char* what) {
    for (std::size_t k = 0; k < specs.size(); ++k)
      if (specs[k].name == name) return k;
    throw py::key_error(std::string("there is no ") + what + " '" + name + "'");
  }

  Scene scene_;
  std::unique_ptr<ThreadLimit> limit_;
  std::unique_ptr<Simulation> simulation_;
};

void set_signal_or_throw(const std::string& name, double value) {
  if (!set_signal(name, value)) throw py::key_error("there is no signal '" + name + "' in the scene's [signals]");
}

// Drops of a frame as arrays: places and velocities (n, 3), radii and ids.
py::dict drops_of(const vdb::Frame& frame) {
  const auto count = py::ssize_t(frame.points.size());
  py::array_t<double> places({count, py::ssize_t(3)}), velocities({count, py::ssize_t(3)}), radii(count);
  py::array_t<std::int64_t> ids(count);
  for (py::ssize_t n = 0; n < count; ++n) {
    const vdb::Point& p = frame.points[std::size_t(n)];
    for (py::ssize_t a = 0; a < 3; ++a)
      places.mutable_at(n, a) = p.place[a], velocities.mutable_at(n, a) = p.velocity[a];
    radii.mutable_at(n) = p.radius;
    ids.mutable_at(n) = p.id;
  }
  py::dict drops;
  drops["place"] = places;
  drops["velocity"] = velocities;
  drops["radius"] = radii;
  drops["id"] = ids;
  return drops;
}

// Grids of a frame as arrays: level sets and scalars (nx, ny, nz), velocity (nx, ny, nz, 3).
py::dict read_frame(const Path& file) {
  const vdb::Frame frame = vdb::decode(file);
  py::dict grids;
  for (const vdb::Grid& grid : frame.grids) {
    const vdb::Block& block = grid.blocks.at(0);
    const py::ssize_t nx = block.upper[0], ny = block.upper[1], nz = block.upper[2], size = sizeof(float);
    const py::ssize_t width = grid.kind == vdb::GridKind::staggered_vector ? 3 : 1;
    auto* values = new std::vector<float>(block.values);
    const py::capsule keeps(values, [](void* p) { delete static_cast<std::vector<float>*>(p); });
    std::vector<py::ssize_t> shape{nx, ny, nz}, strides{width * size, nx * width * size, nx * ny * width * size};
    if (width == 3) shape.push_back(3), strides.push_back(size);
    grids[py::str(grid.name)] = py::array_t<float>(shape, strides, values->data(), keeps);
  }
  py::dict all;
  all["time"] = frame.time;
  all["frame"] = frame.number;
  all["dimension"] = frame.dimension;
  all["lower"] = vector_of(frame.lower);
  all["cell_size"] = frame.cell_size;
  all["grids"] = grids;
  all["drops"] = drops_of(frame);
  return all;
}

// The liquid's closed surface in a frame: points, triangles, velocity at the points.
py::tuple liquid_mesh_of(const Path& file) {
  const exporting::AttributedMesh liquid = exporting::liquid_mesh(vdb::decode(file));
  py::object velocity = py::none();
  for (const mesh::PointAttribute& attribute : liquid.attributes)
    if (attribute.name == "velocity")
      velocity =
          py::array_t<float>({py::ssize_t(attribute.values.size() / 3), py::ssize_t(3)}, attribute.values.data());
  return py::make_tuple(points_of(liquid.mesh.points), triangles_of(liquid.mesh.triangles), velocity);
}

py::dict materials() {
  py::dict all;
  for (const NamedMaterial& m : named_materials()) {
    py::dict one;
    one["density"] = m.density;
    if (m.viscosity > 0) one["viscosity"] = m.viscosity;
    if (m.surface_tension > 0) one["surface_tension"] = m.surface_tension;
    if (m.youngs_modulus > 0) one["youngs_modulus"] = m.youngs_modulus, one["poisson_ratio"] = m.poisson_ratio;
    one["source"] = m.source;
    all[py::str(m.name)] = one;
  }
  return all;
}

void add_scene(py::module_& m) {
  py::class_<PyScene>(m, "Scene", "A scene, read and checked; all values in SI units.")
      .def_static("read", &read_from, py::arg("file"), py::arg("set") = py::dict(),
                  "Reads a scene file. `set` overrides keys: {\"time.end\": 2.0}. Raises seiche.Error with a line for "
                  "each fault.")
      .def_static("parse", &parse_from, py::arg("text"), py::arg("folder") = Path("."), py::arg("set") = py::dict(),
                  "Reads a scene from a text; files that it names are looked for in `folder`.")
      .def_property_readonly("text", &PyScene::text, "The scene as TOML, every default written out.")
      .def_property_readonly("title", [](const PyScene& s) { return s.get().title; })
      .def_property_readonly("dimension", [](const PyScene& s) { return s.get().dimension; })
      .def_property_readonly(
          "end", [](const PyScene& s) { return s.get().time.end; }, "End time, s.")
      .def_property_readonly(
          "cell_size", [](const PyScene& s) { return s.get().domain.cell_size; }, "m")
      .def_property_readonly(
          "lower", [](const PyScene& s) { return vector_of(s.get().domain.lower); }, "m")
      .def_property_readonly(
          "upper", [](const PyScene& s) { return vector_of(s.get().domain.upper); }, "m");
}

void add_simulation(py::module_& m) {
  using S = PySimulation;
  py::class_<S>(m, "Simulation", "A scene that runs. It writes no files.")
      .def(py::init<const PyScene&, std::optional<int>>(), py::arg("scene"), py::arg("threads") = py::none(),
           "Sets the scene up at t = 0. `threads`: of this process; None: the machine's.")
      .def_property_readonly("time", &S::time, "Simulated time, s.")
      .def_property_readonly("step_count", &S::steps, "Steps so far.")
      .def_property_readonly("stats", &S::stats, "The present row of stats.csv, by column (docs/outputs.md).")
      .def_property_readonly(
          "solids", &S::solids,
          "By name: position (m), orientation (w, x, y, z), velocity, angular_velocity, force (N) and "
          "torque (N m) of the liquid on it.")
      .def_property_readonly("joints", &S::joints, "By name: the present rows of joints.csv.")
      .def("step", &S::step, py::arg("until") = py::none(),
           "Goes on by one step, which ends at `until` (s) at the latest; None: at the scene's end.")
      .def(
          "run", &S::run, py::arg("until") = py::none(), py::arg("callback") = py::none(),
          "Steps until a time (s). After each step calls callback(simulation), which may return False to stop. Returns "
          "the number of steps.")
      .def("field", &S::field, py::arg("name"),
           "surface (m, negative in the liquid), pressure (Pa) at cells; velocity_x, velocity_y, velocity_z (m/s) at "
           "faces. A read-only array on the simulation's own memory, indexed by x, y, z; it keeps the values of its "
           "moment. On several ranks it is this rank's block.")
      .def("probe", &S::probe, py::arg("name"), "Sample of a probe: a number, a vector, or None.")
      .def("solid_mesh", &S::solid_mesh, py::arg("name"), "Points (m) and triangles (2D: segments) of a solid.")
      .def(
          "set_signal", [](S&, const std::string& name, double value) { set_signal_or_throw(name, value); },
          py::arg("name"), py::arg("value"), "Sets a number of the scene's [signals] for the steps to come.")
      .def("describe", &S::describe, "Lines on the start: volumes, masses, draughts.")
      .def("take_warnings", &S::warnings, "Warnings since the last call.");
}

}  // namespace

PYBIND11_MODULE(seiche, m) {
  m.doc() = "Seiche: liquid among moving and deforming solids, from Python. See docs/python.md.";
  m.attr("__version__") = version();
  py::register_exception<Error>(m, "Error", PyExc_RuntimeError);
  add_scene(m);
  add_simulation(m);
  m.def(
      "read_frame", &read_frame, py::arg("file"),
      "Contents of a frame (.vdb): time, frame, lower, cell_size, grids as arrays indexed by x, y, z, and drops: their "
      "place, velocity, radius and id.");
  m.def("liquid_mesh", &liquid_mesh_of, py::arg("file"),
        "The liquid's closed surface in a frame of a 3D run: points (m), triangles, velocities at the points (m/s).");
  m.def("materials", &materials, "The table of named materials.");
  m.def(
      "rank", [] { return ranks().rank(); }, "This process's rank under mpirun, else 0.");
  m.def(
      "rank_count", [] { return ranks().size(); }, "Number of ranks.");
}

}  // namespace seiche
