#include "scope.hpp"

#include <culm/base/nearest.hpp>
#include <culm/base/text.hpp>
#include <culm/deck/units.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <set>

namespace culm::deck {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

bool is_identifier_part(char c) { return is_letter(c) || (c >= '0' && c <= '9'); }

/// The identifier at the beginning of a text; empty if there is none.
std::string leading_identifier(std::string_view text) {
  if (text.empty() || !is_letter(text.front())) return {};
  return {text.begin(), std::ranges::find_if_not(text, is_identifier_part)};
}

/// Whether a word is one of a list with commas.
bool is_among(std::string_view list, std::string_view word) {
  while (!list.empty()) {
    const auto comma = list.find(',');
    if (trim(list.substr(0, comma)) == word) return true;
    list.remove_prefix(comma == std::string_view::npos ? list.size() : comma + 1);
  }
  return false;
}

/// "0.05 s" is a number and a unit.
std::string unit_hint(std::string_view text) {
  const auto end = text.find_last_of("0123456789.");
  for (std::size_t cut = 1; end != std::string_view::npos && cut <= text.size(); ++cut) {
    const std::string_view unit = trim(text.substr(cut));
    if (!unit.empty() && literal_number(trim(text.substr(0, cut))) && find_unit(unit) &&
        is_letter(unit.front())) {
      return " – a unit stands in its own attribute: unit=\"" + std::string(unit) + "\"";
    }
  }
  return {};
}

/// "1e999" and "1e-999"
bool is_out_of_range(std::string_view text) {
  double ignored = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), ignored);
  return error == std::errc::result_out_of_range && end == text.data() + text.size();
}

/// Whether the identifier that ends at `end` is followed by a parenthesis.
bool is_called(std::string_view text, std::size_t end) {
  return trim(text.substr(std::min(end, text.size()))).starts_with('(');
}

/// Takes the next word, or one other character, from the front of a text. A word may begin with a
/// digit: the e of 2e3 is no name.
std::string next_word(std::string_view& text) {
  const auto end = std::ranges::find_if_not(text, is_identifier_part);
  const auto length = std::max<std::ptrdiff_t>(end - text.begin(), 1);
  std::string word(text.begin(), text.begin() + length);
  text.remove_prefix(static_cast<std::size_t>(length));
  return word;
}

bool is_not_finite_word(std::string_view text) {
  const std::string word = to_lower(text.substr(text.find_first_not_of("+-") == 1 ? 1 : 0));
  return word == "nan" || word == "inf" || word == "infinity";
}

}  // namespace

std::string quoted(std::string_view text) {
  constexpr std::size_t shown = 60;
  if (text.size() <= shown) return "'" + std::string(text) + "'";
  std::size_t end = shown;
  // Do not cut a UTF-8 sequence in two.
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return "'" + std::string(text.substr(0, end)) + "…'";
}

std::optional<double> literal_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

Scope::Scope()
    : variables_{{"pi", std::numbers::pi}, {"e", std::numbers::e}},
      arithmetic_(std::make_shared<Arithmetic>()) {}

Scope::Scope(const Scope* outer) : outer_(outer), arithmetic_(outer->arithmetic_) {}

std::string Scope::define(const std::string& name, double value) {
  if (leading_identifier(name) != name || name.empty()) {
    return "the name of a variable must be letters, digits and '_', got " + quoted(name);
  }
  if (name.size() > Formula::longest_name) {
    return "the name of a variable must have at most " + std::to_string(Formula::longest_name) +
           " characters, got " + quoted(name);
  }
  if (name == "pi" || name == "e" || arithmetic_->formula.has_function(name)) {
    return "the name '" + name + "' is taken";
  }
  variables_[name] = value;
  return {};
}

Evaluation Scope::evaluate(const std::string& text) const {
  const std::string_view core = trim(text);
  if (const auto number = literal_number(core)) return {*number, {}};
  if (core.empty()) return {0.0, "must be a number, got ''"};
  if (is_not_finite_word(core)) return {0.0, "must be a finite number, got " + quoted(core)};
  if (is_out_of_range(core)) {
    return {0.0, "must be within the range of double precision, got " + quoted(core)};
  }
  Formula& formula = arithmetic_->formula;
  formula.set_constants(values_in(core));
  formula.set_text(std::string(core));
  const Formula::Result result = formula.evaluate();
  if (result.mistake) return {0.0, explain(std::string(core), *result.mistake)};
  if (result.count != 1) return {0.0, "must be one number, got " + quoted(core)};
  if (!std::isfinite(result.value)) return {0.0, "must be finite, got " + quoted(core)};
  return {result.value, {}};
}

std::string Scope::substitute(std::string_view formula, std::string_view own) const {
  std::string result;
  while (!formula.empty()) {
    const std::string word = next_word(formula);
    const double* value = find(word);
    const bool stays = is_among(own, word) || value == nullptr || is_called(formula, 0);
    result += stays ? word : "(" + format_number(*value) + ")";
  }
  return result;
}

const double* Scope::find(const std::string& name) const {
  for (const Scope* scope = this; scope != nullptr; scope = scope->outer_) {
    const auto found = scope->variables_.find(name);
    if (found != scope->variables_.end()) return &found->second;
  }
  return nullptr;
}

/// The variables that a text names: of thousands a formula uses few.
std::map<std::string, double> Scope::values_in(std::string_view text) const {
  std::map<std::string, double> values;
  while (!text.empty()) {
    const std::string word = next_word(text);
    if (const double* value = find(word)) values.emplace(word, *value);
  }
  return values;
}

std::vector<std::string> Scope::names() const {
  std::set<std::string> names;
  for (const Scope* scope = this; scope != nullptr; scope = scope->outer_) {
    for (const auto& [name, value] : scope->variables_) names.insert(name);
  }
  return {names.begin(), names.end()};
}

std::string Scope::explain(const std::string& text, const Formula::Mistake& mistake) const {
  const std::string message = "must be a number, got " + quoted(text);
  if (arithmetic_->hints <= 0) return message;
  --arithmetic_->hints;
  std::string hint = unit_hint(text);
  if (!hint.empty()) return message + hint;
  const int position = mistake.position;
  const bool inside = position >= 0 && static_cast<std::size_t>(position) < text.size();
  const std::string name =
      inside ? leading_identifier(std::string_view(text).substr(static_cast<std::size_t>(position)))
             : leading_identifier(mistake.token);
  std::vector<std::string> known = names();
  if (name == text) {
    // A lone word is probably no expression at all, unless it resembles a variable.
    const std::string nearest = nearest_name(name, known);
    return nearest.empty() ? message : message + " – did you mean '" + nearest + "'?";
  }
  const Formula& formula = arithmetic_->formula;
  if (name.empty() || find(name) != nullptr || formula.has_function(name)) {
    return message + " (" + std::string(trim(mistake.reason)) + ")";
  }
  const bool called = inside && is_called(text, static_cast<std::size_t>(position) + name.size());
  if (called) {
    for (const std::string& function : formula.functions()) known.push_back(function);
  }
  return message + ": unknown " + (called ? "function" : "variable") + " " + quoted(name) +
         did_you_mean(name, known);
}

}  // namespace culm::deck
