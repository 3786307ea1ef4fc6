#include "scene/urdf.h"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <urdf_parser/urdf_parser.h>

#include <fstream>
#include <sstream>

namespace seiche {
namespace {

// Keeps what the parser complains about.
class ParserMessages : public console_bridge::OutputHandler {
 public:
  ParserMessages() : before_(console_bridge::getOutputHandler()) { console_bridge::useOutputHandler(this); }
  ~ParserMessages() override { console_bridge::useOutputHandler(before_); }
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_WARN && first.empty()) first = text;
  }
  std::string first;

 private:
  console_bridge::OutputHandler* before_;
};

}  // namespace

urdf::ModelInterfaceSharedPtr read_urdf(const std::filesystem::path& file, std::string& fault) {
  constexpr std::uintmax_t most_bytes = 16 << 20;
  if (std::filesystem::file_size(file) > most_bytes) {
    fault = fmt::format("{} is larger than 16 MB", file.string());
    return nullptr;
  }
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  ParserMessages messages;
  urdf::ModelInterfaceSharedPtr model;
  try {
    model = urdf::parseURDF(text.str());
  } catch (const std::exception& error) {
    messages.first = error.what();
  }
  if (model && model->root_link_) return model;
  fault = fmt::format("{} is no robot in URDF: {}", file.filename().string(),
                      messages.first.empty() ? "it has no tree of links" : messages.first);
  return nullptr;
}

Vec3 vector_of(const urdf::Vector3& v) {
  return {v.x, v.y, v.z};
}

LinkPlace place_of(const urdf::Pose& pose) {
  LinkPlace place = LinkPlace::Identity();
  double x = 0, y = 0, z = 0, w = 1;
  pose.rotation.getQuaternion(x, y, z, w);
  place.linear() = Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
  place.translation() = vector_of(pose.position);
  return place;
}

std::vector<LinkShape> shapes_of(const urdf::Link& link) {
  std::vector<LinkShape> shapes;
  for (const auto& c : link.collision_array)
    if (c && c->geometry) shapes.push_back({c->geometry, place_of(c->origin)});
  for (const auto& v : link.visual_array)
    if (link.collision_array.empty() && v && v->geometry) shapes.push_back({v->geometry, place_of(v->origin)});
  return shapes;
}

bool is_welded(const urdf::Link& link) {
  return link.parent_joint && link.parent_joint->type == urdf::Joint::FIXED;
}

std::vector<urdf::LinkSharedPtr> links_of(const urdf::ModelInterface& model) {
  std::vector<urdf::LinkSharedPtr> links{model.root_link_};
  for (std::size_t n = 0; n < links.size(); ++n)
    for (const urdf::LinkSharedPtr& child : urdf::LinkSharedPtr(links[n])->child_links) links.push_back(child);
  return links;
}

}  // namespace seiche
