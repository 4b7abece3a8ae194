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
  if (schema.entries()) options.declare_entries();
  for (const Schema::Slot& slot : schema.lists()) {
    if (slot.presence == Presence::defaulted && !slot.by_type()) {
      options.add_list(default_list(*slot.schema, slot.name, where));
    } else {
      options.declare_list(slot.name);
    }
  }
  return options;
}

}  // namespace culm
