/// The verbs of the application, one file each.
#pragma once

#include <culm/openfast/import.hpp>
#include <culm/parallel/comm.hpp>
#include <culm/simulation/simulation.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace culm::app {

/// A deck and what the command line changes about it.
struct DeckArguments {
  std::string deck;
  std::vector<std::string> overrides;  ///< path=value
  std::string memory;                  ///< what it may take; empty for that of the machine
  bool quiet = false;
};

/// Programs beside culm in a run, and what culm says to whoever started it.
struct PartnerArguments {
  std::string partner_command;    ///< starts the partner; nobody is if empty
  int ranks = 0;                  ///< so many of the processes are ours; all if zero
  std::filesystem::path verdict;  ///< file for the exit code; none if empty
  bool plain = false;             ///< what looks like a terminal is none
  bool needs_launcher = false;    ///< set by the verb: the partner comes by MPI, nothing was run
  std::filesystem::path started;  ///< set by the verb: folder of results, when there are some
};

/// A deck to run.
struct RunArguments : DeckArguments, PartnerArguments {
  bool strict = false;           ///< warnings count as broken promises
  std::filesystem::path folder;  ///< for results; results/<name of the deck> if empty
  std::string walltime;          ///< time the run may take; empty for any
  bool report = false;           ///< whether a page is wanted
};

/// A deck to look at, and where to write it as it is used.
struct CheckArguments : DeckArguments {
  std::filesystem::path resolved;  ///< file for the deck with all defaults; none if empty
  std::filesystem::path view;      ///< page to show the model; none if empty
  std::filesystem::path model;     ///< set by check() on rank 0: temporary folder to draw it from
};

/// A run to go on with, and what changes about it.
struct ResumeArguments : PartnerArguments {
  std::filesystem::path run;           ///< folder of results, or a checkpoint
  std::string deck;                    ///< in place of that of the run; empty for that one
  std::vector<std::string> overrides;  ///< path=value, after those of the run
  std::string memory;                  ///< what it may take; empty for that of the machine
  std::string walltime;
  bool strict = false;  ///< warnings count as broken promises
  bool quiet = false;
  std::string address;  ///< where a program comes to that leads; nobody does if empty
  std::string port;     ///< at which it does; the only one of the deck if empty
  double patience = 600.0;
};

/// Files of another program, and the deck to make of them.
struct ImportArguments {
  std::filesystem::path file;
  std::filesystem::path deck;  ///< to write; name of the file with .xml if empty
  openfast::TurbineOptions turbine;
  bool quiet = false;
};

/// A deck to run with a partner at one of its ports, in the words of the command line; what is
/// empty is as the deck has it.
struct CoupleArguments : RunArguments {
  std::string partner;  ///< its type
  std::string mass, damping, stiffness, address;
  std::string port;
  std::string scheme, window, tolerance;
  bool parallel = false;
  bool record = false;
};

/// A record of a coupling, or the folder with those of all partners, and the deck that takes its
/// loads again, or a partner that is asked again.
struct ReplayArguments : RunArguments {
  std::filesystem::path record;
  std::string partner;  ///< where it comes to, in place of a deck
  double patience = 600.0;
};

/// What to print of the input reference.
struct ReferenceArguments {
  std::string name;       ///< a list, type or parameter; everything if empty
  bool relax_ng = false;  ///< as a grammar
};

/// A deck whose steps another program makes.
struct ServeArguments : RunArguments {
  std::string address;  ///< where it comes to
  std::string port;     ///< the only one of the deck if empty
  double patience = 600.0;
};

/// Runs a deck.
/// @param replay  a record, or a folder of them, whose loads act in place of those of the partners;
/// empty for none
/// @param serve   another program that leads; nobody if it has no address
void run(const parallel::Comm& comm, RunArguments& arguments,
         const std::filesystem::path& replay = {}, const simulation::ServeSettings& serve = {});
/// Goes on with a run from its last checkpoint.
void resume(const parallel::Comm& comm, ResumeArguments& arguments);
/// Parses, builds, counts and validates a deck without solving it.
void check(const parallel::Comm& comm, CheckArguments& arguments);
/// Runs a deck together with a partner.
void couple(const parallel::Comm& comm, CoupleArguments& arguments);
/// Runs a deck with the loads of a record, and compares how it moves; or asks a partner what the
/// record says, and compares what it answers.
void replay(const parallel::Comm& comm, ReplayArguments& arguments);
/// Runs a deck as another program asks for it.
void serve(const parallel::Comm& comm, ServeArguments& arguments);
/// Makes a deck from files of OpenFAST, and a report beside it; replaces nothing.
void import_openfast(const parallel::Comm& comm, const ImportArguments& arguments);
/// Prints the input reference, the part of it that has a name, or its grammar.
void reference(const parallel::Comm& comm, const ReferenceArguments& arguments);

}  // namespace culm::app
