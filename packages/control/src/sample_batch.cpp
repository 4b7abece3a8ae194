#include <culm/control/sample_batch.hpp>

namespace culm::control {

model::Signal SampleBatch::add(const std::string& name, double initial) {
  const int block =
      model_.add_own_block({name, {{"value", model::UnknownKind::algebraic, 1.0, initial}}});
  signals_.push_back(model_.signal(block, 0));
  return signals_.back();
}

std::vector<int> SampleBatch::blocks(int item, const model::UnknownTable& unknowns) const {
  return {unknowns.own_block(signals_[static_cast<std::size_t>(item)].block)};
}

Verdict SampleBatch::assemble(const model::State& state, const Stencil&, Want want,
                              model::Target& target) {
  for (std::size_t i = 0; i < placement().items.size(); ++i) {
    const model::Signal& signal = signals_[static_cast<std::size_t>(placement().items[i])];
    const auto at = static_cast<std::size_t>(signal.index);
    const double change = state.own[at] - state.own_prev[at];
    if (want != Want::mass) placement().scatter.add_residual(i, 0, &change, target);
    if (want == Want::residual) continue;
    placement().scatter.add_tangent(i, 0, 0, Mat<1, 1>(1.0), target);
  }
  return Verdict::ok;
}

}  // namespace culm::control
