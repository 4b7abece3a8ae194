#include "describe.hpp"

#include <culm/base/text.hpp>

namespace culm::deck {

std::string describe(const Field& field) {
  std::string words = to_string(field.kind());
  const std::string range = field.range_text();
  if (!range.empty()) {
    words += " " + range;
  } else if (!field.unit().empty()) {
    words += " in " + field.unit();
  }
  if (!field.size_text().empty()) words += ", " + field.size_text();
  if (!field.formula_variable().empty()) words += ", formula in " + field.formula_variable();
  if (!field.choices().empty()) words += ": " + join(field.choices(), ", ");
  return words;
}

std::string describe_fully(const Field& field) {
  std::string words = describe(field);
  if (field.required()) {
    words += ", required";
  } else if (field.default_value()) {
    const std::string value = to_string(*field.default_value());
    words += ", default " + (value.empty() ? "empty" : value);
  } else {
    words += ", optional";
  }
  return words + "." + (field.doc().empty() ? "" : " " + field.doc());
}

}  // namespace culm::deck
