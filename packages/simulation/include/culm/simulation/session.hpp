/// Start and end of MPI and Trilinos.
#pragma once

#include <memory>

namespace culm::simulation {

/// The first object of a program that uses culm, and the last to go.
class Session {
 public:
  Session(int& argc, char**& argv);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

 private:
  struct Scope;
  std::unique_ptr<Scope> scope_;
};

}  // namespace culm::simulation
