#include "scene/waves.h"

#include <fmt/format.h>

#include <cmath>
#include <random>

#include "base/gravity.h"
#include "base/scene.h"
#include "scene/checks.h"

namespace seiche {
namespace {

constexpr double two_pi = 2 * M_PI;

// Variance density of a spectrum at r = f / f_p, up to a factor. Hasselmann et al., Measurements of wind-wave growth
// (JONSWAP, 1973); peakedness 1 is the spectrum of Pierson and Moskowitz (1964).
double spectral_shape(double r, double peakedness) {
  const double width = r <= 1 ? 0.07 : 0.09;
  return std::pow(r, -5) * std::exp(-1.25 * std::pow(r, -4)) *
         std::pow(peakedness, std::exp(-std::pow((r - 1) / width, 2) / 2));
}

// Equally likely in [0, 1), the same on all machines.
double draw(std::mt19937& random) {
  return double(random()) / 4294967296.0;
}

// Bands of equal width from 0.5 to 2.5 f_p, a component at a random place of each, so that the sum does not repeat.
// Amplitudes a with sum a^2 / 2 = (H_s / 4)^2.
std::vector<PaddleTerm> irregular_terms(const WavesSpec& waves, double gravity) {
  constexpr double lowest = 0.5, highest = 2.5;  // f / f_p; they hold 98 % of the variance
  const double peakedness = waves.spectrum == "jonswap" ? waves.peakedness : 1;
  std::mt19937 random(std::uint32_t(waves.seed));
  std::vector<PaddleTerm> terms;
  double variance = 0;
  for (int n = 0; n < waves.components; ++n) {
    const double r = lowest + (highest - lowest) * (n + draw(random)) / waves.components;
    const double density = spectral_shape(r, peakedness);
    terms.push_back({std::sqrt(2 * density), two_pi * r / waves.period, two_pi * draw(random)});
    variance += density;
  }
  for (PaddleTerm& term : terms) {
    const double kh = waves.depth * wave_number(term.frequency, gravity, waves.depth);
    const double wave = term.amplitude * waves.height / 4 / std::sqrt(variance);
    term.amplitude = wave / height_over_stroke(waves.paddle, kh);  // a of the wave: H/2; of the paddle: S/2
  }
  return terms;
}

// The second harmonic of a piston that makes Stokes waves of second order without free waves at 2 w: Madsen, On the
// generation of long waves, J. Geophys. Res. 76 (1971).
PaddleTerm second_harmonic(const WavesSpec& waves, double frequency, double kh) {
  const double ratio = height_over_stroke("piston", kh), sinh = std::sinh(kh);
  const double amplitude =
      waves.height * waves.height / (32 * waves.depth) * (3 * std::cosh(kh) / (sinh * sinh * sinh) - 2 / ratio);
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

class Expansion {
 public:
  Expansion(SceneContext& context, const TomlNode& root, const Scene& scene) : context_(context), root_(root) {
    const Vec3 g = Gravity(scene.gravity).at(0);
    gravity_ = g.norm();
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
    constexpr double level = 1e-6;  // of |direction|, off the horizontal
    const bool is_flap = waves.paddle == "flap";
    if (gravity_ == 0) return "waves need gravity";
    if (!(waves.direction.norm() > 0) || std::abs(waves.direction.normalized().dot(up_)) > level)
      return "direction must be horizontal";
    if (is_flap && !waves.hinge) return "a flap needs its hinge, a point of its axis at the bottom";
    if (!is_flap && waves.hinge) return "a piston has no hinge";
    if (waves.theory == "stokes" && (is_flap || !waves.spectrum.empty()))
      return "theory = \"stokes\" is for regular waves of a piston";
    if (waves.height > 0.78 * waves.depth)  // McCowan's limit of solitary waves
      return fmt::format("waves {:g} m high break in {:g} m of depth; their height is at most 0.78 of it", waves.height,
                         waves.depth);
    const double k = wave_number(two_pi / waves.period, gravity_, waves.depth), length = two_pi / k;
    const double steepest = 0.142 * std::tanh(k * waves.depth);  // H over length, Miche (1944)
    if (waves.spectrum.empty() && waves.height > steepest * length)
      return fmt::format("waves {:g} m high and {:.4g} m long break; their height is at most {:.4g} m", waves.height,
                         length, steepest * length);
    return {};
  }

  SceneContext& context_;
  const TomlNode& root_;
  Vec3 up_;
  double gravity_ = 0;
  int dimension_ = 3;
};

}  // namespace

// Newton's method from the limit of deep or shallow liquid, whichever has the larger k.
double wave_number(double w, double gravity, double depth) {
  const double deep = w * w / gravity;
  double k = std::max(deep, w / std::sqrt(gravity * depth));
  for (int n = 0; n < 50; ++n) {
    const double t = std::tanh(k * depth), f = k * t - deep, slope = t + k * depth * (1 - t * t);
    const double change = f / slope;
    k -= change;
    if (std::abs(change) < 1e-15 * k) break;
  }
  return k;
}

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

}  // namespace seiche
