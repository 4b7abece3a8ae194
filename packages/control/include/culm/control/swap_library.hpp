/// Controllers of wind turbines in shared objects, with the interface of Bladed.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace culm::control {

/// A procedure void DISCON(float* avrSWAP, int* aviFAIL, char* accINFILE, char* avcOUTNAME, char*
/// avcMSG) of a shared object, and the numbers that both sides exchange, by records from 1.
/// @source DNV GL, Bladed User Manual 4.8 (2016), appendix A; OpenFAST, BladedInterface.f90, for
///   the records
class SwapLibrary {
 public:
  static constexpr int records = 4096;
  static constexpr int message_size = 1024;

  /// Records with a name.
  struct Record {
    std::string_view name;
    int number;
  };
  static constexpr std::array<Record, 13> measured = {{{"pitch 1", 4},
                                                       {"pitch 2", 33},
                                                       {"pitch 3", 34},
                                                       {"shaft power", 14},
                                                       {"electrical power", 15},
                                                       {"generator speed", 20},
                                                       {"rotor speed", 21},
                                                       {"generator torque", 23},
                                                       {"yaw error", 24},
                                                       {"wind speed", 27},
                                                       {"nacelle angle", 37},
                                                       {"tower top acceleration", 53},
                                                       {"azimuth", 60}}};
  static constexpr std::array<Record, 9> demanded = {{{"generator contactor", 35},
                                                      {"brake", 36},
                                                      {"yaw torque", 41},
                                                      {"pitch 1", 42},
                                                      {"pitch 2", 43},
                                                      {"pitch 3", 44},
                                                      {"pitch", 45},
                                                      {"generator torque", 47},
                                                      {"yaw rate", 48}}};

  /// What the library is told of a call.
  enum class Status { first = 0, later = 1, last = -1 };

  /// Loads it, with a memory of its own. Throws FileError if there is no such library or no such
  /// procedure in it.
  /// @param input  a file that the library may read; empty for none
  /// @param name   what the library may call its own files
  SwapLibrary(const std::string& path, const std::string& procedure, std::string input,
              std::string name);

  /// Sets a record for the calls to come. @param record  from 1
  void set(int record, double value) { swap_[at(record)] = static_cast<float>(value); }
  double get(int record) const { return swap_[at(record)]; }
  /// @param since  time since the last call [s]
  /// @return a warning, empty if there is none. Throws NumericalError with the library's message
  /// where it reports a failure.
  std::string call(Status status, double time, double since);

 private:
  using Procedure = void (*)(float*, int*, char*, char*, char*);
  struct Close {
    void operator()(void* handle) const;
  };
  static std::size_t at(int record) { return static_cast<std::size_t>(record - 1); }

  std::string path_, input_, name_;
  std::unique_ptr<void, Close> handle_;
  Procedure procedure_ = nullptr;
  std::vector<float> swap_;
};

}  // namespace culm::control
