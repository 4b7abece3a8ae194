#include "time_formula.hpp"

#include <culm/base/text.hpp>

#include <muParser.h>

#include <numbers>

namespace culm::model {

struct TimeFormula::Parser {
  mu::Parser parser;
  double time = 0.0;

  explicit Parser(const std::string& text) {
    parser.ClearConst();
    parser.DefineConst("pi", std::numbers::pi);
    parser.DefineConst("e", std::numbers::e);
    parser.DefineVar("t", &time);
    parser.SetExpr(text);
  }
  Parser(const Parser&) = delete;  // the parser points to the time beside it
  Parser& operator=(const Parser&) = delete;
  ~Parser() = default;
};

TimeFormula::TimeFormula(const std::string& text) : parser_(std::make_shared<Parser>(text)) {}

double TimeFormula::value(double time) const {
  parser_->time = time;
  return parser_->parser.Eval();
}

std::string TimeFormula::mistake(const std::string& text) {
  if (trim(text).empty()) return "must be a formula in t, got ''";
  try {
    Parser checked(text);
    int count = 0;
    checked.parser.Eval(count);
    return count == 1 ? "" : "must be one formula in t, got '" + text + "'";
  } catch (const mu::Parser::exception_type& error) {
    const auto place = std::string(
        error.GetPos() >= 0 ? " at character " + std::to_string(error.GetPos() + 1) : "");
    const std::string token(trim(error.GetToken()));
    return "must be a formula in t, got '" + text + "': mistake" + place +
           (token.empty() ? "" : ", '" + token + "'") + " (" + std::string(trim(error.GetMsg())) +
           ")";
  }
}

}  // namespace culm::model
