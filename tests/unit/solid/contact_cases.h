#pragma once
// Time steps of dry rigid bodies, and simple closed surfaces, for the tests of contact.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "solid/contact/contact.h"

namespace seiche::contact_cases {

template <int Dim>
using TwistVector = Eigen::Matrix<double, twist_size<Dim>, 1>;

// A box of the given sides about the origin (2D: a rectangle).
template <int Dim>
SurfaceMesh box(const Vec3& sides) {
  SurfaceMesh m;
  for (int i = 0; i < (Dim == 2 ? 4 : 8); ++i)
    m.points.push_back(0.5 * sides.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, Dim == 2 ? 0 : (i & 4 ? 1 : -1))));
  if (Dim == 2) m.segments = {{0, 1}, {1, 3}, {3, 2}, {2, 0}};
  if (Dim == 3)
    m.triangles = {{0, 3, 1}, {0, 2, 3}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                   {2, 7, 3}, {2, 6, 7}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return m;
}

inline SurfaceMesh polygon(double radius, int corners) {
  SurfaceMesh m;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * 3.14159265358979323846 * i / corners;
    m.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    m.segments.push_back({i, (i + 1) % corners});
  }
  return m;
}

inline SurfaceMesh icosphere(double radius, int splits) {
  const double g = 0.5 * (1 + std::sqrt(5.));
  SurfaceMesh m;
  m.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
              {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  m.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                 {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                 {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int split = 0; split < splits; ++split) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [place, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<int>(m.points.size()));
      if (fresh) m.points.push_back(0.5 * (m.points[a] + m.points[b]));
      return place->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : m.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    m.triangles = finer;
  }
  for (Vec3& p : m.points) p = radius * p.normalized();
  return m;
}

// Flips the surface: inside and outside are swapped.
inline SurfaceMesh inverted(SurfaceMesh m) {
  for (auto& t : m.triangles) std::swap(t[1], t[2]);
  for (auto& s : m.segments) std::swap(s[0], s[1]);
  return m;
}

template <int Dim>
struct DryBody {
  ContactBody contact;
  Pose pose;
  TwistVector<Dim> velocity = TwistVector<Dim>::Zero();
  Vec3 inertia{1, 1, 1};  // principal, at rest along the axes
};

template <int Dim>
struct DryWorld {
  std::vector<DryBody<Dim>> bodies;
  std::vector<ContactWall> walls;
  Vec3 gravity{0, 0, 0};
  ContactOptions options;
  ContactReport report;  // of the last step
  int newton_iterations = 0, solves = 0;

  // A box of uniform density (kg/m^3, kg/m^2) about `center`.
  DryBody<Dim>& add_box(const Vec3& sides, const Vec3& center, double density) {
    const double mass = density * sides.head<Dim>().prod();
    const Vec3 s = sides.cwiseAbs2();
    return add(box<Dim>(sides), center, mass, mass / 12 * Vec3(s[1] + s[2], s[0] + s[2], s[0] + s[1]));
  }
  DryBody<Dim>& add(const SurfaceMesh& surface, const Vec3& center, double mass, const Vec3& inertia) {
    DryBody<Dim> b;
    b.contact = {surface, BodyControl::free, mass, {}, ""};
    b.pose.displacement = center;
    b.inertia = inertia;
    bodies.push_back(b);
    scene_.reset();
    return bodies.back();
  }

  // One step: forces, then contact over dt, then the new poses. `ends`: poses of the prescribed bodies at the end.
  void step(double dt, const std::map<int, Pose>& ends = {}) {
    std::vector<ContactMotion> motions;
    for (size_t b = 0; b < bodies.size(); ++b)
      motions.push_back({bodies[b].pose, ends.count(b) ? ends.at(b) : bodies[b].pose});
    DryProblem inertia = problem(dt);
    report = solve_contact<Dim>(scene(), motions, dt, dt, inertia, options);
    INFO(report.failure);
    REQUIRE(report.failure.empty());
    newton_iterations += report.newton_iterations;
    solves += report.solves;
    int place = 0;
    for (size_t b = 0; b < bodies.size(); ++b) {
      bodies[b].pose = motions[b].end;
      if (bodies[b].contact.control == BodyControl::prescribed) continue;
      bodies[b].velocity = report.velocity.template segment<twist_size<Dim>>(place);
      bodies[b].pose = moved_pose<Dim>(motions[b].start, bodies[b].velocity, dt);
      place += twist_size<Dim>;
    }
  }

  const ContactScene<Dim>& scene() {
    if (scene_) return *scene_;
    std::vector<ContactBody> list;
    for (const DryBody<Dim>& b : bodies) list.push_back(b.contact);
    scene_ = std::make_shared<ContactScene<Dim>>(list, walls);
    return *scene_;
  }

  DryProblem problem(double dt) const {
    constexpr int n = twist_size<Dim>;
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<double> target;
    for (const DryBody<Dim>& b : bodies) {
      if (b.contact.control == BodyControl::prescribed) continue;
      const int begin = static_cast<int>(target.size());
      TwistVector<Dim> v = b.velocity;
      v.template head<Dim>() += dt * gravity.template head<Dim>();
      const Eigen::Matrix3d I = b.pose.rotation * b.inertia.asDiagonal() * b.pose.rotation.transpose();
      for (int i = 0; i < Dim; ++i) entries.emplace_back(begin + i, begin + i, b.contact.mass);
      for (int i = 0; i < n - Dim; ++i)
        for (int j = 0; j < n - Dim; ++j)
          entries.emplace_back(begin + Dim + i, begin + Dim + j, Dim == 2 ? I(2, 2) : I(i, j));
      target.insert(target.end(), v.data(), v.data() + n);
    }
    const int size = static_cast<int>(target.size());
    Eigen::SparseMatrix<double> mass(size, size);
    mass.setFromTriplets(entries.begin(), entries.end());
    return DryProblem(mass, Eigen::Map<Eigen::VectorXd>(target.data(), size));
  }

 private:
  std::shared_ptr<ContactScene<Dim>> scene_;
};

}  // namespace seiche::contact_cases
