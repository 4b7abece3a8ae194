#include <culm/base/error.hpp>
#include <culm/base/field.hpp>
#include <culm/base/text.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace culm {
namespace {

bool is_array(Kind kind) { return kind >= Kind::numbers; }

bool is_numeric(Kind kind) {
  return kind == Kind::number || kind == Kind::integer || kind == Kind::numbers ||
         kind == Kind::integers;
}

std::string count_text(int count) {
  return std::to_string(count) + (count == 1 ? " item" : " items");
}

/// A bound or item; whole numbers in all their digits, however large.
std::string spelled(Kind kind, double value) {
  const bool whole = kind == Kind::integer || kind == Kind::integers;
  return whole ? std::to_string(static_cast<long long>(value)) : format_number(value);
}

int to_whole(double value, const std::string& name) {
  internal_check(value == std::floor(value) && std::abs(value) <= std::numeric_limits<int>::max(),
                 "the default of '" + name + "' is no integer");
  return static_cast<int>(value);
}

/// A default as C++ spells it, brought to the kind of its field: 0 is a number too, braces around
/// whole numbers may mean integers or numbers, and compilers differ in whether braces around one
/// text are one.
Value to_kind(Value value, Kind kind, const std::string& name) {
  if (const auto* whole = std::get_if<int>(&value); whole && kind == Kind::number) {
    return static_cast<double>(*whole);
  }
  if (const auto* items = std::get_if<std::vector<double>>(&value);
      items && kind == Kind::integers) {
    std::vector<int> wholes;
    for (const double item : *items) wholes.push_back(to_whole(item, name));
    return wholes;
  }
  if (const auto* items = std::get_if<std::vector<double>>(&value);
      items && items->empty() && kind == Kind::texts) {
    return std::vector<std::string>{};
  }
  if (const auto* text = std::get_if<std::string>(&value); text && kind == Kind::texts) {
    return std::vector<std::string>{*text};
  }
  internal_check(kind_of(value) == kind, "the default of '" + name + "' is not of its kind");
  return value;
}

}  // namespace

Field::Field(Kind kind, std::string name, std::string unit, std::string doc)
    : kind_(kind), name_(std::move(name)), unit_(std::move(unit)), doc_(std::move(doc)) {
  if (unit_ == "1") unit_.clear();
}

Field& Field::at_least(double lower) {
  internal_check(is_numeric(kind_), "'" + name_ + "' has bounds but is no number");
  lower_ = Bound{lower, true};
  return *this;
}

Field& Field::at_most(double upper) {
  internal_check(is_numeric(kind_), "'" + name_ + "' has bounds but is no number");
  upper_ = Bound{upper, true};
  return *this;
}

Field& Field::greater_than(double lower) {
  at_least(lower);
  lower_->inclusive = false;
  return *this;
}

Field& Field::less_than(double upper) {
  at_most(upper);
  upper_->inclusive = false;
  return *this;
}

Field& Field::size(int count) {
  internal_check(is_array(kind_), "'" + name_ + "' has a size but is no array");
  size_ = count;
  return *this;
}

Field& Field::size_multiple_of(int count) {
  internal_check(is_array(kind_) && count > 0, "'" + name_ + "' has a size but is no array");
  multiple_ = count;
  return *this;
}

Field& Field::min_size(int count) {
  internal_check(is_array(kind_), "'" + name_ + "' has a size but is no array");
  min_size_ = count;
  return *this;
}

Field& Field::one_of(std::vector<std::string> choices) {
  internal_check(kind_ == Kind::text || kind_ == Kind::texts,
                 "'" + name_ + "' has choices but is no text");
  choices_ = std::move(choices);
  return *this;
}

Field& Field::formula_in(std::string variable) {
  internal_check(kind_ == Kind::text, "'" + name_ + "' is a formula but no text");
  formula_variable_ = std::move(variable);
  return *this;
}

Field& Field::optional() {
  required_ = false;
  return *this;
}

Field& Field::optional(double value) { return set_default(value); }
Field& Field::optional(int value) { return set_default(value); }
Field& Field::optional(bool value) { return set_default(value); }
Field& Field::optional(const char* value) { return set_default(std::string(value)); }
Field& Field::optional(std::string value) { return set_default(std::move(value)); }
Field& Field::optional(std::vector<double> value) { return set_default(std::move(value)); }
Field& Field::optional(std::vector<int> value) { return set_default(std::move(value)); }
Field& Field::optional(std::vector<std::string> value) { return set_default(std::move(value)); }
Field& Field::optional(std::initializer_list<double> value) {
  return set_default(std::vector<double>(value));
}
Field& Field::optional(std::initializer_list<std::string> value) {
  return set_default(std::vector<std::string>(value));
}

Field& Field::set_default(Value value) {
  default_ = to_kind(std::move(value), kind_, name_);
  const std::vector<std::string> wrong = mistakes(*default_);
  internal_check(wrong.empty(),
                 "the default of '" + name_ + "' breaks its own rule: " + join(wrong, ", "));
  return optional();
}

std::string Field::range_text() const {
  const std::string unit = unit_.empty() ? "" : " " + unit_;
  if (lower_ && upper_ && lower_->inclusive && upper_->inclusive) {
    return "between " + spelled(kind_, lower_->value) + " and " + spelled(kind_, upper_->value) +
           unit;
  }
  std::vector<std::string> parts;
  if (lower_) parts.push_back((lower_->inclusive ? ">= " : "> ") + spelled(kind_, lower_->value));
  if (upper_) parts.push_back((upper_->inclusive ? "<= " : "< ") + spelled(kind_, upper_->value));
  return parts.empty() ? "" : join(parts, " and ") + unit;
}

std::string Field::size_text() const {
  std::vector<std::string> parts;
  if (size_) parts.push_back(count_text(*size_));
  if (multiple_) parts.push_back("a multiple of " + count_text(*multiple_));
  if (min_size_) parts.push_back("at least " + count_text(*min_size_));
  return join(parts, " and ");
}

bool Field::in_range(double value) const {
  if (!std::isfinite(value)) return false;
  if (lower_ && (value < lower_->value || (!lower_->inclusive && value == lower_->value))) {
    return false;
  }
  return !upper_ || value < upper_->value || (upper_->inclusive && value == upper_->value);
}

std::string Field::wrong_size(std::size_t count) const {
  const auto items = static_cast<long long>(count);
  const bool wrong = (size_ && items != *size_) || (multiple_ && items % *multiple_ != 0) ||
                     (min_size_ && items < *min_size_);
  return wrong ? "must have " + size_text() + ", got " + std::to_string(count) : "";
}

std::string Field::wrong_item(double value) const {
  if (in_range(value)) return {};
  const std::string rule = std::isfinite(value) ? range_text() : "finite";
  return "must be " + rule + ", got " + spelled(kind_, value);
}

std::string Field::wrong_item(const std::string& value) const {
  if (choices_.empty() || std::ranges::find(choices_, value) != choices_.end()) return {};
  return "unknown choice '" + value + "'" + did_you_mean(value, choices_);
}

template <class Item>
void Field::find_wrong_items(const std::vector<Item>& items,
                             std::vector<std::string>& messages) const {
  // A long array with a systematic mistake needs no thousand lines to be understood.
  constexpr std::size_t shown = 5;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string message = wrong_item(items[i]);
    if (message.empty() || ++wrong > shown) continue;
    messages.push_back("item " + std::to_string(i + 1) + ": " + message);
  }
  if (wrong > shown) messages.push_back(std::to_string(wrong - shown) + " more items are wrong");
}

std::vector<std::string> Field::mistakes(const Value& value) const {
  internal_check(kind_of(value) == kind_, "'" + name_ + "' is checked against another kind");
  std::vector<std::string> messages;
  std::visit(
      [&](const auto& content) {
        using Content = std::decay_t<decltype(content)>;
        if constexpr (std::is_same_v<Content, bool>) {
          return;
        } else if constexpr (std::is_arithmetic_v<Content> ||
                             std::is_same_v<Content, std::string>) {
          std::string message = wrong_item(content);
          if (!message.empty()) messages.push_back(std::move(message));
        } else {
          std::string message = wrong_size(content.size());
          if (!message.empty()) messages.push_back(std::move(message));
          find_wrong_items(content, messages);
        }
      },
      value);
  return messages;
}

Field number(std::string name, std::string unit, std::string doc) {
  return {Kind::number, std::move(name), std::move(unit), std::move(doc)};
}

Field integer(std::string name, std::string doc) {
  return {Kind::integer, std::move(name), {}, std::move(doc)};
}

Field flag(std::string name, std::string doc) {
  return {Kind::flag, std::move(name), {}, std::move(doc)};
}

Field text(std::string name, std::string doc) {
  return {Kind::text, std::move(name), {}, std::move(doc)};
}

Field choice(std::string name, std::vector<std::string> choices, std::string doc) {
  return text(std::move(name), std::move(doc)).one_of(std::move(choices));
}

Field numbers(std::string name, std::string unit, std::string doc) {
  return {Kind::numbers, std::move(name), std::move(unit), std::move(doc)};
}

Field integers(std::string name, std::string doc) {
  return {Kind::integers, std::move(name), {}, std::move(doc)};
}

Field texts(std::string name, std::string doc) {
  return {Kind::texts, std::move(name), {}, std::move(doc)};
}

}  // namespace culm
