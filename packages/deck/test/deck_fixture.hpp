#pragma once

#include <culm/base/error.hpp>
#include <culm/deck/deck.hpp>

#include <string>
#include <vector>

namespace culm::deck {

/// The schema of a small world: enough to show every kind of list and value.
inline Schema world() {
  const Schema top =
      Schema("Rigid Body", "A body that does not deform.")
          .add(number("Mass", "kg", "Mass.").positive())
          .add(numbers("Inertia", "kg m^2", "About the axes.").size(3).positive())
          .add(numbers("Position", "m", "Of the centre.").size(3).optional({0, 0, 0}))
          .add(flag("Fixed", "Whether it stands still.").optional(false));
  const Schema tube = Schema("Tube").add(number("Radius", "m", "Outer radius.").positive());
  const Schema box =
      Schema("Box").add(numbers("Sides", "m", "Width and height.").size(2).positive());
  const Schema beam = Schema("Beam", "A chain of elements.")
                          .add(number("Length", "m", "Length.").positive())
                          .add(integer("Elements", "Number of elements.").at_least(1).optional(4))
                          .add(choice("Strains", {"full", "reduced"}, "Which.").optional("full"))
                          .add(number("Damping", "1/s", "Absent: none.").non_negative().optional())
                          .add(text("Motion", "Of the root.").formula_in("t").optional())
                          .add(texts("Tags", "Any words.").optional(std::vector<std::string>{}))
                          .add(integers("Nodes", "Numbers of nodes.").optional(std::vector<int>{}))
                          .list_by_type("Section", {{"Tube", tube}, {"Box", box}})
                          .check([](const Options& options, InputIssues& issues) {
                            if (options.number("Length") > 100.0 * options.integer("Elements")) {
                              issues.add(options.where("Length"), "elements are longer than 100 m");
                            }
                          });
  const Schema solver = Schema("Newton").add(number("Tolerance", "", "Of it.").optional(1e-9));
  return Schema("culm", "A whole deck.")
      .add(text("Title", "For people.").optional(""))
      .list("Structures",
            Schema("Structures").entries_by_type({{"Rigid Body", top}, {"Beam", beam}}))
      .list("Time", Schema("Time").add(number("End", "s", "Last instant.").positive()),
            Presence::optional)
      .list_by_type("Solver", {{"Newton", solver}}, Presence::defaulted, "Newton");
}

/// A deck of the small world around the content of its list "Structures", which begins in line 3.
inline std::string deck_around(const std::string& structures) {
  return "<ParameterList name=\"culm\">\n<ParameterList name=\"Structures\">\n" + structures +
         "\n</ParameterList>\n</ParameterList>\n";
}

/// A sound body in one line, with further content.
inline std::string body(const std::string& more = "") {
  return "<ParameterList name=\"top\"><Parameter name=\"Type\" value=\"Rigid Body\"/>"
         "<Parameter name=\"Mass\" value=\"15\"/>"
         "<Parameter name=\"Inertia\" value=\"{1, 2, 3}\"/>" +
         more + "</ParameterList>";
}

/// A beam with a sound section, one line, with further content.
inline std::string beam(const std::string& more) {
  return "<ParameterList name=\"beam\"><Parameter name=\"Type\" value=\"Beam\"/>"
         "<ParameterList name=\"Section\"><Parameter name=\"Type\" value=\"Tube\"/>"
         "<Parameter name=\"Radius\" value=\"0.1\"/></ParameterList>" +
         more + "</ParameterList>";
}

inline Options read(const std::string& text, const Overrides& overrides = {}) {
  return Deck::parse_text(text, "deck.xml", overrides).validate(world());
}

/// What is wrong with a deck, line by line; "" if nothing is.
inline std::string mistakes(const std::string& text, const Overrides& overrides = {}) {
  try {
    read(text, overrides);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace culm::deck
