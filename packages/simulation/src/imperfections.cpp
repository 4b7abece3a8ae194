#include "imperfections.hpp"

#include <culm/base/error.hpp>
#include <culm/base/nearest.hpp>
#include <culm/base/text.hpp>
#include <culm/output/recorded_shape.hpp>

#include <Eigen/Core>
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <system_error>
#include <utility>

namespace culm::simulation {
namespace {

std::vector<Vec6> to_motions(std::span<const double> numbers) {
  std::vector<Vec6> motions;
  for (std::size_t i = 0; i + 5 < numbers.size(); i += 6) {
    motions.emplace_back(Eigen::Map<const Vec6>(&numbers[i]));
  }
  return motions;
}

}  // namespace

Schema imperfections_schema() {
  Schema shape("Shape", "A mode or buckling shape, as deviation of the geometry.");
  shape
      .add(text("Run",
                "Results folder, or run.h5, of a run with the same structures; this run if absent.")
               .optional())
      .add(text("Analysis",
                "Name of the analysis that found the shape. One of this run bends the geometry of "
                "the analyses after it."))
      .add(integer("Shape", "Number of the shape, from 1.").at_least(1).optional(1))
      .add(number("Amplitude", "m", "Largest displacement of a node; its sign turns the shape."));
  return Schema("Imperfections", "Deviations of the stress-free geometry by name; several add up.")
      .entries(std::move(shape));
}

Imperfections::Imperfections(const Options& deck, const std::set<std::string>& gives_shapes)
    : list_(deck.list("Imperfections")) {
  const std::vector<Options>& analyses = deck.list("Analyses").entries();
  InputIssues issues;
  for (const Options& entry : list_.entries()) {
    if (entry.has("Run")) continue;
    const std::string& source = entry.text("Analysis");
    const auto found = std::find_if(analyses.begin(), analyses.end(),
                                    [&](const Options& one) { return one.name() == source; });
    if (found == analyses.end()) {
      std::vector<std::string> names;
      for (const Options& analysis : analyses) names.push_back(analysis.name());
      issues.add(entry.where("Analysis"), "there is no analysis '" + source + "' in this deck" +
                                              did_you_mean(source, names));
      continue;
    }
    const std::string& type = found->text("Type");
    if (!gives_shapes.contains(type)) {
      const std::vector<std::string> types(gives_shapes.begin(), gives_shapes.end());
      issues.add(entry.where("Analysis"), "must be of type " + join(types, " or ") + ", '" +
                                              source + "' is of type " + type);
    } else if (entry.integer("Shape") > found->integer("Modes")) {
      issues.add(entry.where("Shape"),
                 fmt::format("'{}' looks for {} shapes, got {}", source, found->integer("Modes"),
                             entry.integer("Shape")));
    }
    if (std::next(found) == analyses.end()) {
      issues.add(entry.where("Analysis"),
                 "no analysis comes after '" + source + "', whose geometry the shape could bend");
    }
    sources_[entry.name()] = static_cast<std::size_t>(found - analyses.begin());
  }
  issues.throw_if_any();
}

std::set<std::string> Imperfections::unknown_in(std::size_t analysis) const {
  std::set<std::string> names;
  for (const auto& [name, source] : sources_) {
    if (source >= analysis) names.insert(name);
  }
  return names;
}

std::set<std::string> Imperfections::acting(const std::set<std::string>& inactive) const {
  std::set<std::string> names;
  for (const auto& [name, source] : sources_) {
    if (!inactive.contains(name)) names.insert(name);
  }
  return names;
}

void Imperfections::keep(const std::string& analysis, const model::Model& model,
                         const analysis::AnalysisReport& report) {
  for (const Options& entry : list_.entries()) {
    if (!sources_.contains(entry.name()) || entry.text("Analysis") != analysis) continue;
    const auto number = static_cast<std::size_t>(entry.integer("Shape"));
    if (number > report.shapes.size()) {
      throw InputError(entry.where("Shape"), fmt::format("'{}' found {} shapes, got {}", analysis,
                                                         report.shapes.size(), number));
    }
    const std::vector<Vec6>& motions = report.shapes[number - 1].real;
    for (const model::Structure& structure : model.structures()) {
      std::vector<Vec6>& own = found_[entry.name()][structure.name];
      own.clear();
      for (int node : structure.nodes) own.push_back(motions[static_cast<std::size_t>(node)]);
    }
  }
}

model::Imperfection Imperfections::sum(const std::set<std::string>& inactive) const {
  model::Imperfection imperfection;
  for (const Options& entry : list_.entries()) {
    if (inactive.contains(entry.name())) continue;
    Shape shape;
    if (entry.has("Run")) {
      std::error_code failure;
      if (!std::filesystem::exists(entry.text("Run"), failure)) {
        const std::string reason =
            failure ? "cannot be read: " + failure.message() : "is not there";
        throw FileError(
            shortened(entry.text("Run"), 200),
            reason + "; " + to_string(entry.where("Run")) + " asks for the shapes of this run");
      }
      for (const auto& [structure, numbers] : output::find_recorded_shape(
               entry.text("Run"), entry.text("Analysis"), entry.integer("Shape"))) {
        shape[structure] = to_motions(numbers);
      }
    } else if (const auto found = found_.find(entry.name()); found != found_.end()) {
      shape = found->second;
    } else {
      continue;
    }
    double largest = 0.0;
    for (const auto& [structure, motions] : shape) {
      for (const Vec6& motion : motions) largest = std::max(largest, motion.head<3>().norm());
    }
    if (largest == 0.0) throw InputError(entry.where("Shape"), "is a shape that moves no node");
    for (auto& [structure, motions] : shape) {
      for (Vec6& motion : motions) motion *= entry.number("Amplitude") / largest;
      imperfection.add(structure, motions, entry.where());
    }
  }
  return imperfection;
}

void Imperfections::save(Snapshot& snapshot) const {
  for (const auto& [name, shape] : found_) {
    for (const auto& [structure, motions] : shape) {
      std::vector<double> numbers;
      for (const Vec6& motion : motions)
        numbers.insert(numbers.end(), motion.begin(), motion.end());
      snapshot.set("imperfection/" + name + "/" + structure, std::move(numbers));
    }
  }
}

void Imperfections::restore(const Snapshot& snapshot, const model::Model& model) {
  for (const auto& [name, source] : sources_) {
    for (const model::Structure& structure : model.structures()) {
      const std::string key = "imperfection/" + name + "/" + structure.name;
      if (snapshot.has(key)) found_[name][structure.name] = to_motions(snapshot.numbers(key));
    }
  }
}

}  // namespace culm::simulation
