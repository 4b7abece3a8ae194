#include "acceleration_quantity.hpp"

#include <culm/base/absent.hpp>

#include "place.hpp"

#include <optional>

namespace culm::simulation {
namespace {

// The mean over a step, v_1 - v_0 over its length: by it momenta change in the conserving scheme.
class Acceleration final : public Quantity {
 public:
  explicit Acceleration(const Place& place) : place_(place) {}

  std::vector<output::HistoryColumn> columns() const override {
    return {{"ax", "m/s^2"}, {"ay", "m/s^2"}, {"az", "m/s^2"}};
  }

  // states come in the order of time; one that does not follow has no step
  void evaluate(const assembly::System&, const model::State& state,
                std::vector<double>& numbers) const override {
    const Vec3 velocity = place_.seen_velocity(state);
    if (!last_ || state.time < last_->time || !state.in_motion) {
      mean_ = Vec3::Constant(absent);
    } else if (state.time > last_->time) {
      mean_ = (velocity - last_->velocity) / (state.time - last_->time);
    }
    last_.reset();
    if (state.in_motion) last_ = {state.time, velocity};
    numbers.insert(numbers.end(), mean_.begin(), mean_.end());
  }

  std::vector<double> memory() const override {
    const Moment last = last_.value_or(Moment{absent, Vec3::Zero()});
    return {last.time, last.velocity[0], last.velocity[1], last.velocity[2],
            mean_[0],  mean_[1],         mean_[2]};
  }
  void restore(std::span<const double> memory) override {
    last_.reset();
    if (memory[0] != absent) last_ = {memory[0], Vec3(memory.data() + 1)};
    mean_ = Vec3(memory.data() + 4);
  }

 private:
  struct Moment {
    double time = 0.0;
    Vec3 velocity = Vec3::Zero();
  };

  Place place_;
  mutable std::optional<Moment> last_;  // none before the first state, and in statics
  mutable Vec3 mean_ = Vec3::Constant(absent);
};

std::unique_ptr<Quantity> make_acceleration(const Options& options, model::BuildContext& context) {
  const std::optional<Place> place = read_place(options, true, false, context);
  return place ? std::make_unique<Acceleration>(*place) : nullptr;
}

}  // namespace

void register_acceleration_quantity(QuantityRegistry& registry) {
  Schema schema("Acceleration",
                "Acceleration of a node, or a point fixed to it, in space: the mean over the step. "
                "An empty cell where no step of a motion led.");
  schema.add(model::node_field("Node", "The node, such as 'structure/last'.")).add(offset_field());
  registry.add("Acceleration", std::move(schema), make_acceleration);
}

}  // namespace culm::simulation
