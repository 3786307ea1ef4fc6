// Enclosed air: each region of air without a way out has one pressure, which keeps its volume.
#include <numeric>

#include "coupling/exterior/exteriors.h"
#include "coupling/state/state.h"
#include "coupling/transport/air_volume.h"

namespace seiche {
namespace {

template <int Dim>
class EnclosedAir : public Exterior<Dim> {
 public:
  explicit EnclosedAir(const Layout<Dim>& layout) { air_.label = CellField<Dim, std::int64_t>(layout, no_air); }
  std::unique_ptr<Exterior<Dim>> copy() const override { return std::make_unique<EnclosedAir>(*this); }

  void start(const Domain<Dim>& domain, const Fluids&, const Solids<Dim>&, const StepGeometry<Dim>& g,
             const CellField<Dim>& phi, FaceField<Dim>&, std::string&) override {
    air_ = initial_air(domain, g, phi);
  }

  void follow(const Domain<Dim>& domain, const StepGeometry<Dim>& g, const FaceField<Dim>& u, double dt,
              const CellField<Dim>& phi) override {
    air_ = follow_air(domain, air_, u, dt, g, phi, lost_);
  }

  double control_volume(const Domain<Dim>& domain, const StepGeometry<Dim>& g, double expected, double limit,
                        CellField<Dim>& phi) override {
    return control_volumes(domain, g, expected, limit, air_, phi);
  }

  void weigh(const Domain<Dim>& domain, const StepGeometry<Dim>& g, const CellField<Dim>& phi,
             const CellField<Dim>& share, const Room<Dim>& room) override {
    air_.excess = excess_of_air(domain, g, phi, share, room, air_);
  }

  void set_rows(const Fluids&, const OperatorPerturbation&, ProjectionInput<Dim>& in) const override {
    in.air = &air_;
    if (in.share) in.air_inflow = inflow_of_air(in, air_);
  }

  bool has_pressure(Site cell) const override { return air_.label[cell] >= 0; }

  void measure(const Domain<Dim>& domain, const NodeField<Dim>& psi, const CellField<Dim>& phi,
               StepStats& stats) const override {
    const std::vector<double> volumes = air_volumes(domain, air_, psi, phi);
    // Regions whose air lies in cut cells, inside the solid, have no volume.
    stats.bubbles = std::count_if(volumes.begin(), volumes.end() - 1, [](double v) { return v > 0; });
    stats.gas_volume = std::accumulate(volumes.begin(), volumes.end() - 1, 0.0);
    if (!air_.excess.empty())
      stats.gas_volume = std::accumulate(air_.volume.begin(), air_.volume.end(), 0.0) +
                         std::accumulate(air_.excess.begin(), air_.excess.end(), 0.0);
    stats.air_lost = lost_;
  }

  void visit(const Domain<Dim>& domain, const Fluids&, int, FieldVisitor<Dim>& visitor) override {
    visitor.field("air", domain.layout.cells(), air_.label);
    visitor.numbers("air.volume", air_.volume);
    if (visitor.has("air.excess")) visitor.numbers("air.excess", air_.excess);  // not in earlier checkpoints
    visitor.number("air.lost", lost_);
    if (visitor.loads()) domain.halo.fill_ghosts({air_.label.data()});
  }

 private:
  AirRegions<Dim> air_;
  double lost_ = 0;  // volume of vanished regions too small for the grid, m^Dim
};

}  // namespace

template <int Dim>
std::unique_ptr<Exterior<Dim>> enclosed_air(const Domain<Dim>& domain) {
  return std::make_unique<EnclosedAir<Dim>>(domain.layout);
}

template std::unique_ptr<Exterior<2>> enclosed_air<2>(const Domain<2>&);
template std::unique_ptr<Exterior<3>> enclosed_air<3>(const Domain<3>&);

}  // namespace seiche
