/// Sections along a beam.
#pragma once

#include <culm/base/schema.hpp>
#include <culm/material/section.hpp>

#include <map>
#include <string>
#include <vector>

namespace culm::beam {

/// Sections at places of the relative span, linear between them and constant beyond.
class SectionTable {
 public:
  /// One section all along.
  /// @param rotary_inertia  factor on that about the centre of mass of each section
  explicit SectionTable(material::Section section, double rotary_inertia = 1.0);
  /// @pre as many positions as sections, at least one, not descending
  SectionTable(std::vector<material::Section> sections, std::vector<double> positions,
               double rotary_inertia = 1.0);

  /// Section at a span in [0, 1].
  material::Section at(double span) const;
  /// Mean of the mass per length between two spans, exact [kg/m]. @pre from < to
  double mean_mass(double from, double to) const;
  /// Whether the sections are made of fibres that yield.
  bool yields() const { return !sections_.front().fibres.empty(); }

 private:
  std::vector<material::Section> sections_;
  std::vector<double> positions_;
  double rotary_inertia_;
};

/// `Section`, or `Sections` with `Section Positions`, the rules between them, `Rotary Inertia`.
void add_section_fields(Schema& schema);

/// The table that the fields describe. Throws InputError for names that are not among `sections`.
SectionTable read_sections(const Options& options,
                           const std::map<std::string, material::Section>& sections);

}  // namespace culm::beam
