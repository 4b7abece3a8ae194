/// A deck that tests drive step by step.
#pragma once

#include <culm/simulation/simulation.hpp>

#include <sstream>
#include <string>

namespace culm::simulation {

/// A beam of 1 m along x, bent and then moved. @param lists  of the deck, such as its loads
inline std::string beam_deck(const std::string& lists) {
  return R"(<ParameterList name="culm">
  <ParameterList name="Sections"><ParameterList name="bar">
    <Parameter name="Type" value="Stiffness Values"/>
    <Parameter name="EA" value="100"/> <Parameter name="GA1" value="50"/>
    <Parameter name="GA2" value="50"/> <Parameter name="EI1" value="2"/>
    <Parameter name="EI2" value="2"/> <Parameter name="GIp" value="1"/>
    <Parameter name="rhoA" value="1"/> <Parameter name="rhoI1" value="0.01"/>
    <Parameter name="rhoI2" value="0.01"/>
  </ParameterList></ParameterList>
  <ParameterList name="Structures"><ParameterList name="beam">
    <Parameter name="Type" value="Beam"/> <Parameter name="Section" value="bar"/>
    <ParameterList name="Curve">
      <Parameter name="Type" value="Line"/> <Parameter name="From" value="{0, 0, 0}"/>
      <Parameter name="To" value="{1, 0, 0}"/> <Parameter name="Elements" value="3"/>
    </ParameterList>
  </ParameterList></ParameterList>
  )" + lists +
         R"(
  <ParameterList name="Analyses">
    <ParameterList name="bending">
      <Parameter name="Type" value="Static"/> <Parameter name="Steps" value="2"/>
    </ParameterList>
    <ParameterList name="modes">
      <Parameter name="Type" value="Modal"/> <Parameter name="Modes" value="1"/>
    </ParameterList>
    <ParameterList name="motion">
      <Parameter name="Type" value="Dynamic"/> <Parameter name="Start Time" value="0"/>
      <Parameter name="End Time" value="0.5"/> <Parameter name="Step" value="0.05"/>
    </ParameterList>
  </ParameterList>
  <ParameterList name="Output"><ParameterList name="History"><ParameterList name="end">
    <Parameter name="Type" value="Displacement"/> <Parameter name="Node" value="beam/last"/>
  </ParameterList></ParameterList></ParameterList>
</ParameterList>)";
}

/// Holds its first end.
inline const std::string clamp = R"(<ParameterList name="Constraints"><ParameterList name="clamp">
    <Parameter name="Type" value="Rigid Support"/> <Parameter name="Node" value="beam/first"/>
  </ParameterList></ParameterList>)";

/// The same with a load in the list of loads.
inline std::string cantilever(const std::string& load) {
  return beam_deck(clamp + R"(<ParameterList name="Loads">)" + load + "</ParameterList>");
}

/// A simulation of a deck in memory.
struct Live {
  explicit Live(const std::string& text)
      : source{{{"deck.xml", text}}, {}},
        simulation(parallel::Comm(), catalogue, read_deck(catalogue, source), source,
                   Log(said, LogLevel::info)) {}

  Catalogue catalogue;
  DeckSource source;
  std::ostringstream said;
  Simulation simulation;
};

}  // namespace culm::simulation
