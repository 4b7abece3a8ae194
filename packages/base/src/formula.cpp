#include <culm/base/error.hpp>
#include <culm/base/formula.hpp>

#include <muParser.h>

#include <string_view>

namespace culm {
namespace {

Formula::Mistake to_mistake(const mu::ParserError& error) {
  return {error.GetMsg(), error.GetToken(), static_cast<int>(error.GetPos())};
}

/// muParser assigns to variables in the middle of a formula; '=' for '==' is a slip.
std::optional<Formula::Mistake> find_assignment(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool doubled = i + 1 < text.size() && text[i + 1] == '=';
    if (std::string_view("<>!=").find(text[i]) == std::string_view::npos) continue;
    if (doubled) {
      ++i;
    } else if (text[i] == '=') {
      return Formula::Mistake{"'=' does not compare, '==' does", "=", static_cast<int>(i)};
    }
  }
  return {};
}

}  // namespace

struct Formula::Parser {
  mu::Parser parser;
};

Formula::Formula() : parser_(std::make_unique<Parser>()) {
  mu::Parser& parser = parser_->parser;
  parser.ClearConst();
  // beside && and ||, which XML wants to be written in another way
  parser.DefineOprt(
      "and", [](double a, double b) { return a != 0.0 && b != 0.0 ? 1.0 : 0.0; }, mu::prLAND);
  parser.DefineOprt(
      "or", [](double a, double b) { return a != 0.0 || b != 0.0 ? 1.0 : 0.0; }, mu::prLOR);
}
Formula::Formula(Formula&&) noexcept = default;
Formula& Formula::operator=(Formula&&) noexcept = default;
Formula::~Formula() = default;

std::vector<std::string> Formula::functions() const {
  std::vector<std::string> names;
  for (const auto& [name, definition] : parser_->parser.GetFunDef()) names.push_back(name);
  return names;
}

bool Formula::has_function(const std::string& name) const {
  return parser_->parser.GetFunDef().contains(name) || name == "and" || name == "or";
}

void Formula::set_constants(const std::map<std::string, double>& constants) {
  try {
    parser_->parser.ClearConst();
    for (const auto& [name, value] : constants) parser_->parser.DefineConst(name, value);
  } catch (const mu::ParserError& error) {
    throw InternalError("a constant of a formula: " + error.GetMsg());
  }
}

void Formula::add_variable(const std::string& name, double& place) {
  try {
    parser_->parser.DefineVar(name, &place);
  } catch (const mu::ParserError& error) {
    throw InternalError("a variable of a formula: " + error.GetMsg());
  }
}

void Formula::set_text(const std::string& text) {
  mistake_ = find_assignment(text);
  if (mistake_) return;
  try {
    parser_->parser.SetExpr(text);
  } catch (const mu::ParserError& error) {
    mistake_ = to_mistake(error);
  }
}

bool Formula::uses(const std::string& variable) const {
  if (mistake_) return false;
  try {
    return parser_->parser.GetUsedVar().contains(variable);
  } catch (const mu::ParserError&) {
    return false;
  }
}

Formula::Result Formula::evaluate() const {
  if (mistake_) return {0.0, 0, mistake_};
  try {
    int count = 0;
    const double* values = parser_->parser.Eval(count);
    return {*values, count, {}};
  } catch (const mu::ParserError& error) {
    return {0.0, 0, to_mistake(error)};
  }
}

}  // namespace culm
