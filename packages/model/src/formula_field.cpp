#include <culm/base/error.hpp>
#include <culm/base/formula.hpp>
#include <culm/base/text.hpp>

#include "vector_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace culm::model {
namespace {

constexpr std::array<const char*, 3> components = {"X", "Y", "Z"};

// One component. The formula points to its variables, so it stays where it is.
struct Component {
  explicit Component(const std::string& text) {
    formula.set_constants({{"pi", std::numbers::pi}, {"e", std::numbers::e}});
    formula.add_variable("t", time);
    formula.add_variable("x", place[0]);
    formula.add_variable("y", place[1]);
    formula.add_variable("z", place[2]);
    formula.set_text(text);
  }
  Component(const Component&) = delete;
  Component& operator=(const Component&) = delete;
  ~Component() = default;

  Formula::Result at(const Vec3& x, double t) {
    place = x;
    time = t;
    return formula.evaluate();
  }

  Formula formula;
  Vec3 place = Vec3::Zero();
  double time = 0.0;
};

class FormulaField final : public VectorField {
 public:
  explicit FormulaField(const Options& options) {
    for (std::size_t i = 0; i < 3; ++i) {
      formulas_[i] = std::make_unique<Component>(options.text(components[i]));
      where_[i] = options.where(components[i]);
    }
  }

  Vec3 value(const Vec3& place, double time) const override {
    Vec3 vector;
    for (std::size_t i = 0; i < 3; ++i) {
      const double one = formulas_[i]->at(place, time).value;
      if (!std::isfinite(one)) {
        throw InputError(where_[i], "must be finite, is " + format_number(one) + " at (" +
                                        format_number(place[0]) + ", " + format_number(place[1]) +
                                        ", " + format_number(place[2]) +
                                        ") at t = " + format_number(time) + " s");
      }
      vector[static_cast<Eigen::Index>(i)] = one;
    }
    return vector;
  }

  bool varies_in_time() const override {
    return std::ranges::any_of(formulas_, [](const auto& one) { return one->formula.uses("t"); });
  }

  // differences of fourth order: their error is as small as their rounding
  Mat3 gradient(const Vec3& place, double time) const override {
    const double h = 1e-3 * std::max(1.0, place.lpNorm<Eigen::Infinity>());
    Mat3 gradient;
    for (int j = 0; j < 3; ++j) {
      const auto at = [&](double step) { return value(place + step * h * Vec3::Unit(j), time); };
      gradient.col(j) = (at(-2.0) - 8.0 * at(-1.0) + 8.0 * at(1.0) - at(2.0)) / (12.0 * h);
    }
    return gradient;
  }

 private:
  std::array<std::unique_ptr<Component>, 3> formulas_;
  std::array<Where, 3> where_;
};

void check(const Options& options, InputIssues& issues) {
  for (const char* name : components) {
    const std::string& text = options.text(name);
    const Formula::Result result = Component(text).at(Vec3::Zero(), 0.0);
    std::string reason = "must be a formula in x, y, z and t, got '" + shortened(text, 200) + "'";
    if (result.mistake) {
      issues.add(options.where(name),
                 reason + " (" + std::string(trim(result.mistake->reason)) + ")");
    } else if (result.count != 1) {
      issues.add(options.where(name), "must be one formula, got '" + shortened(text, 200) + "'");
    }
  }
}

}  // namespace

void register_formula_field(FieldRegistry& registry) {
  Schema schema("Formula", "Formulas in the place x, y, z [m] and the time t [s].");
  for (const char* name : components) {
    schema.add(text(name, "Component in space; may use variables of the deck.")
                   .formula_in("x, y, z, t")
                   .optional("0"));
  }
  schema.check(check);
  registry.add("Formula", schema, [](const Options& options) -> SharedField {
    return std::make_shared<FormulaField>(options);
  });
}

}  // namespace culm::model
