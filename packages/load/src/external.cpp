#include <culm/load/moment_load.hpp>
#include <culm/load/slot_load.hpp>

#include "both_frames.hpp"
#include "types.hpp"

#include <utility>

namespace culm::load {
namespace {

// Forces and moments in space, as dead loads have them: their work over a step is exact.
class ExternalLoad final : public model::NodalInput {
 public:
  ExternalLoad(std::vector<int> nodes, SlotLoad& forces, MomentLoad& moments)
      : nodes_(std::move(nodes)), forces_(forces), moments_(moments) {
    for (const int node : nodes_) {
      items_.push_back(forces_.add_settable_force(node));
      moments_.add_moment(node, Vec3::Zero());
    }
  }

  const std::vector<int>& nodes() const override { return nodes_; }
  void set(std::size_t i, const Vec3& force, const Vec3& moment) override {
    forces_.set_force(items_[i], force);
    moments_.set_moment(static_cast<int>(i), moment);
  }

 private:
  std::vector<int> nodes_;
  std::vector<int> items_;
  SlotLoad& forces_;
  MomentLoad& moments_;
};

void build_external(const Options& options, model::BuildContext& context) {
  std::vector<int> nodes = model::select_loaded_nodes(options, "Node", context);
  // not constant, so that what it does is work and no potential
  const model::Amplitude always = model::Amplitude::of_time([](double) { return 1.0; });
  const model::Effect effect = effect_of("External", options);
  const model::NodeTable& table = context.model.nodes();
  auto forces = std::make_unique<SlotLoad>(effect, table, always);
  auto moments =
      std::make_unique<MomentLoad>(effect.of_part("moments"), table, always, Axes::space);
  context.model.add_input(options.name(),
                          std::make_unique<ExternalLoad>(std::move(nodes), *forces, *moments));
  context.model.add_load(std::move(forces));
  context.model.add_load(std::move(moments));
}

}  // namespace

void register_external(model::BuilderRegistry& registry) {
  registry.add("External",
               Schema("External",
                      "Forces and moments on nodes, in space, that a program sets from step to "
                      "step through the library; zero until it does.")
                   .add(model::node_field()),
               build_external);
}

}  // namespace culm::load
