#include "wind_function.hpp"

namespace culm::flow {

std::optional<model::Amplitude> find_wind_function(const Options& options,
                                                   model::BuildContext& context) {
  auto function = model::find_function(options, context);
  if (function && !function->is_function_of_time()) {
    context.issues.add(options.where("Function"), "must be a function of time");
    return {};
  }
  return function;
}

}  // namespace culm::flow
