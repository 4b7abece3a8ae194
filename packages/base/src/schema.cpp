#include <culm/base/error.hpp>
#include <culm/base/schema.hpp>

#include <algorithm>

namespace culm {

const Schema* Schema::Slot::find(const std::string& type) const {
  if (!by_type()) return schema.get();
  const auto found = variants->find(type);
  return found == variants->end() ? nullptr : &found->second;
}

std::vector<std::string> Schema::Slot::types() const {
  std::vector<std::string> names;
  if (!by_type()) return names;
  for (const auto& [type, variant] : *variants) names.push_back(type);
  return names;
}

Schema::Schema(std::string name, std::string doc) : name_(std::move(name)), doc_(std::move(doc)) {}

Schema& Schema::add(Field field) {
  check_name_is_free(field.name());
  fields_.push_back(std::move(field));
  return *this;
}

Schema& Schema::add_all(const Schema& other) {
  for (const Field& field : other.fields_) add(field);
  for (const auto& list : other.lists_) {
    check_name_is_free(list.name);
    lists_.push_back(list);
  }
  checks_.insert(checks_.end(), other.checks_.begin(), other.checks_.end());
  return *this;
}

Schema& Schema::list(std::string name, Schema schema, Presence presence) {
  check_name_is_free(name);
  lists_.push_back(
      {std::move(name), presence, std::make_shared<const Schema>(std::move(schema)), nullptr, {}});
  return *this;
}

Schema& Schema::list_by_type(std::string name, Variants variants, Presence presence,
                             std::string default_type) {
  check_name_is_free(name);
  internal_check(default_type.empty() || variants.contains(default_type),
                 "list '" + name + "' has the unknown default type '" + default_type + "'");
  internal_check(presence != Presence::defaulted || !default_type.empty(),
                 "list '" + name + "' is defaulted but has no default type");
  lists_.push_back({std::move(name), presence, nullptr,
                    std::make_shared<const Variants>(std::move(variants)),
                    std::move(default_type)});
  return *this;
}

Schema& Schema::entries(Schema schema) {
  internal_check(!entries_, "schema '" + name_ + "' declares entries twice");
  entries_ =
      Slot{{}, Presence::optional, std::make_shared<const Schema>(std::move(schema)), nullptr, {}};
  return *this;
}

Schema& Schema::entries_by_type(Variants variants) {
  internal_check(!entries_, "schema '" + name_ + "' declares entries twice");
  entries_ = Slot{
      {}, Presence::optional, nullptr, std::make_shared<const Variants>(std::move(variants)), {}};
  return *this;
}

Schema& Schema::check(Check check) {
  checks_.push_back(std::move(check));
  return *this;
}

const Field* Schema::find_field(const std::string& name) const {
  const auto found = std::ranges::find(fields_, name, &Field::name);
  return found == fields_.end() ? nullptr : &*found;
}

const Schema::Slot* Schema::find_slot(const std::string& name) const {
  const auto found = std::ranges::find(lists_, name, &Slot::name);
  if (found != lists_.end()) return &*found;
  return entries_ ? &*entries_ : nullptr;
}

std::vector<std::string> Schema::field_names() const {
  std::vector<std::string> names;
  for (const Field& field : fields_) names.push_back(field.name());
  return names;
}

std::vector<std::string> Schema::list_names() const {
  std::vector<std::string> names;
  for (const Slot& slot : lists_) names.push_back(slot.name);
  return names;
}

void Schema::check_name_is_free(const std::string& name) const {
  const bool taken =
      find_field(name) || std::ranges::find(lists_, name, &Slot::name) != lists_.end();
  internal_check(!taken, "schema '" + name_ + "' declares '" + name + "' twice");
}

}  // namespace culm
