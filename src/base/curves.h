#pragma once
// Curves: functions of one number that a scene gives by points, for formulas: name(t). They belong to the process;
// formulas keep the curves that were declared when they were parsed.
#include <map>
#include <string>
#include <vector>

namespace seiche {

enum class CurveForm { smooth, linear };

// Passes through (times[n], values[n]); constant before the first and after the last. Times ascend. Smooth: cubic
// pieces with a continuous slope that do not overshoot between points: F. Fritsch, J. Butland, A method for
// constructing local monotone piecewise cubic interpolants, SIAM J. Sci. Stat. Comput. 5 (1984).
struct TimeCurve {
  std::vector<double> times, values;
  CurveForm form = CurveForm::smooth;
  std::vector<double> slopes{};  // at the points, of smooth ones; set_slopes() fills them

  void set_slopes();
  double operator()(double t) const;
};

// Replaces the curves that formulas may use.
void declare_curves(const std::map<std::string, TimeCurve>& curves);

// Declared curves by name; they stay where they are for the life of the process.
std::map<std::string, const TimeCurve*> declared_curves();

}  // namespace seiche
