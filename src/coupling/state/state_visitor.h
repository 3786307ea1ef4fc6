#pragma once
// Visitors of all data that a state keeps from step to step. One list serves saving, loading and the layout of
// checkpoints.
#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "coupling/state/flow.h"
#include "coupling/state/fluids.h"
#include "fluid/boundary/domain.h"

namespace seiche {

class StateVisitor {
 public:
  virtual ~StateVisitor() = default;
  virtual bool has(const std::string& /*name*/) const { return true; }  // false: no such number or vector to load
  virtual void number(const std::string& name, double& value) = 0;
  virtual void vector(const std::string& name, Eigen::VectorXd& value) = 0;  // keeps its size
};

// Visits fields, too.
template <int Dim>
class FieldVisitor : public StateVisitor {
 public:
  virtual bool loads() const = 0;                                                  // true if it sets what it visits
  virtual void numbers(const std::string& name, std::vector<double>& values) = 0;  // of any size
  // An array by site, within a box of indices. Entries must be exact as doubles.
  template <class Array>
  void field(const std::string& name, const Box<Dim>& box, Array& f) {
    using Value = std::decay_t<decltype(f[Site()])>;
    const auto set = [&](Site s, double x) {
      if constexpr (requires { f.set(s, Value(x)); })
        f.set(s, Value(x));
      else
        f[s] = Value(x);
    };
    values(
        name, box, [&](Site s) { return double(f[s]); }, set);
  }

 private:
  virtual void values(const std::string& name, const Box<Dim>& box, const std::function<double(Site)>& get,
                      const std::function<void(Site, double)>& set) = 0;
};

// Visits all three levels of a flow, as <prefix>now.u[x] and so on. A level that does not exist is saved as one at
// rest; only the first `levels` are loaded. Fills the ghosts of those. Collective.
template <int Dim>
void visit_flow(const Domain<Dim>& domain, const Fluids& fluids, const std::string& prefix, int levels, Flow<Dim>& flow,
                FieldVisitor<Dim>& visitor);

}  // namespace seiche
