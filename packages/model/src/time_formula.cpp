#include "time_formula.hpp"

#include <culm/base/formula.hpp>
#include <culm/base/text.hpp>

#include <limits>
#include <numbers>

namespace culm::model {

struct TimeFormula::Parser {
  Formula formula;
  double time = 0.0;

  explicit Parser(const std::string& text) {
    formula.set_constants({{"pi", std::numbers::pi}, {"e", std::numbers::e}});
    formula.add_variable("t", time);
    formula.set_text(text);
  }
  Parser(const Parser&) = delete;  // the formula points to the time beside it
  Parser& operator=(const Parser&) = delete;
  ~Parser() = default;
};

TimeFormula::TimeFormula(const std::string& text) : parser_(std::make_shared<Parser>(text)) {}

double TimeFormula::value(double time) const {
  parser_->time = time;
  const Formula::Result result = parser_->formula.evaluate();
  return result.mistake ? std::numeric_limits<double>::quiet_NaN() : result.value;
}

std::string TimeFormula::mistake(const std::string& text) {
  if (trim(text).empty()) return "must be a formula in t, got ''";
  const Parser checked(text);
  const Formula::Result result = checked.formula.evaluate();
  const std::string shown = "'" + shortened(text, 200) + "'";
  if (result.mistake) {
    const int position = result.mistake->position;
    const std::string place = position >= 0 ? " at character " + std::to_string(position + 1) : "";
    const std::string token(trim(result.mistake->token));
    return "must be a formula in t, got " + shown + ": mistake" + place +
           (token.empty() ? "" : ", '" + shortened(token, 60) + "'") + " (" +
           std::string(trim(result.mistake->reason)) + ")";
  }
  return result.count == 1 ? "" : "must be one formula in t, got " + shown;
}

}  // namespace culm::model
