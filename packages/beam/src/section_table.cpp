#include <culm/base/error.hpp>
#include <culm/base/options.hpp>
#include <culm/beam/section_table.hpp>
#include <culm/beam/span_table.hpp>

#include <utility>

namespace culm::beam {

SectionTable::SectionTable(material::Section section, double rotary_inertia)
    : sections_{std::move(section)}, positions_{0.0}, rotary_inertia_(rotary_inertia) {}

SectionTable::SectionTable(std::vector<material::Section> sections, std::vector<double> positions,
                           double rotary_inertia)
    : sections_(std::move(sections)),
      positions_(std::move(positions)),
      rotary_inertia_(rotary_inertia) {}

material::Section SectionTable::at(double span) const {
  const TablePlace place = table_place(positions_, span);
  material::Section section =
      material::interpolate(sections_[place.first], sections_[place.second], place.t);
  if (rotary_inertia_ != 1.0) {
    section.mass = material::with_rotary_inertia(section.mass, rotary_inertia_);
  }
  return section;
}

// Of a linear piece the mean is the value in its middle.
double SectionTable::mean_mass(double from, double to) const {
  std::vector<double> ends{from};
  for (const double position : positions_) {
    if (position > from && position < to && position > ends.back()) ends.push_back(position);
  }
  ends.push_back(to);
  double integral = 0.0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    integral += (ends[i + 1] - ends[i]) * at(0.5 * (ends[i] + ends[i + 1])).mass(0, 0);
  }
  return integral / (to - from);
}

void add_section_fields(Schema& schema) {
  schema.add(text("Section", "Section all along, by its name in Sections.").optional())
      .add(texts("Sections", "Sections along the axis, by their names in Sections, instead of one.")
               .min_size(1)
               .optional())
      .add(numbers("Section Positions", "1",
                   "Places of these sections, 0 at the start and 1 at the end of the axis; linear "
                   "between them.")
               .between(0.0, 1.0)
               .optional())
      .add(
          number("Rotary Inertia", "1",
                 "Factor on the inertia of sections against turning about their centres of mass; 0 "
                 "leaves their masses at these centres.")
              .non_negative()
              .optional(1.0))
      .check([](const Options& beam, InputIssues& issues) {
        if (beam.has("Section") == beam.has("Sections")) {
          issues.add(beam.where(), "give one of 'Section' and 'Sections'");
        } else if (beam.has("Sections") != beam.has("Section Positions")) {
          issues.add(beam.where(), "'Sections' and 'Section Positions' need each other");
        } else if (beam.has("Sections")) {
          check_positions(beam, "Section Positions", beam.texts("Sections").size(), issues);
        }
      });
}

SectionTable read_sections(const Options& options,
                           const std::map<std::string, material::Section>& sections) {
  const std::string field = options.has("Section") ? "Section" : "Sections";
  const auto find = [&](const std::string& name) {
    const auto found = sections.find(name);
    if (found == sections.end()) {
      std::vector<std::string> known;
      for (const auto& [one, section] : sections) known.push_back(one);
      throw InputError(options.where(field),
                       "unknown section '" + name + "'" + did_you_mean(name, known));
    }
    return found->second;
  };
  const double rotary = options.number("Rotary Inertia");
  if (options.has("Section")) return SectionTable(find(options.text("Section")), rotary);
  std::vector<material::Section> along;
  for (const std::string& name : options.texts("Sections")) along.push_back(find(name));
  for (const material::Section& section : along) {
    if (section.pattern == along.front().pattern) continue;
    throw InputError(options.where(field),
                     "sections along one beam must yield with the same 'Type' and 'Cells', or all "
                     "be elastic");
  }
  return {std::move(along), options.numbers("Section Positions"), rotary};
}

}  // namespace culm::beam
