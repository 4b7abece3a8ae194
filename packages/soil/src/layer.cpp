#include <culm/soil/api_curves.hpp>
#include <culm/soil/layer.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <utility>

namespace culm::soil {
namespace {

// A value at a depth, linear between those of a table and constant beyond.
double at_depth(const std::vector<double>& depths, const std::vector<double>& values, double X) {
  if (X <= depths.front()) return values.front();
  for (std::size_t i = 1; i < depths.size(); ++i) {
    if (X > depths[i]) continue;
    const double t = (X - depths[i - 1]) / (depths[i] - depths[i - 1]);
    return (1.0 - t) * values[i - 1] + t * values[i];
  }
  return values.back();
}

bool rises(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
}

Schema layer_schema(std::string type, std::string doc) {
  Schema schema(std::move(type), std::move(doc));
  schema.add(number("Top", "m",
                    "Depth below the ground at which the layer begins; it ends where the next one "
                    "does, the last one nowhere.")
                 .non_negative());
  return schema;
}

// Of a layer whose own curves do not depend on it.
Field weight_upon_others() {
  return number("Unit Weight", "N/m^3",
                "Effective weight per volume, which presses layers below; if absent, that of the "
                "next layer below that has one.")
      .positive()
      .optional();
}

// --- shafts ------------------------------------------------------------------------------------

// Resistance of the shaft along the pile, with the shape of its curve.
void add_shaft(const std::string& shape, Schema& schema, Schema more = Schema("")) {
  Schema shaft("Shaft", "Resistance of the shaft against motions along the pile, t-z.");
  shaft.add(number("Friction", "N/m^2", "The largest friction between pile and soil.").positive())
      .add_all(more);
  schema.list("Shaft", fractions_schema(std::move(shaft)), Presence::optional)
      .check([shape](const Options& options, InputIssues& issues) {
        if (!shape.empty() || !options.has_list("Shaft")) return;
        const Options& list = options.list("Shaft");
        if (list.has("Displacements")) return;
        issues.add(list.where(), "needs 'Displacements' and 'Fractions'");
      });
}

SharedCurve shaft_of(const Options& options, const ShaftTable& table, const Pile& pile) {
  if (!options.has_list("Shaft")) return nullptr;
  const Options& shaft = options.list("Shaft");
  const double resistance = std::numbers::pi * pile.diameter * shaft.number("Friction");
  return fractions_curve(shaft, table.displacements, table.fractions, resistance,
                         TableCurve::Sides::both);
}

// --- types -------------------------------------------------------------------------------------

void register_sand(LayerRegistry& registry) {
  Schema schema = layer_schema("Sand", "Sand by the formulas of API RP 2A.");
  schema
      .add(number("Friction Angle", "rad", "Angle of internal friction.")
               .greater_than(0.0)
               .less_than(1.2))
      .add(number("Unit Weight", "N/m^3",
                  "Effective weight per volume; formulas take the mean of all that lies above.")
               .positive())
      .add(number("Initial Modulus", "N/m^3", "Growth of the initial lateral stiffness per depth.")
               .positive());
  add_shaft("sand", schema);
  registry.add("Sand", schema, [](const Options& options) -> Layer {
    return [options](const Depth& depth, const Pile& pile) {
      const Sand sand{options.number("Friction Angle"), depth.unit_weight,
                      options.number("Initial Modulus")};
      return Grip{std::make_shared<SandCurve>(sand, depth.below, pile.diameter, pile.cyclic),
                  shaft_of(options, sand_shaft(), pile)};
    };
  });
}

void register_clay(LayerRegistry& registry) {
  Schema schema = layer_schema("Clay", "Soft clay by the formulas of Matlock and API RP 2A.");
  schema
      .add(number("Strength", "N/m^2", "Undrained shear strength at the top of the layer.")
               .positive())
      .add(number("Strength Growth", "N/m^3", "Its growth per depth.").non_negative().optional(0.0))
      .add(number("Unit Weight", "N/m^3",
                  "Effective weight per volume; formulas take the mean of all that lies above.")
               .positive())
      .add(number("Strain", "1", "Strain at half of the strength, epsilon 50.").positive())
      .add(number("J", "1", "Factor of shallow resistance: 0.5 in soft, 0.25 in stiffer clay.")
               .non_negative()
               .optional(0.5));
  Schema more("");
  more.add(number("Residual", "1", "Fraction that is left beyond 0.02 diameters.")
               .between(0.0, 1.0)
               .optional(0.9));
  more.check([](const Options& options, InputIssues& issues) {
    if (!options.given("Residual") || !options.has("Displacements")) return;
    issues.add(options.where("Residual"),
               "is of the curve of API RP 2A, but 'Displacements' gives another");
  });
  add_shaft("clay", schema, more);
  registry.add("Clay", schema, [](const Options& options) -> Layer {
    return [options](const Depth& depth, const Pile& pile) {
      const double X = depth.below;
      const Clay clay{options.number("Strength") +
                          options.number("Strength Growth") * (X - options.number("Top")),
                      depth.unit_weight, options.number("Strain"), options.number("J")};
      const double residual =
          options.has_list("Shaft") ? options.list("Shaft").number("Residual") : 0.0;
      return Grip{std::make_shared<ClayCurve>(clay, X, pile.diameter, pile.cyclic),
                  shaft_of(options, clay_shaft(pile.diameter, residual), pile)};
    };
  });
}

void check_same_size(const char* one, const char* other, const Options& options,
                     InputIssues& issues) {
  const std::size_t expected = options.numbers(one).size();
  if (options.numbers(other).size() == expected) return;
  issues.add(options.where(other), fmt::format("must have as many values as '{}', {}, got {}", one,
                                               expected, options.numbers(other).size()));
}

void register_springs(LayerRegistry& registry) {
  Schema schema = layer_schema("Springs", "Springs that never yield, by depth.");
  schema.add(weight_upon_others());
  schema.add(numbers("Depths", "m", "Depths below the ground, rising.").min_size(1))
      .add(numbers("Stiffnesses", "N/m^2",
                   "Lateral stiffness per length at the depths, linear in between.")
               .non_negative())
      .add(numbers("Axial Stiffnesses", "N/m^2", "The same along the pile; none if absent.")
               .non_negative()
               .optional())
      .check([](const Options& options, InputIssues& issues) {
        if (!rises(options.numbers("Depths"))) issues.add(options.where("Depths"), "must rise");
        check_same_size("Depths", "Stiffnesses", options, issues);
        if (options.has("Axial Stiffnesses")) {
          check_same_size("Depths", "Axial Stiffnesses", options, issues);
        }
      });
  registry.add("Springs", schema, [](const Options& options) -> Layer {
    return [options](const Depth& depth, const Pile&) {
      const auto curve = [&](const char* name) {
        return std::make_shared<LinearCurve>(
            at_depth(options.numbers("Depths"), options.numbers(name), depth.below));
      };
      Grip grip{curve("Stiffnesses"), nullptr};
      if (options.has("Axial Stiffnesses")) grip.axial = curve("Axial Stiffnesses");
      return grip;
    };
  });
}

void check_table(const Options& options, InputIssues& issues) {
  const auto& depths = options.numbers("Depths");
  const auto& y = options.numbers("Displacements");
  if (!rises(depths)) issues.add(options.where("Depths"), "must rise");
  if (!rises(y) || y.front() <= 0.0) {
    issues.add(options.where("Displacements"), "must rise, above zero");
  }
  const std::size_t expected = depths.size() * y.size();
  if (options.numbers("Forces").size() == expected) return;
  issues.add(options.where("Forces"),
             fmt::format("must have a value for each of {} displacements at each of {} depths, {} "
                         "in all, got {}",
                         y.size(), depths.size(), expected, options.numbers("Forces").size()));
}

void register_table(LayerRegistry& registry) {
  Schema schema = layer_schema("Table", "Curves p-y by points, at some depths.");
  schema.add(weight_upon_others());
  schema.add(numbers("Depths", "m", "Depths below the ground, rising.").min_size(1))
      .add(numbers("Displacements", "m",
                   "Displacements of the points, rising; zero is left out, beyond the last one the "
                   "force is constant.")
               .min_size(1))
      .add(numbers("Forces", "N/m",
                   "Lateral forces per length: those of the first depth, then the next; linear "
                   "between depths.")
               .non_negative())
      .check(check_table);
  add_shaft("", schema);
  registry.add("Table", schema, [](const Options& options) -> Layer {
    return [options](const Depth& depth, const Pile& pile) {
      const auto& all = options.numbers("Forces");
      const auto& points = options.numbers("Displacements");
      const auto& depths = options.numbers("Depths");
      std::vector<double> y{0.0};
      std::vector<double> p{0.0};
      for (std::size_t k = 0; k < points.size(); ++k) {
        std::vector<double> by_depth;
        for (std::size_t i = 0; i < depths.size(); ++i) {
          by_depth.push_back(all[i * points.size() + k]);
        }
        y.push_back(points[k]);
        p.push_back(at_depth(depths, by_depth, depth.below));
      }
      return Grip{std::make_shared<TableCurve>(y, p, TableCurve::Sides::both),
                  shaft_of(options, {}, pile)};
    };
  });
}

}  // namespace

Schema fractions_schema(Schema schema) {
  schema
      .add(
          numbers("Displacements", "m",
                  "Displacements of the points of the curve, rising, without zero; those of API RP "
                  "2A if absent.")
              .min_size(1)
              .optional())
      .add(
          numbers("Fractions", "1", "Fractions of the resistance there.").non_negative().optional())
      .check([](const Options& options, InputIssues& issues) {
        if (options.has("Displacements") != options.has("Fractions")) {
          issues.add(options.where(), "'Displacements' and 'Fractions' need each other");
          return;
        }
        if (!options.has("Displacements")) return;
        const auto& z = options.numbers("Displacements");
        if (!rises(z) || z.front() <= 0.0) {
          issues.add(options.where("Displacements"), "must rise, above zero");
        }
        check_same_size("Displacements", "Fractions", options, issues);
      });
  return schema;
}

SharedCurve fractions_curve(const Options& list, const std::vector<double>& displacements,
                            const std::vector<double>& fractions, double resistance,
                            TableCurve::Sides sides) {
  std::vector<double> z = displacements;
  std::vector<double> forces = fractions;
  if (list.has("Displacements")) {
    z = list.numbers("Displacements");
    forces = list.numbers("Fractions");
    z.insert(z.begin(), 0.0);
    forces.insert(forces.begin(), 0.0);
  }
  for (double& force : forces) force *= resistance;
  return std::make_shared<TableCurve>(std::move(z), std::move(forces), sides);
}

void register_layers(LayerRegistry& registry) {
  register_sand(registry);
  register_clay(registry);
  register_springs(registry);
  register_table(registry);
}

}  // namespace culm::soil
