/// What the adapter uses of preCICE 3, for tests where the library is not installed. Behind it, in
/// the same process, is a partner of the package `coupling` at each vertex, and an implicit scheme.
///
/// The configuration is a text of words and numbers:
///   mass 5  window 0.02  windows 50  waveform 0  ends-at 0  dimensions 3  record FILE
/// waveform 0: loads are constant in a time window, as a program gives them that knows their mean;
/// 1: linear from the start of the window to its end. ends-at: the partner fails in this window.
#pragma once

#include <memory>
#include <span>
#include <stdexcept>
#include <string_view>

namespace precice {

using VertexID = int;

class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Participant {
 public:
  Participant(std::string_view name, std::string_view configuration, int rank, int size);
  ~Participant();

  int getMeshDimensions(std::string_view mesh) const;
  int getDataDimensions(std::string_view mesh, std::string_view data) const;
  void setMeshVertices(std::string_view mesh, std::span<const double> coordinates,
                       std::span<VertexID> ids);
  bool requiresInitialData();
  void initialize();
  bool isCouplingOngoing() const;
  bool isTimeWindowComplete() const;
  double getMaxTimeStepSize() const;
  bool requiresWritingCheckpoint();
  bool requiresReadingCheckpoint();
  void readData(std::string_view mesh, std::string_view data, std::span<const VertexID> ids,
                double time, std::span<double> values) const;
  void writeData(std::string_view mesh, std::string_view data, std::span<const VertexID> ids,
                 std::span<const double> values);
  void advance(double length);
  void finalize();

 private:
  struct Coupling;
  std::unique_ptr<Coupling> coupling_;
};

}  // namespace precice
