#include <culm/base/default_list.hpp>

#include <utility>

namespace culm {

Options default_list(const Schema& schema, std::string name, const Where& where) {
  Options options(std::move(name), where);
  for (const Field& field : schema.fields()) {
    if (field.default_value()) {
      options.set(field.name(), *field.default_value(), false, where);
    } else {
      options.declare(field.name());
    }
  }
  for (const Schema::Slot& slot : schema.lists()) options.declare_list(slot.name);
  return options;
}

}  // namespace culm
