// Bodies that nothing touches.
#include "solid/contact/path.h"
#include "solid/contact/system.h"

namespace seiche {
namespace contact {
namespace {

template <int Dim>
double heaviest_of(const Scene<Dim>& scene) {
  double mass = 0;
  for (std::size_t b = 0; b < scene.mass.size(); ++b)
    if (scene.moves(int(b))) mass = std::max(mass, scene.mass[b]);
  return mass > 0 ? mass : 1;
}

// Prescribed bodies start where they stand.
template <int Dim>
Velocities<Dim> still(const Scene<Dim>& scene, const Interval<Dim>& interval, Eigen::Index unknowns) {
  const bool led = std::any_of(interval.prescribed.begin(), interval.prescribed.end(),
                               [](const auto& twist) { return !twist.isZero(0); });
  return all_velocities<Dim>(scene, interval, Eigen::VectorXd::Zero(unknowns), led ? 0 : 1);
}

}  // namespace
}  // namespace contact

template <int Dim>
std::optional<ContactReport> report_without_contact(const ContactScene<Dim>& scene,
                                                    const std::vector<ContactMotion>& motions, double horizon,
                                                    double dt, const InertiaResponse& minimum,
                                                    const ContactOptions& options) {
  const contact::Scene<Dim>& data = scene.data();
  const contact::Interval<Dim> interval = contact::make_interval<Dim>(data, motions, horizon);
  const contact::Placement<Dim> from =
      contact::place<Dim>(data, interval, contact::still<Dim>(data, interval, minimum.velocity.size()));
  const contact::Walk<Dim> way = contact::walk<Dim>(
      data, interval, from, contact::all_velocities<Dim>(data, interval, minimum.velocity, 1), options.reach);
  if (way.share < 1) return std::nullopt;
  const double stiffness =
      contact::stiffness_for(contact::heaviest_of<Dim>(data) * options.acceleration, options.reach);
  const contact::Weights weights{dt, options.reach, stiffness, options.creep_speed};
  if (contact::contact_energy<Dim>(data, interval, way.end, way.near, {}, weights) > 0) return std::nullopt;
  ContactReport report;
  report.velocity = minimum.velocity;
  report.gradient = report.residual = minimum.gradient;
  report.smallest_gap = options.reach;
  report.stiffness = stiffness;
  report.impulses.resize(data.surfaces.size());
  return report;
}

template std::optional<ContactReport> report_without_contact<2>(const ContactScene<2>&,
                                                                const std::vector<ContactMotion>&, double, double,
                                                                const InertiaResponse&, const ContactOptions&);
template std::optional<ContactReport> report_without_contact<3>(const ContactScene<3>&,
                                                                const std::vector<ContactMotion>&, double, double,
                                                                const InertiaResponse&, const ContactOptions&);

}  // namespace seiche
