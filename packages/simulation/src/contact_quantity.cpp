#include "contact_quantity.hpp"

#include <culm/base/nearest.hpp>
#include <culm/contact/contact_point.hpp>

#include <string>
#include <vector>

namespace culm::simulation {
namespace {

class ContactQuantity final : public Quantity {
 public:
  explicit ContactQuantity(const contact::Contact& contact) : contact_(contact) {}

  std::vector<output::HistoryColumn> columns() const override {
    return {{"F", "N"}, {"depth", "m"}, {"area", "m^2"}};
  }
  void evaluate(const assembly::System&, const model::State& state,
                std::vector<double>& numbers) const override {
    const contact::Touch touch = contact_.touch(state.next);
    numbers.insert(numbers.end(), {touch.force, touch.depth, touch.area});
  }

 private:
  const contact::Contact& contact_;
};

std::unique_ptr<Quantity> make_contact(const Options& options, model::BuildContext& context) {
  const std::string& name = options.text("Load");
  std::vector<std::string> names;
  for (const auto& batch : context.model.loads()) {
    const auto* load = dynamic_cast<const contact::Contact*>(batch.get());
    if (load == nullptr) continue;
    names.push_back(batch->effect().name);
    if (names.back() == name) return std::make_unique<ContactQuantity>(*load);
  }
  context.issues.add(options.where("Load"),
                     "no contact '" + name + "'" + did_you_mean(name, names));
  return nullptr;
}

}  // namespace

void register_contact_quantity(QuantityRegistry& registry) {
  registry.add("Contact",
               Schema("Contact",
                      "Normal force by the depths, the largest depth, negative while nothing "
                      "touches, and the area that is pressed.")
                   .add(text("Load", "Its name in the list Loads.")),
               make_contact);
}

}  // namespace culm::simulation
