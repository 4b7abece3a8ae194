#include "line_quantity.hpp"

#include <culm/base/nearest.hpp>
#include <culm/load/catenary_load.hpp>

#include <iterator>
#include <string>
#include <vector>

namespace culm::simulation {
namespace {

using output::HistoryColumn;

class LineQuantity final : public Quantity {
 public:
  explicit LineQuantity(const load::CatenaryLoad& line) : line_(line) {}

  std::vector<HistoryColumn> columns() const override {
    return {{"fairlead", "N"}, {"anchor", "N"}, {"H", "N"}, {"V", "N"}, {"grounded", "m"}};
  }
  void evaluate(const assembly::System&, const model::State& state,
                std::vector<double>& numbers) const override {
    const load::CatenaryEnds ends = line_.ends(0, state.next);
    const double values[] = {ends.fairlead_tension(), ends.anchor_tension(line_.line(0)),
                             ends.horizontal, ends.vertical, ends.grounded};
    numbers.insert(numbers.end(), std::begin(values), std::end(values));
  }

 private:
  const load::CatenaryLoad& line_;
};

std::unique_ptr<Quantity> make_line(const Options& options, model::BuildContext& context) {
  const std::string& name = options.text("Load");
  std::vector<std::string> names;
  for (const auto& batch : context.model.loads()) {
    const auto* line = dynamic_cast<const load::CatenaryLoad*>(batch.get());
    if (line == nullptr) continue;
    names.push_back(line->effect().name);
    if (names.back() != name) continue;
    if (line->size() == 1) return std::make_unique<LineQuantity>(*line);
    context.issues.add(options.where("Load"), "'" + name + "' hangs on " +
                                                  std::to_string(line->size()) +
                                                  " nodes, but one line is watched");
    return nullptr;
  }
  context.issues.add(options.where("Load"),
                     "no mooring line '" + name + "'" + did_you_mean(name, names));
  return nullptr;
}

}  // namespace

void register_line_quantity(QuantityRegistry& registry) {
  registry.add("Line",
               Schema("Line",
                      "Tensions of a mooring line at its fairlead and at its anchor, the "
                      "horizontal force H, the vertical one V at the fairlead, and the unstretched "
                      "length that rests on the seabed.")
                   .add(text("Load", "Its name in the list Loads.")),
               make_line);
}

}  // namespace culm::simulation
