#include "scene/robots.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "base/scene.h"
#include "base/suggest.h"
#include "scene/options.h"
#include "scene/urdf.h"
#include "scene/values.h"

namespace seiche {
namespace {

namespace fs = std::filesystem;

constexpr double degrees_a_radian = 180 / std::numbers::pi;

LinkPlace root_place(const TransformSpec& t) {
  LinkPlace place = LinkPlace::Identity();
  place.linear() =
      Eigen::AngleAxisd(t.rotate.degrees / degrees_a_radian, t.rotate.axis.normalized()).toRotationMatrix();
  place.translation() = t.translate;
  return place;
}

TransformSpec transform_of(const LinkPlace& place) {
  TransformSpec t;
  const Eigen::AngleAxisd turn(place.linear());
  if (turn.angle() != 0) t.rotate = {turn.axis(), turn.angle() * degrees_a_radian};
  t.translate = place.translation();
  return t;
}

class RobotBuilder {
 public:
  RobotBuilder(SceneContext& context, const TomlNode& root, const RobotSpec& robot, std::size_t index, Scene& scene)
      : context_(context), root_(root), robot_(robot), index_(index), scene_(scene) {}

  void run() {
    if (context_.dimension != 3) return report("file", "a robot needs a scene with dimension = 3");
    const urdf::ModelInterfaceSharedPtr model = parse();
    if (!model) return;
    check_joint_names(*model);
    const auto links = links_of(*model);
    place_links(links);
    name_bodies(links);
    for (const urdf::LinkSharedPtr& link : links) add_solids(*link);
    for (const urdf::LinkSharedPtr& link : links)
      if (link->parent_joint) add_joint(*link->parent_joint);
    for (const urdf::LinkSharedPtr& link : links)
      if (link->parent_joint && link->parent_joint->mimic) add_gear(*link->parent_joint);
  }

 private:
  void report(const std::string& key, const std::string& text) const {
    const std::string path = fmt::format("robot.{}.{}", index_, key);
    context_.report(path, line_of(root_, path), fmt::format("robot \"{}\": {}", robot_.name, text));
  }

  std::string own(const std::string& name) const { return robot_.name + "/" + name; }

  urdf::ModelInterfaceSharedPtr parse() const {
    std::string fault;
    urdf::ModelInterfaceSharedPtr model = read_urdf(robot_.file, fault);
    if (!model) report("file", fault);
    return model;
  }

  void check_joint_names(const urdf::ModelInterface& model) const {
    std::vector<std::string> known;
    for (const auto& [name, joint] : model.joints_) known.push_back(name);
    for (const RobotJointSpec& joint : robot_.joints) {
      if (model.joints_.count(joint.name) > 0) continue;
      const auto near = suggest(joint.name, known);
      report("joint", fmt::format("{} has no joint \"{}\"; {}", robot_.file.filename().string(), joint.name,
                                  near ? "did you mean \"" + *near + "\"?" : "there is " + quoted_list(known)));
    }
  }

  const RobotJointSpec* given(const std::string& joint) const {
    const auto found = std::ranges::find(robot_.joints, joint, &RobotJointSpec::name);
    return found == robot_.joints.end() ? nullptr : &*found;
  }

  // Rad or m.
  double start_of(const urdf::Joint& joint) const {
    const RobotJointSpec* own = given(joint.name);
    if (!own) return 0;
    return joint.type == urdf::Joint::PRISMATIC ? own->start : own->start / degrees_a_radian;
  }

  // Motion of the child link by the parent link, from the joint's zero to its start.
  LinkPlace motion_of(const urdf::Joint& joint) const {
    LinkPlace motion = LinkPlace::Identity();
    const Vec3 axis = vector_of(joint.axis);
    if (axis.norm() == 0) return motion;
    if (joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS)
      motion.linear() = Eigen::AngleAxisd(start_of(joint), axis.normalized()).toRotationMatrix();
    if (joint.type == urdf::Joint::PRISMATIC) motion.translation() = start_of(joint) * axis.normalized();
    return motion;
  }

  void place_links(const std::vector<urdf::LinkSharedPtr>& links) {
    for (const urdf::LinkSharedPtr& link : links) {
      const urdf::JointSharedPtr& joint = link->parent_joint;
      if (!joint) {
        places_[link->name] = root_place(robot_.transform);
        continue;
      }
      frames_[joint->name] = places_.at(joint->parent_link_name) * place_of(joint->parent_to_joint_origin_transform);
      places_[link->name] = frames_[joint->name] * motion_of(*joint);
    }
  }

  // Solids of the links. Links without a shape belong to the link that holds them, the root to the first that it holds.
  void name_bodies(const std::vector<urdf::LinkSharedPtr>& links) {
    for (const urdf::LinkSharedPtr& link : links) {
      if (!shapes_of(*link).empty())
        bodies_[link->name] = own(link->name);
      else if (!link->parent_joint)
        bodies_[link->name] = robot_.base == RobotBase::fixed ? "world" : first_held(links);
      else if (is_welded(*link))
        bodies_[link->name] = bodies_.at(link->parent_joint->parent_link_name);
      else
        report("file", fmt::format("link \"{}\" moves, but has no collision or visual shape", link->name));
    }
  }

  std::string first_held(const std::vector<urdf::LinkSharedPtr>& links) const {
    for (const urdf::LinkSharedPtr& link : links) {
      bool held = link->parent_joint != nullptr;
      for (urdf::LinkSharedPtr up = link; held && up->parent_joint; up = up->getParent()) held = is_welded(*up);
      if (held && !shapes_of(*link).empty()) return own(link->name);
    }
    report("file", fmt::format("link \"{}\", the root, has no shape, nor has a link fixed to it; set base = \"fixed\"",
                               links.front()->name));
    return "world";
  }

  void add_solids(const urdf::Link& link) {
    const std::vector<LinkShape> shapes = shapes_of(link);
    for (std::size_t n = 0; n < shapes.size(); ++n) {
      SolidSpec solid;
      solid.kind = SolidKind::rigid;
      solid.name = n == 0 ? own(link.name) : fmt::format("{}.{}", own(link.name), n + 1);
      set_shape(link, shapes[n], solid.shape);
      set_mass(link, n, shapes.size(), solid.rigid);
      if (n > 0) weld(solid.name, own(link.name), places_.at(link.name).translation());
      scene_.solids.push_back(std::move(solid));
    }
    if (!shapes.empty() && !link.parent_joint && robot_.base == RobotBase::fixed)
      weld(own(link.name), "world", places_.at(link.name).translation());
  }

  void weld(const std::string& first, const std::string& second, const Vec3& at) {
    JointSpec joint;
    joint.name = first + " weld";
    joint.kind = JointKind::weld;
    joint.between = {first, second};
    joint.at = at;
    joint.where = robot_.where;
    scene_.joints.push_back(std::move(joint));
  }

  void set_shape(const urdf::Link& link, const LinkShape& from, ShapeSpec& shape) const {
    shape.where = robot_.where;
    shape.transform = transform_of(places_.at(link.name) * from.place);
    bool solid = true;
    if (const auto* box = dynamic_cast<const urdf::Box*>(from.geometry.get())) {
      shape.kind = "box";
      shape.upper = 0.5 * vector_of(box->dim);
      shape.lower = -shape.upper;
      solid = shape.upper.minCoeff() > 0;
    } else if (const auto* ball = dynamic_cast<const urdf::Sphere*>(from.geometry.get())) {
      shape.kind = "sphere";
      shape.radius = ball->radius;
      solid = shape.radius > 0;
    } else if (const auto* rod = dynamic_cast<const urdf::Cylinder*>(from.geometry.get())) {
      shape.kind = "cylinder";
      shape.radius = rod->radius;
      shape.to = Vec3(0, 0, 0.5 * rod->length);
      shape.from = -shape.to;
      solid = shape.radius > 0 && rod->length > 0;
    } else {
      set_mesh(link, dynamic_cast<const urdf::Mesh&>(*from.geometry), shape);
    }
    if (!solid) report("file", fmt::format("link \"{}\" has a {} without a size", link.name, shape.kind));
  }

  void set_mesh(const urdf::Link& link, const urdf::Mesh& mesh, ShapeSpec& shape) const {
    shape.kind = "mesh";
    shape.transform.scale = mesh.scale.x;
    if (mesh.scale.x <= 0 || mesh.scale.x != mesh.scale.y || mesh.scale.x != mesh.scale.z)
      report("file",
             fmt::format("link \"{}\" scales its mesh by axis or by a negative factor; write the mesh in its size",
                         link.name));
    const fs::path file = file_of(mesh.filename);
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
    if (ending != ".obj" && ending != ".ply" && ending != ".stl")
      report("file",
             fmt::format("link \"{}\": \"{}\" is no .obj, .ply or .stl file; convert it", link.name, mesh.filename));
    const std::string fault = fault_of_path(context_, file, shape.file);
    if (!fault.empty()) report("file", fmt::format("link \"{}\": {}", link.name, fault));
  }

  // Beside the robot's file, or for package://NAME/REST in a folder above it that holds REST or NAME/REST.
  fs::path file_of(const std::string& name) const {
    const std::string package = "package://", local = "file://";
    const fs::path folder = robot_.file.parent_path();
    if (name.starts_with(local)) return folder / name.substr(local.size());
    if (!name.starts_with(package)) return folder / name;
    const fs::path whole = name.substr(package.size());
    fs::path rest;
    for (auto part = std::next(whole.begin(), whole.empty() ? 0 : 1); part != whole.end(); ++part) rest /= *part;
    std::error_code ignored;
    for (fs::path above = folder;; above = above.parent_path()) {
      for (const fs::path& tried : {above / rest, above / whole})
        if (fs::exists(tried, ignored)) return tried;
      if (above == above.parent_path()) return folder / rest;
    }
  }

  // Further shapes of a link are a millionth of its mass each, so that the file's inertia is that of all.
  void set_mass(const urdf::Link& link, std::size_t shape, std::size_t shapes, RigidSpec& rigid) const {
    constexpr double small = 1e-6;
    if (!link.inertial || link.inertial->mass <= 0) {
      rigid.density = robot_.density.value_or(0);
      if (!robot_.density)
        report("density", fmt::format("link \"{}\" has no mass in the file; give density for such links", link.name));
      return;
    }
    const double mass = link.inertial->mass;
    rigid.mass = shape > 0 ? small * mass : mass * (1 - small * double(shapes - 1));
    if (shape > 0) return;
    const LinkPlace place = places_.at(link.name) * place_of(link.inertial->origin);
    rigid.center_of_mass = Vec3(place.translation());
    const auto& i = *link.inertial;
    const Eigen::Matrix3d own{{i.ixx, i.ixy, i.ixz}, {i.ixy, i.iyy, i.iyz}, {i.ixz, i.iyz, i.izz}};
    const std::string fault = fault_of_inertia(own);
    if (!fault.empty()) return report("file", fmt::format("link \"{}\": {}", link.name, fault));
    const Eigen::Matrix3d turned = place.linear() * own * place.linear().transpose();
    rigid.inertia = Vec3(turned.diagonal());
    rigid.products_of_inertia = Vec3(turned(0, 1), turned(0, 2), turned(1, 2));
  }

  void add_joint(const urdf::Joint& from) {
    const auto child = bodies_.find(from.child_link_name), parent = bodies_.find(from.parent_link_name);
    if (child == bodies_.end() || parent == bodies_.end() || child->second == parent->second) return;
    if (from.type == urdf::Joint::FLOATING) return;
    static const std::map<int, JointKind> kinds{{urdf::Joint::REVOLUTE, JointKind::hinge},
                                                {urdf::Joint::CONTINUOUS, JointKind::hinge},
                                                {urdf::Joint::PRISMATIC, JointKind::slider},
                                                {urdf::Joint::PLANAR, JointKind::planar},
                                                {urdf::Joint::FIXED, JointKind::weld}};
    const auto kind = kinds.find(from.type);
    if (kind == kinds.end()) return report("file", fmt::format("joint \"{}\" is of an unknown kind", from.name));
    JointSpec joint;
    if (const RobotJointSpec* own = given(from.name)) joint = own->forces;
    joint.name = own(from.name);
    joint.kind = kind->second;
    joint.between = {child->second, parent->second};
    joint.at = frames_.at(from.name).translation();
    joint.where = robot_.where;
    const LinkPlace& frame = frames_.at(from.name);
    if (joint.kind != JointKind::weld) joint.axis = frame.linear() * vector_of(from.axis);
    set_limits(from, joint);
    set_losses(from, joint);
    scene_.joints.push_back(std::move(joint));
  }

  // Limits from the place at the start, and the file's effort. A limit there gives way by a little: a stop has a gap.
  void set_limits(const urdf::Joint& from, JointSpec& joint) const {
    const bool turns = from.type == urdf::Joint::REVOLUTE;
    if (!from.limits || (!turns && from.type != urdf::Joint::PRISMATIC)) return;
    if (joint.motor && !joint.motor->most() && from.limits->effort > 0)
      (turns ? joint.motor->torque : joint.motor->force) = from.limits->effort;
    if (joint.limits) return;
    const double unit = turns ? degrees_a_radian : 1, give = turns ? 0.1 : 1e-4, start = start_of(from);
    const double low = unit * (from.limits->lower - start), high = unit * (from.limits->upper - start);
    if (low > give || high < -give)
      return report("joint",
                    fmt::format("joint \"{}\" starts at {:g}, which is not between its limits {:g} and {:g}; give "
                                "[[robot.joint]] with start",
                                from.name, unit * start, unit * from.limits->lower, unit * from.limits->upper));
    joint.limits = {{std::min(low, -give), std::max(high, give)}};
  }

  // Damping, and dry friction as a motor that resists all motion.
  static void set_losses(const urdf::Joint& from, JointSpec& joint) {
    const bool moves = joint.kind == JointKind::hinge || joint.kind == JointKind::slider;
    if (!from.dynamics || !moves) return;
    if (!joint.spring && from.dynamics->damping > 0) joint.spring.emplace().damping = from.dynamics->damping;
    if (joint.motor || joint.drive || !(from.dynamics->friction > 0)) return;
    JointMotorSpec& motor = joint.motor.emplace();
    motor.speed = "0";
    (joint.kind == JointKind::hinge ? motor.torque : motor.force) = from.dynamics->friction;
  }

  void add_gear(const urdf::Joint& from) {
    JointSpec joint;
    joint.name = own(from.name) + " gear";
    joint.kind = JointKind::gear;
    joint.between = {own(from.name), own(from.mimic->joint_name)};
    joint.ratio = from.mimic->multiplier;
    joint.where = robot_.where;
    scene_.joints.push_back(std::move(joint));
  }

  SceneContext& context_;
  const TomlNode& root_;
  const RobotSpec& robot_;
  std::size_t index_;
  Scene& scene_;
  std::map<std::string, LinkPlace> places_, frames_;  // of links, and of joints at their zero, in space
  std::map<std::string, std::string> bodies_;         // solid of each link, or "world"
};

template <class Item>
void check_unique(SceneContext& context, const TomlNode& root, const std::vector<Item>& items, const char* what) {
  std::map<std::string, int> count;
  for (const Item& item : items)
    if (++count[item.name] == 2)
      context.report(
          "robot", line_of(root, "robot"),
          fmt::format("a robot names a {} \"{}\", which there is already; rename the robot", what, item.name));
}

}  // namespace

void expand_robots(SceneContext& context, const TomlNode& root, Scene& scene) {
  if (scene.robots.empty() || !context.clean("robot")) return;
  for (std::size_t n = 0; n < scene.robots.size(); ++n) RobotBuilder(context, root, scene.robots[n], n, scene).run();
  check_unique(context, root, scene.solids, "solid");
  check_unique(context, root, scene.joints, "joint");
  scene.robots.clear();
}

}  // namespace seiche
