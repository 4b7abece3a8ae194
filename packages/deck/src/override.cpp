#include <culm/base/error.hpp>
#include <culm/base/text.hpp>

#include "raw_list.hpp"
#include "scope.hpp"
#include "xml_text.hpp"

#include <algorithm>

namespace culm::deck {
namespace {

struct Assignment {
  std::vector<std::string> lists;
  std::string name;
  std::string value;
};

Assignment parse(const std::string& text) {
  const std::string objection = xml_objection(text);
  if (!objection.empty()) throw UsageError("--set " + objection + " in '" + printable(text) + "'");
  const auto equals = text.find('=');
  Assignment assignment;
  if (equals == std::string::npos) {
    throw UsageError("--set needs 'List/Parameter=value', got " + quoted(text));
  }
  assignment.value = trim(std::string_view(text).substr(equals + 1));
  std::string_view path = std::string_view(text).substr(0, equals);
  while (true) {
    const auto slash = path.find('/');
    const std::string name(trim(path.substr(0, slash)));
    if (name.empty()) throw UsageError("--set has an empty name in " + quoted(text));
    if (slash == std::string_view::npos) {
      assignment.name = name;
      return assignment;
    }
    assignment.lists.push_back(name);
    path.remove_prefix(slash + 1);
  }
}

// @param path  of the parent; becomes that of the list
RawList& find_or_add_list(RawList& parent, const std::string& name, std::string& path) {
  path = join_path(path, name);
  const auto found = std::ranges::find(parent.lists, name, &RawList::name);
  if (found != parent.lists.end()) return *found;
  // a list beside it would be overlooked
  if (std::ranges::find(parent.parameters, name, &RawParameter::name) != parent.parameters.end()) {
    throw InputError({command_line, 0, path}, "must be a <Parameter>, found a <ParameterList>");
  }
  RawList list;
  list.file = command_line;
  list.name = name;
  return parent.lists.emplace_back(std::move(list));
}

RawParameter& find_or_add_value(RawList& list, const std::string& name) {
  for (std::vector<RawParameter>* values : {&list.parameters, &list.variables}) {
    const auto found = std::ranges::find(*values, name, &RawParameter::name);
    if (found != values->end()) return *found;
  }
  RawParameter parameter;
  parameter.name = name;
  return list.parameters.emplace_back(std::move(parameter));
}

}  // namespace

void apply_overrides(const std::vector<std::string>& overrides, RawList& root) {
  for (const std::string& text : overrides) {
    const Assignment assignment = parse(text);
    RawList* list = &root;
    std::string path;
    for (const std::string& name : assignment.lists) list = &find_or_add_list(*list, name, path);
    RawParameter& parameter = find_or_add_value(*list, assignment.name);
    parameter.file = command_line;
    parameter.line = 0;
    parameter.value = assignment.value;
    parameter.is_default = false;
  }
}

}  // namespace culm::deck
