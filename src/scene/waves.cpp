#include "scene/waves.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "base/gravity.h"
#include "base/scene.h"
#include "scene/checks.h"

namespace seiche {
namespace {

constexpr double two_pi = 2 * M_PI;
constexpr const char* needs_constant_gravity = "waves need gravity that does not change in time; give it numbers";

// Amplitudes of the paddle for those of the waves.
std::vector<PaddleTerm> irregular_terms(const WavesSpec& waves, double gravity) {
  std::vector<PaddleTerm> terms = irregular_waves(waves);
  for (PaddleTerm& term : terms)
    term.amplitude /= height_over_stroke(waves.paddle, waves.depth * wave_number(term.frequency, gravity, waves.depth));
  return terms;
}

// The second harmonic of a piston that makes Stokes waves of second order without free waves at 2 w: Madsen, On the
// generation of long waves, J. Geophys. Res. 76 (1971).
PaddleTerm second_harmonic(const WavesSpec& waves, double frequency, double kh) {
  const double ratio = height_over_stroke("piston", kh), e = std::exp(-2 * kh);
  const double amplitude = waves.height * waves.height / (32 * waves.depth) *
                           (12 * e * (1 + e) / std::pow(1 - e, 3) - 2 / ratio);  // 3 cosh kh / sinh^3 kh
  return {amplitude, 2 * frequency, 0};
}

std::string sum_of(const std::vector<PaddleTerm>& terms, double factor) {
  std::string sum;
  for (const PaddleTerm& term : terms)
    sum += fmt::format("{}{:.9g}*sin({:.9g}*t+{:.9g})", sum.empty() ? "" : "+", factor * term.amplitude, term.frequency,
                       term.phase);
  return sum;
}

std::string with_ramp(const std::string& sum, double ramp) {
  if (ramp == 0) return sum;
  return fmt::format("(t<{0:.9g}?0.5-0.5*cos({1:.9g}*t):1)*({2})", ramp, M_PI / ramp, sum);
}

// Waves of this height break; empty: they do not.
std::string fault_of_height(const WavesSpec& waves, double gravity) {
  if (waves.height > 0.78 * waves.depth)  // McCowan's limit of solitary waves
    return fmt::format("waves {:g} m high break in {:g} m of depth; their height is at most 0.78 of it", waves.height,
                       waves.depth);
  const double k = wave_number(two_pi / waves.period, gravity, waves.depth), length = two_pi / k;
  const double steepest = steepest_wave(k * waves.depth);
  if (waves.spectrum.empty() && waves.height > steepest * length)
    return fmt::format("waves {:g} m high and {:.4g} m long break; their height is at most {:.4g} m", waves.height,
                       length, steepest * length);
  return {};
}

// Theories of nonlinear waves hold no longer; empty: they do.
std::string fault_of_theory(const WavesSpec& waves, const WaveTrain& train) {
  constexpr double most_second = 0.25, most_last = 1e-3, ripple = 1e-3;  // of a_1, of a_1, of the height
  const std::vector<WaveMode>& modes = train.modes;
  const double a = modes.front().elevation, last = modes.back().elevation;
  const auto fault = [&](const std::string& why) {
    return fmt::format("waves {:g} m high with a period of {:g} s in {:g} m of depth are beyond theory = \"{}\": {}",
                       waves.height, waves.period, waves.depth, waves.theory, why);
  };
  if (waves.theory == "stokes" && last > most_second * a)
    return fault(
        fmt::format("its second harmonic has {:.2g} of the first, more than a quarter; lower the height or the "
                    "period, or take theory = \"nonlinear\" at a side",
                    last / a));
  if (waves.theory != "nonlinear" || waves.height == 0) return {};
  if (std::abs(last) > most_last * a)
    return fault(
        fmt::format("its last mode still has {:.2g} of the first; lower the height or the period", std::abs(last) / a));
  constexpr int places = 200;  // from crest to trough
  for (int n = 0; n < places; ++n) {
    const double s = M_PI / modes.front().number / places, from = -M_PI / 2 / modes.front().number;
    if (train.elevation(from + (n + 1) * s, 0) > train.elevation(from + n * s, 0) + ripple * waves.height)
      return fault("its surface rises between crest and trough; lower the height or the period");
  }
  return {};
}

bool is_horizontal(const Vec3& direction, const Vec3& up) {
  constexpr double level = 1e-6;  // of |direction|, off the horizontal
  return direction.norm() > 0 && std::abs(direction.normalized().dot(up)) <= level;
}

class Expansion {
 public:
  Expansion(SceneContext& context, const TomlNode& root, const Scene& scene) : context_(context), root_(root) {
    const Vec3 g = Gravity(scene.gravity).at(0);
    gravity_ = g.norm();
    is_constant_ = VectorExpression(scene.gravity.formula).is_constant();
    up_ = gravity_ > 0 ? Vec3(-g / gravity_) : Vec3::UnitY();
    dimension_ = scene.dimension;
  }

  void apply(const std::string& path, MotionSpec& motion) const {
    const WavesSpec waves = *std::exchange(motion.waves, std::nullopt);
    const std::string fault = fault_of(waves);
    if (!fault.empty()) return context_.report(path, line_of(root_, path), path + ": " + fault);
    const Vec3 ahead = waves.direction.normalized();
    const std::vector<PaddleTerm> terms = paddle_terms(waves, gravity_);
    const double ramp = waves.ramp.value_or(2 * waves.period);
    if (waves.paddle == "piston") {
      for (int a = 0; a < 3; ++a)
        motion.translate[std::size_t(a)] = ahead[a] == 0 ? "0" : with_ramp(sum_of(terms, ahead[a]), ramp);
      return;
    }
    const Vec3 axis = up_.cross(ahead);  // turns up towards the direction
    motion.center = *waves.hinge;
    motion.axis = dimension_ == 2 ? Vec3::UnitZ() : axis;
    const double sign = dimension_ == 2 ? axis[2] : 1;
    motion.degrees =
        fmt::format("{:.9g}*atan(({})/{:.9g})", sign * 180 / M_PI, with_ramp(sum_of(terms, 1), ramp), waves.depth);
  }

 private:
  std::string fault_of(const WavesSpec& waves) const {
    const bool is_flap = waves.paddle == "flap";
    if (!is_constant_) return needs_constant_gravity;
    if (gravity_ == 0) return "waves need gravity";
    if (!is_horizontal(waves.direction, up_)) return "direction must be horizontal";
    if (is_flap && !waves.hinge) return "a flap needs its hinge, a point of its axis at the bottom";
    if (!is_flap && waves.hinge) return "a piston has no hinge";
    if (waves.theory == "stokes" && (is_flap || !waves.spectrum.empty()))
      return "theory = \"stokes\" is for regular waves of a piston";
    const std::string fault = fault_of_height(waves, gravity_);
    return fault.empty() && waves.theory == "stokes" ? fault_of_theory(waves, wave_train(waves, gravity_)) : fault;
  }

  SceneContext& context_;
  const TomlNode& root_;
  Vec3 up_;
  double gravity_ = 0;
  bool is_constant_ = true;
  int dimension_ = 3;
};

// Features that have no place beside waves at sides, or "".
std::string excluded_by_waves(const Scene& scene) {
  if (scene.gas.present && !scene.gas.flows())
    return "waves at sides change the volume of enclosed air, which bubbles = \"volume_conserving\" keeps; take "
           "\"resolved\", or leave [gas] out";
  if (scene.liquid.prescribed_velocity) return "liquid.prescribed_velocity leaves no flow to solve for; remove it";
  return {};
}

// Fault of waves at the side along an axis, or "".
std::string fault_of_side(const Scene& scene, const SideWavesSpec& waves, int axis) {
  const Vec3 g = Gravity(scene.gravity).at(0);
  if (!VectorExpression(scene.gravity.formula).is_constant()) return needs_constant_gravity;
  if (!(g.norm() > 0)) return "waves need gravity";
  Eigen::Index vertical = 1;
  if (g.cwiseAbs().maxCoeff(&vertical) < g.norm() * (1 - 1e-12)) return "waves at sides need gravity along an axis";
  const Vec3 up = -g / g.norm();
  if (vertical == axis) return "waves pass upright sides alone, those along which gravity acts";
  if (waves.towards && !is_horizontal(*waves.towards, up)) return "direction must be horizontal";
  const double sign = up[vertical], low = scene.domain.lower[vertical], high = scene.domain.upper[vertical];
  const double level = waves.level.value_or(sign > 0 ? low + waves.depth : high - waves.depth);
  if (level <= low || level >= high)
    return fmt::format("the level of rest, {:g} m, lies outside of the domain, {:g} to {:g} m; change depth or level",
                       level, low, high);
  if (waves.height == 0 && !waves.absorbs) return "height = 0 with absorbs = false is a wall; give a height";
  if (waves.theory != "airy" && !waves.spectrum.empty())
    return "theory = \"" + waves.theory + "\" is for regular waves; a spectrum is of linear ones";
  if (std::string fault = fault_of_height(waves, g.norm()); !fault.empty()) return fault;
  return excluded_by_waves(scene);
}

// Under a closed lid gas must have room to flow back above the crests: two cells. Fault, or "".
std::string fault_of_lid(const Scene& scene, const SideWavesSpec& waves, const WaveTrain& train) {
  constexpr double least_cells = 2;
  const Vec3 up = -Gravity(scene.gravity).at(0);
  Eigen::Index vertical = 1;
  up.cwiseAbs().maxCoeff(&vertical);
  const bool upwards = up[vertical] > 0;
  const DomainSpec& d = scene.domain;
  if (!scene.gas.flows() || d.sides[std::size_t(vertical)][upwards ? 1 : 0].type == SideType::outflow) return {};
  double crest = waves.height;  // of a spectrum: the significant height
  if (waves.spectrum.empty()) {
    crest = 0;
    for (const WaveMode& mode : train.modes) crest += std::abs(mode.elevation);
  }
  const double lid = d.upper[vertical] - d.lower[vertical];
  const double rest = !waves.level ? waves.depth
                      : upwards    ? *waves.level - d.lower[vertical]
                                   : d.upper[vertical] - *waves.level;
  const double left = lid - rest - crest;
  if (left >= least_cells * d.cell_size) return {};
  return fmt::format(
      "crests leave {:.3g} m below the closed lid, less than two cells for [gas] to flow back through; "
      "raise the lid, or make it \"outflow\"",
      left);
}

}  // namespace

double height_over_stroke(const std::string& paddle, double kh) {
  // sinh and cosh over exp(kh), so that deep liquid does not overflow
  const double e = std::exp(-2 * kh), sinh = (1 - e) / 2, cosh = (1 + e) / 2;
  const double sum = 2 * sinh * cosh + 2 * kh * e;       // (sinh 2kh + 2kh) exp(-2kh)
  if (paddle == "piston") return 4 * sinh * sinh / sum;  // 2 (cosh 2kh - 1) = 4 sinh^2 kh
  return 4 * sinh / kh * (kh * sinh - cosh + std::exp(-kh)) / sum;
}

std::vector<PaddleTerm> paddle_terms(const WavesSpec& waves, double gravity) {
  if (!waves.spectrum.empty()) return irregular_terms(waves, gravity);
  const double w = two_pi / waves.period, kh = waves.depth * wave_number(w, gravity, waves.depth);
  std::vector<PaddleTerm> terms{{waves.height / 2 / height_over_stroke(waves.paddle, kh), w, 0}};
  if (waves.theory == "stokes") terms.push_back(second_harmonic(waves, w, kh));
  return terms;
}

void expand_waves(SceneContext& context, const TomlNode& root, Scene& scene) {
  const Expansion expansion(context, root, scene);
  const auto apply = [&](const std::string& path, MotionSpec& motion) {
    if (motion.waves) expansion.apply(path + ".motion.waves", motion);
  };
  for (std::size_t k = 0; k < scene.solids.size(); ++k) {
    SolidSpec& solid = scene.solids[k];
    apply(fmt::format("solid.{}", k), solid.motion);
    for (std::size_t n = 0; n < solid.elastic.pinned.size(); ++n)
      apply(fmt::format("solid.{}.pinned.{}", k, n), solid.elastic.pinned[n].motion);
  }
}

void check_side_waves(SceneContext& context, const TomlNode& root, const Scene& scene) {
  for (int axis = 0; axis < scene.dimension; ++axis)
    for (const int side : {0, 1}) {
      const SideSpec& spec = scene.domain.sides[std::size_t(axis)][std::size_t(side)];
      if (spec.type != SideType::waves) continue;
      const std::string path = fmt::format("domain.boundary.{}_{}.waves", "xyz"[axis], side == 0 ? "lower" : "upper");
      std::string fault = fault_of_side(scene, spec.waves, axis);
      try {
        if (fault.empty()) {
          const WaveTrain train = wave_train(spec.waves, Gravity(scene.gravity).at(0).norm());
          fault = fault_of_theory(spec.waves, train);
          if (fault.empty()) fault = fault_of_lid(scene, spec.waves, train);
        }
      } catch (const Error& error) {
        fault = error.what();
      }
      if (!fault.empty()) context.report(path, line_of(root, path), path + ": " + fault);
    }
}

}  // namespace seiche
