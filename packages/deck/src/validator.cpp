#include "validator.hpp"

#include <culm/base/error.hpp>

#include "convert.hpp"
#include "describe.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <unordered_set>
#include <utility>

namespace culm::deck {
namespace {

const RawParameter* find(const std::vector<RawParameter>& parameters, const std::string& name) {
  const auto found = std::ranges::find(parameters, name, &RawParameter::name);
  return found == parameters.end() ? nullptr : &*found;
}

const RawList* find(const std::vector<RawList>& lists, const std::string& name) {
  const auto found = std::ranges::find(lists, name, &RawList::name);
  return found == lists.end() ? nullptr : &*found;
}

Where where_of(const RawList& raw, const std::string& path) {
  return {raw.file, raw.line, path.empty() ? raw.name : path};
}

Where where_of(const RawParameter& raw, const std::string& list_path) {
  return {raw.file, raw.line, join_path(list_path, raw.name)};
}

/// What unknown names of a list may stand for: a name that is not there yet, before one that is.
class Meanings {
 public:
  template <class Item>
  Meanings(std::vector<std::string> known, const std::vector<Item>& items)
      : known_(std::move(known)) {
    std::unordered_set<std::string_view> present;
    for (const Item& item : items) present.insert(item.name);
    for (const std::string& name : known_) {
      if (!present.contains(name)) absent_.push_back(name);
    }
  }
  bool knows(const std::string& name) const {
    return std::ranges::find(known_, name) != known_.end();
  }
  const std::vector<std::string>& of(const std::string& name) const {
    return nearest_name(name, absent_).empty() ? known_ : absent_;
  }

 private:
  std::vector<std::string> known_;
  std::vector<std::string> absent_;
};

/// Whether one of the items has an unknown name that was meant to be this one.
template <class Item>
bool is_misspelt(const std::string& name, const std::vector<Item>& items,
                 const std::vector<std::string>& known) {
  const Meanings meanings(known, items);
  return std::ranges::any_of(items, [&](const Item& item) {
    return !meanings.knows(item.name) && nearest_name(item.name, meanings.of(item.name)) == name;
  });
}

bool is_of_deck(const std::string& file) { return file != command_line; }

// A list that --set makes though it would only set something in one of almost the same name.
std::string misspelt_by_override(const RawList& list, const RawList& parent) {
  if (is_of_deck(list.file) || find(list.parameters, "Type")) return {};
  std::vector<std::string> others;
  for (const RawList& other : parent.lists) {
    if (is_of_deck(other.file)) others.push_back(other.name);
  }
  if (nearest_name(list.name, others).empty()) return {};
  return "there is no list '" + list.name + "', and a new one needs a 'Type'" +
         did_you_mean(list.name, others);
}

}  // namespace

Options Validator::root(const RawList& raw, const Schema& schema) {
  const Scope scope;
  const Place place{raw, "", scope};
  if (raw.name != schema.name()) {
    report(place, "the root list must be named '" + schema.name() + "', got '" + raw.name + "'");
  }
  return list(place, schema, nullptr);
}

/// `type` is the parameter that chose the schema; null if nothing did.
Options Validator::list(const Place& place, const Schema& schema, const RawParameter* type) {
  const std::size_t mistakes_before = issues_.size() + silent_mistakes_;
  // A list without variables shares the scope above, and with it the parser, which is costly.
  std::optional<Scope> own;
  if (!place.raw.variables.empty()) define_variables(place, own.emplace(&place.outer));
  const Scope& scope = own ? *own : place.outer;
  Options options(place.raw.name, where_of(place.raw, place.path));
  if (type) {
    options.set("Type", type->value.value(), !type->is_default, where_of(*type, place.path));
  }
  for (const Field& field : schema.fields()) read_field(place, schema, field, scope, options);
  read_lists(place, schema, scope, options);
  report_unknown(place, schema, type != nullptr);
  // Rules across parameters rely on the rules of each.
  if (issues_.size() + silent_mistakes_ == mistakes_before) {
    for (const Schema::Check& check : schema.checks()) check(options, issues_);
  }
  return options;
}

Options Validator::list_of_slot(const Place& place, const Schema::Slot& slot) {
  if (!slot.by_type()) return list(place, *slot.schema, nullptr);
  const std::vector<std::string> types = slot.types();
  const RawParameter* written = find(place.raw.parameters, "Type");
  RawParameter type;
  if (written) {
    type = *written;
  } else {
    type.file = place.raw.file;
    type.line = place.raw.line;
    type.name = "Type";
    type.value = slot.default_type;
    type.is_default = true;
  }
  Options nothing(place.raw.name, where_of(place.raw, place.path));
  if (!written && slot.default_type.empty()) {
    report_missing(place, false, "missing 'Type'" + did_you_mean("", types));
    return nothing;
  }
  const Conversion conversion = convert(type, text("Type", ""), place.outer);
  for (const std::string& mistake : conversion.mistakes) report(type, place.path, mistake);
  if (!conversion.value) {
    ++silent_mistakes_;
    return nothing;
  }
  if (const Schema* schema = slot.find(*type.value)) return list(place, *schema, &type);
  report(type, place.path, "unknown type '" + *type.value + "'" + did_you_mean(*type.value, types));
  return nothing;
}

void Validator::define_variables(const Place& place, Scope& scope) {
  for (const RawParameter& variable : place.raw.variables) {
    const Conversion conversion = convert_variable(variable, scope);
    std::vector<std::string> mistakes = conversion.mistakes;
    // A variable with a wrong value gets some value, so that its users are not blamed as well.
    const double value = conversion.value ? std::get<double>(*conversion.value) : 1.0;
    std::string wrong_name = scope.define(variable.name, value);
    if (!wrong_name.empty()) mistakes.push_back(std::move(wrong_name));
    for (const std::string& mistake : mistakes) report(variable, place.path, mistake);
  }
}

void Validator::read_field(const Place& place, const Schema& schema, const Field& field,
                           const Scope& scope, Options& options) {
  const Where list_where = where_of(place.raw, place.path);
  if (const RawParameter* raw = find(place.raw.parameters, field.name())) {
    Conversion conversion = convert(*raw, field, scope);
    for (const std::string& mistake : conversion.mistakes) report(*raw, place.path, mistake);
    if (!conversion.value) {
      ++silent_mistakes_;
      return;
    }
    // A resolved deck marks defaults; one that was edited by hand is none any more.
    const bool given = !raw->is_default || conversion.value != field.default_value();
    options.set(field.name(), std::move(*conversion.value), given, where_of(*raw, place.path));
  } else if (const RawList* wrong = find(place.raw.lists, field.name())) {
    issues_.add(where_of(*wrong, join_path(place.path, wrong->name)),
                "must be a <Parameter>, found a <ParameterList>");
  } else if (field.required()) {
    report_missing(place, is_misspelt(field.name(), place.raw.parameters, schema.field_names()),
                   "missing '" + field.name() + "' (" + describe(field) + ")");
  } else if (field.default_value()) {
    options.set(field.name(), *field.default_value(), false, list_where);
  } else {
    options.declare(field.name());
  }
}

void Validator::read_lists(const Place& place, const Schema& schema, const Scope& scope,
                           Options& options) {
  for (const Schema::Slot& slot : schema.lists()) {
    if (const RawList* raw = find(place.raw.lists, slot.name)) {
      options.add_list(list_of_slot({*raw, join_path(place.path, raw->name), scope}, slot));
    } else if (!find(place.raw.parameters, slot.name)) {
      absent_list(place, schema, slot, scope, options);
    }
  }
  if (!schema.entries()) return;
  options.declare_entries();
  const std::vector<std::string> fixed = schema.list_names();
  for (const RawList& raw : place.raw.lists) {
    if (schema.find_field(raw.name) || std::ranges::find(fixed, raw.name) != fixed.end()) continue;
    const std::string misspelt =
        schema.entries()->by_type() ? misspelt_by_override(raw, place.raw) : std::string();
    if (!misspelt.empty()) {
      report({raw, join_path(place.path, raw.name), scope}, misspelt);
      continue;
    }
    options.add_entry(
        list_of_slot({raw, join_path(place.path, raw.name), scope}, *schema.entries()));
  }
}

void Validator::absent_list(const Place& place, const Schema& schema, const Schema::Slot& slot,
                            const Scope& scope, Options& options) {
  if (slot.presence == Presence::required) {
    // Where lists have any name, none is unknown.
    const bool misspelt =
        !schema.entries() && is_misspelt(slot.name, place.raw.lists, schema.list_names());
    report_missing(place, misspelt, "missing list '" + slot.name + "'");
  } else if (slot.presence == Presence::optional) {
    options.declare_list(slot.name);
  } else {
    RawList empty;
    empty.file = place.raw.file;
    empty.line = place.raw.line;
    empty.name = slot.name;
    options.add_list(list_of_slot({empty, join_path(place.path, slot.name), scope}, slot));
  }
}

void Validator::report_unknown(const Place& place, const Schema& schema, bool has_type) {
  const std::string path = where_of(place.raw, place.path).path;
  std::vector<std::string> fields = schema.field_names();
  if (has_type) fields.emplace_back("Type");
  const Meanings lists(schema.list_names(), place.raw.lists);
  const Meanings parameters(std::move(fields), place.raw.parameters);
  for (const RawParameter& raw : place.raw.parameters) {
    if (raw.name.empty() || parameters.knows(raw.name)) continue;
    if (lists.knows(raw.name)) {
      report(raw, place.path, "must be a <ParameterList>, found a <Parameter>");
    } else if (find(place.raw.lists, raw.name)) {
      report(raw, place.path, "is a list: name what to set in it, as '" + raw.name + "/…'");
    } else {
      std::vector<std::string> meant = parameters.of(raw.name);
      if (!is_of_deck(raw.file)) {  // variables are set as parameters are
        for (const RawParameter& variable : place.raw.variables) meant.push_back(variable.name);
      }
      issues_.add({raw.file, raw.line, path},
                  "unknown name '" + raw.name + "'" + did_you_mean(raw.name, meant));
    }
  }
  if (schema.entries()) return;
  for (const RawList& raw : place.raw.lists) {
    if (raw.name.empty() || schema.find_field(raw.name) || lists.knows(raw.name)) continue;
    issues_.add({raw.file, raw.line, path},
                "unknown list '" + raw.name + "'" + did_you_mean(raw.name, lists.of(raw.name)));
  }
}

/// One mistake, one message: what is missing because of another mistake is not reported.
void Validator::report_missing(const Place& place, bool is_misspelt, const std::string& message) {
  if (is_misspelt || place.raw.is_incomplete) {
    ++silent_mistakes_;
  } else {
    report(place, message);
  }
}

void Validator::report(const Place& place, const std::string& message) {
  issues_.add(where_of(place.raw, place.path), message);
}

void Validator::report(const RawParameter& parameter, const std::string& list_path,
                       const std::string& message) {
  issues_.add(where_of(parameter, list_path), message);
}

}  // namespace culm::deck
