/// What builders of loads from fluids share.
#pragma once

#include <culm/flow/flow.hpp>

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace culm::flow {

/// Where builders of loads from fluids add to. They may refer to each other in any order: what one
/// needs of others is taken up when all of them are there.
class FluidContext {
 public:
  /// @param allowed  memory that a load may need [B]
  FluidContext(model::BuildContext& context, std::map<std::string, SharedFlow> all_flows,
               double allowed)
      : build(context), flows(std::move(all_flows)), memory(allowed) {}

  model::BuildContext& build;
  const std::map<std::string, SharedFlow> flows;  ///< list "Flows"
  const double memory;                            ///< that a load may need [B]

  /// Leaves something to do until all loads of the deck are there.
  void after_all_loads(std::function<void()> work) { later_.push_back(std::move(work)); }
  /// Does what was left, in the order of the deck.
  void finish() {
    for (const auto& work : later_) work();
    later_.clear();
  }

 private:
  std::vector<std::function<void()>> later_;
};

/// Types of the deck's list "Loads" that act in a flow.
using FluidLoadRegistry = Registry<void, FluidContext&>;

/// Parameter "Flow".
Field flow_field();
/// The flow that parameter "Flow" names; null, and an issue, if there is none.
SharedFlow find_flow(const Options& options, FluidContext& context);
/// Adds an issue when all loads are there if a rotating frame turns any of these nodes, to a load
/// that would not see its speed.
void refuse_rotating_frame(const Options& options, const std::vector<int>& nodes,
                           FluidContext& context);

}  // namespace culm::flow
