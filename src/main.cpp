// culm: nonlinear dynamics of slender structures, driven by decks.

#include <culm/base/error.hpp>
#include <culm/base/text.hpp>
#include <culm/coupling/partner_error.hpp>
#include <culm/parallel/first_ranks.hpp>
#include <culm/simulation/session.hpp>

#include "command.hpp"
#include "command_line.hpp"
#include "python.hpp"
#include "version.hpp"

#include <CLI/CLI.hpp>
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

// exit codes
constexpr int deck_error = 3;
constexpr int file_error = 6;

using culm::app::CheckArguments;
using culm::app::CoupleArguments;
using culm::app::DeckArguments;
using culm::app::ImportArguments;
using culm::app::ReferenceArguments;
using culm::app::ReplayArguments;
using culm::app::ResumeArguments;
using culm::app::RunArguments;
using culm::app::ServeArguments;

// What the user gives, by verb.
struct Arguments {
  RunArguments run;
  CheckArguments check;
  CoupleArguments couple;
  ReplayArguments replay;
  ServeArguments serve;

  /// The run that was asked for, with or without a partner.
  const RunArguments& any_run() const {
    if (!couple.deck.empty()) return couple;
    if (!serve.deck.empty()) return serve;
    return replay.record.empty() ? run : replay;
  }

  ResumeArguments resume;
  ImportArguments import;
  ReferenceArguments reference;

  /// How many of the processes are culm's; zero: all.
  int ranks() const { return std::max(any_run().ranks, resume.ranks); }
};

// An empty path is mostly a variable of a script that is not set; it would be taken for none given.
std::string refuse_empty(const std::string& path) {
  return path.empty() ? "needs a path, got ''" : "";
}

std::string refuse_no_command(const std::string& command) {
  return command.empty() ? "needs a command, got ''" : "";
}

template <class VerbArguments>
void add_common_options(CLI::App& verb, VerbArguments& arguments) {
  verb.add_option("--set", arguments.overrides,
                  "Replace a value: Structures/beam/Curve/Elements=32; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  verb.add_option("--max-memory", arguments.memory,
                  "Refuse models that need more: '16 GB'; the memory of the machine if not given");
  verb.add_flag("--quiet", arguments.quiet, "Print warnings and errors only");
}

void add_deck_options(CLI::App& verb, DeckArguments& arguments) {
  verb.add_option("deck", arguments.deck, "Input deck, XML")->required();
  add_common_options(verb, arguments);
}

void add_partner_options(CLI::App& verb, CoupleArguments& arguments) {
  verb.add_option("--partner", arguments.partner,
                  "Type of the partner: added-mass, dashpot, oscillator, random, socket")
      ->required();
  verb.add_option("--mass", arguments.mass, "Of a partner [kg]");
  verb.add_option("--damping", arguments.damping, "Of a partner [N s/m]");
  verb.add_option("--stiffness", arguments.stiffness, "Of a partner [N/m]");
  verb.add_option("--address", arguments.address,
                  "Where another program comes to: unix:PATH or tcp:PORT");
  verb.add_option("--port", arguments.port, "Its port; the only one of the deck if not given");
  verb.add_option("--scheme", arguments.scheme,
                  "quasi-newton, aitken, constant, explicit or one-way");
  verb.add_flag("--parallel", arguments.parallel,
                "Structure and partner work at the same time, on guesses of each other");
  verb.add_option("--window", arguments.window,
                  "From exchange to exchange [s]; a step if not given");
  verb.add_option("--tolerance", arguments.tolerance, "Of the loads, relative");
  verb.add_flag("--record", arguments.record, "Write all that is said beside the results");
}

// Where a program comes to that leads.
template <class VerbArguments>
CLI::Option* add_leader(CLI::App& verb, VerbArguments& arguments, const std::string& whence) {
  verb.add_option("--port", arguments.port, "The only port of the deck if not given");
  verb.add_option("--patience", arguments.patience, "How long it may be silent [s]; 600")
      ->check(CLI::PositiveNumber);
  return verb.add_option("--at", arguments.address,
                         whence + " comes to: unix:PATH, tcp:PORT, tcp:ADDRESS:PORT, or mpi:RANK");
}

void add_walltime(CLI::App& verb, std::string& walltime) {
  verb.add_option("--walltime", walltime,
                  "Write a checkpoint and stop, with exit code 7, before this time is over: "
                  "1:30:00 or '90 min'");
}

// How a run can end. @param strict  set by --strict
void add_ending(CLI::App& verb, bool& strict) {
  verb.add_flag("--strict", strict, "End with exit code 8 also where a warning was found");
  verb.footer(
      "Exit codes: 0 done; 1 a bug in culm; 2 command line; 3 deck; 4 did not solve; 5 not "
      "finite;\n"
      "6 files; 7 stopped on request; 8 done, all results are written, but a promise is broken:\n"
      "warnings on standard error and run.h5, /report/findings, say which; 9 a partner failed.");
}

void add_ranks(CLI::App& verb, int& ranks) {
  verb.add_option("--ranks", ranks,
                  "culm is the first so many processes of the launcher, others are partners");
}

void add_run_options(CLI::App& verb, RunArguments& arguments) {
  add_deck_options(verb, arguments);
  add_walltime(verb, arguments.walltime);
  verb.add_option("--output", arguments.folder,
                  "Folder for results; results/<name of the deck> if not given")
      ->check(refuse_empty);
  add_ending(verb, arguments.strict);
  add_ranks(verb, arguments.ranks);
  verb.add_flag("--report", arguments.report, "Write report.html beside the results");
  verb.add_option("--with", arguments.partner_command,
                  "Start the partner of type Socket by this command of the shell, and end it with "
                  "the run")
      ->check(refuse_no_command);
}

// Declares all verbs; the chosen one becomes `action`.
void declare_verbs(CLI::App& app, Arguments& arguments,
                   std::function<void(const culm::parallel::Comm&)>& action) {
  using culm::parallel::Comm;
  app.set_version_flag("--version", culm::app::version_text());
  app.require_subcommand(1);
  CLI::App* run = app.add_subcommand("run", "Run a deck");
  add_run_options(*run, arguments.run);
  run->callback([&] { action = [&](const Comm& comm) { culm::app::run(comm, arguments.run); }; });
  CLI::App* resume = app.add_subcommand("resume", "Go on with a run from its last checkpoint");
  resume
      ->add_option("run", arguments.resume.run, "Folder with the results of a run, or a checkpoint")
      ->required();
  resume
      ->add_option("--deck", arguments.resume.deck,
                   "Deck in place of that of the run; the model must be the same")
      ->check(refuse_empty);
  add_common_options(*resume, arguments.resume);
  add_ranks(*resume, arguments.resume.ranks);
  add_leader(*resume, arguments.resume, "Of a run that was led: where the other program");
  add_walltime(*resume, arguments.resume.walltime);
  add_ending(*resume, arguments.resume.strict);
  resume->callback(
      [&] { action = [&](const Comm& comm) { culm::app::resume(comm, arguments.resume); }; });
  CLI::App* check = app.add_subcommand("check", "Parse, build and count a deck; do not solve it");
  add_deck_options(*check, arguments.check);
  check
      ->add_option("--resolved", arguments.check.resolved,
                   "Write the deck as it is used to this file: without variables, units and "
                   "includes, with all defaults")
      ->check(refuse_empty);
  check
      ->add_option("--view", arguments.check.view,
                   "Write a page that shows the model with its supports and loads to this file")
      ->check(refuse_empty);
  check->callback(
      [&] { action = [&](const Comm& comm) { culm::app::check(comm, arguments.check); }; });
  CLI::App* couple =
      app.add_subcommand("couple", "Run a deck together with a partner at one of its ports");
  add_run_options(*couple, arguments.couple);
  add_partner_options(*couple, arguments.couple);
  couple->callback(
      [&] { action = [&](const Comm& comm) { culm::app::couple(comm, arguments.couple); }; });
  CLI::App* replay = app.add_subcommand(
      "replay",
      "Run a deck with the loads of a recorded coupling, or ask a partner again, and compare");
  replay
      ->add_option("record", arguments.replay.record,
                   "What a coupling wrote, or the folder with the records of all partners")
      ->required();
  add_run_options(*replay, arguments.replay);
  replay->get_option("deck")->required(false);
  replay->add_option("--partner", arguments.replay.partner,
                     "In place of a deck, a partner: unix:PATH, tcp:PORT, tcp:ADDRESS:PORT or "
                     "mpi:RANK");
  replay->add_option("--patience", arguments.replay.patience, "How long it may be silent [s]; 600")
      ->check(CLI::PositiveNumber);
  replay->callback(
      [&] { action = [&](const Comm& comm) { culm::app::replay(comm, arguments.replay); }; });
  CLI::App* serve = app.add_subcommand(
      "serve", "Run a deck whose steps another program makes, by the loads at a port");
  add_run_options(*serve, arguments.serve);
  add_leader(*serve, arguments.serve, "Where it")->required();
  serve->callback(
      [&] { action = [&](const Comm& comm) { culm::app::serve(comm, arguments.serve); }; });
  CLI::App* import = app.add_subcommand("import", "Make a deck from files of another program");
  import->require_subcommand(1);
  CLI::App* openfast =
      import->add_subcommand("openfast", "A blade of BeamDyn, a turbine of ElastoDyn");
  openfast
      ->add_option("file", arguments.import.file,
                   "Driver or primary file of BeamDyn, main file of ElastoDyn, or .fst")
      ->required();
  openfast->add_option("--output", arguments.import.deck,
                       "Deck to write; here, with the name of the file and .xml, if not given");
  openfast->add_option("--blade", arguments.import.turbine.blade,
                       "Primary file of BeamDyn, for the blades of a turbine");
  openfast
      ->add_option("--blade-mass", arguments.import.turbine.blade_mass,
                   "Mass to which each blade of a turbine is scaled [kg]")
      ->check(CLI::PositiveNumber);
  openfast->add_option("--servodyn", arguments.import.turbine.servodyn,
                       "File of ServoDyn, for the yaw spring of a turbine");
  openfast->add_flag("--quiet", arguments.import.quiet, "Do not print the report");
  openfast->callback([&] {
    action = [&](const Comm& comm) { culm::app::import_openfast(comm, arguments.import); };
  });
  CLI::App* reference = app.add_subcommand("reference", "Print what a deck may contain");
  CLI::Option* name = reference->add_option("name", arguments.reference.name,
                                            "A list, type or parameter; everything if not given");
  reference
      ->add_flag("--relax-ng", arguments.reference.relax_ng,
                 "Print a grammar of decks in RELAX NG, for editors")
      ->excludes(name);
  reference->callback(
      [&] { action = [&](const Comm& comm) { culm::app::reference(comm, arguments.reference); }; });
  // these are called before MPI starts; here they are named for the help
  for (const auto& verb : culm::app::python_verbs()) app.add_subcommand(verb.name, verb.summary);
  CLI::App* commands = app.add_subcommand("commands", "The table of all verbs and options");
  commands->group("");  // for the program itself
  commands->callback([&] {
    action = [&](const Comm& comm) {
      if (comm.is_root()) std::fputs(culm::app::table_of_commands(app).c_str(), stdout);
    };
  });
}

// CLI11 misses a subcommand, or a deck, even where a misspelt one is given.
int report(const CLI::ParseError& error, const CLI::App& app, const culm::parallel::Comm& comm) {
  const std::string unknown = culm::app::explain_unknown_word(app);
  if (error.get_exit_code() != 0 && !unknown.empty()) {
    if (comm.is_root()) {
      std::fprintf(stderr, "%s\nRun with --help for more information.\n", unknown.c_str());
    }
    return 2;
  }
  const int code = comm.is_root() ? app.exit(error) : error.get_exit_code();
  return code == 0 ? 0 : 2;
}

// Names and values in a message may be of any length.
void print_lines(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::fprintf(stderr, "%s\n", culm::shortened(line, 2500).c_str());
  }
}

// The partners in the same launcher may never come to the end of MPI, which waits for all: they are
// ended with this program. The root does it, and the others wait for that: launchers of Open MPI 4
// hang for ever when one process ends in order while another one aborts.
void end_all(int code, const culm::parallel::Comm& comm) {
  constexpr std::chrono::seconds patience(60);
  if (!comm.is_root()) std::this_thread::sleep_for(patience);
  MPI_Abort(MPI_COMM_WORLD, code);
}

// The error is the same on all ranks, so one speaks for them.
int report(const culm::Error& error, bool has_partners, const culm::parallel::Comm& comm) {
  if (comm.is_root()) print_lines(error.what());
  const bool has_failed = dynamic_cast<const culm::PartnerError*>(&error) != nullptr;
  if (has_failed && has_partners) end_all(error.exit_code(), comm);
  return error.exit_code();
}

// What one rank may meet alone: others may be waiting for it.
int report(const std::string& text, int code, const culm::parallel::Comm& comm) {
  print_lines(text);
  if (comm.size() > 1) MPI_Abort(MPI_COMM_WORLD, code);
  return code;
}

int report_lack_of_memory(const culm::parallel::Comm& comm) {
  return report(
      "there is not enough memory for this deck\n"
      "Try: fewer elements, a smaller 'Refinement', fewer 'Modes'; 'culm check' counts what a deck "
      "makes; --max-memory may allow more.",
      deck_error, comm);
}

int run_verb(int argc, char** argv, Arguments& arguments, bool& is_root) {
  const culm::simulation::Session session(argc, argv);
  const culm::parallel::Comm comm;
  is_root = comm.is_root();
  CLI::App app("culm: nonlinear dynamics of slender structures", "culm");
  std::function<void(const culm::parallel::Comm&)> action;
  declare_verbs(app, arguments, action);
  try {
    app.parse(argc, argv);
    const int ranks = arguments.ranks();
    action(ranks > 0 ? culm::parallel::first_ranks(ranks) : comm);
  } catch (const CLI::ParseError& error) {
    return report(error, app, comm);
  } catch (const culm::Error& error) {
    return report(error, arguments.ranks() > 0, comm);
  } catch (const std::bad_alloc&) {
    return report_lack_of_memory(comm);
  } catch (const std::length_error&) {
    return report_lack_of_memory(comm);
  } catch (const std::filesystem::filesystem_error& error) {
    return report(error.path1().string() + ": " + error.code().message(), file_error, comm);
  } catch (const std::exception& error) {
    return report(std::string("internal error: ") + error.what() +
                      "\nThis is a bug in culm; please report it.",
                  1, comm);
  }
  return 0;
}

// The page of a model that was checked; its file goes, whether the deck was sound or not.
int show_model(const CheckArguments& check, int code) {
  if (check.model.empty()) return code;
  std::error_code ignored;
  int drawn = 0;
  if (std::filesystem::exists(check.model / "run.h5", ignored)) {
    drawn = culm::app::call_python(
        {"view", check.model.string(), "--output", check.view.string(), "--unsolved", "--quiet"});
  }
  std::filesystem::remove_all(check.model.parent_path(), ignored);
  return code == 0 ? drawn : code;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (culm::app::is_for_python(words)) return culm::app::call_python(words);
  Arguments arguments;
  bool is_root = false;
  const int code = show_model(arguments.check, run_verb(argc, argv, arguments, is_root));
  const RunArguments& run = arguments.any_run();
  const std::filesystem::path& folder = run.started;
  // the folder may be that of another run, which this one has left alone
  if (!run.report || folder.empty() || code == file_error) return code;
  // mpiexec ends all processes when one returns an error, and the root has a page to draw before
  if (!is_root) return 0;
  std::vector<std::string> drawn = {"report", folder.string()};
  if (run.quiet) drawn.emplace_back("--quiet");
  culm::app::call_python(drawn);
  return code;
}
