/// A deck as a participant of preCICE.
#pragma once

#include <string>
#include <vector>

namespace culm::adapter {

/// Who takes part, and with what. Names of preCICE are those of its configuration.
struct Settings {
  std::string deck;
  std::vector<std::string> overrides;  ///< of the deck, such as "Analyses/gust/Step=0.01"
  std::string analysis;                ///< that makes the steps; the first one if empty
  std::string port;                    ///< whose points are the vertices of the mesh
  std::string configuration;           ///< the file
  std::string participant = "Structure";
  std::string mesh = "Structure-Mesh";
  std::string displacement = "Displacement";  ///< written [m]
  std::string force = "Force";                ///< read [N]
  std::string moment;                         ///< read [N m]; none if empty
  std::string table;                          ///< file for what is exchanged; none if empty
};

/// Exit code: preCICE or another participant ended the coupling.
constexpr int left = 9;

/// Makes all steps that preCICE asks for. Throws Failure, or what preCICE throws; the table then
/// holds all time windows before.
void couple(const Settings& settings);

}  // namespace culm::adapter
