// culm: nonlinear dynamics of slender structures, driven by decks.

#include <culm/base/error.hpp>
#include <culm/base/text.hpp>
#include <culm/coupling/partner_error.hpp>
#include <culm/parallel/first_ranks.hpp>
#include <culm/simulation/session.hpp>
#include <culm/simulation/stop_request.hpp>

#include "command.hpp"
#include "command_line.hpp"
#include "launcher.hpp"
#include "python.hpp"
#include "version.hpp"

#include <CLI/CLI.hpp>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <new>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace {

// exit codes
constexpr int deck_error = 3;
constexpr int file_error = 6;

using culm::app::CheckArguments;
using culm::app::CoupleArguments;
using culm::app::DeckArguments;
using culm::app::ImportArguments;
using culm::app::PartnerArguments;
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

  /// What was said of programs beside culm.
  const PartnerArguments& partners() const {
    if (!resume.run.empty()) return resume;
    return any_run();
  }
};

// What is empty is mostly a variable of a script that is not set; it would be taken for none given.
std::string refuse_empty(const std::string& path) {
  return path.empty() ? "needs a path, got ''" : "";
}

std::string refuse_no_command(const std::string& command) {
  return command.empty() ? "needs a command, got ''" : "";
}

std::string refuse_no_size(const std::string& size) {
  return size.empty() ? "needs a size such as '16 GB', got ''" : "";
}

std::string refuse_no_time(const std::string& time) {
  return time.empty() ? "needs a time such as 1:30:00 or '90 min', got ''" : "";
}

// That of the library names the largest number there is.
CLI::Validator positive() {
  const auto refuse = [](const std::string& text) -> std::string {
    double number = 0.0;
    const bool is_sound = CLI::detail::lexical_cast(text, number) && number > 0.0;
    return is_sound ? "" : "needs a number above 0, got '" + text + "'";
  };
  return CLI::Validator(refuse, "POSITIVE");
}

template <class VerbArguments>
void add_common_options(CLI::App& verb, VerbArguments& arguments) {
  verb.add_option("--set", arguments.overrides,
                  "Replace a value: Structures/beam/Curve/Elements=32; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  verb.add_option("--max-memory", arguments.memory,
                  "Refuse models that need more: '16 GB'; the memory of the machine if not given")
      ->check(refuse_no_size);
  verb.add_flag("--quiet", arguments.quiet, "Print warnings and errors only");
}

void add_deck_options(CLI::App& verb, DeckArguments& arguments) {
  verb.add_option("deck", arguments.deck, "Input deck, XML")->required();
  add_common_options(verb, arguments);
}

void add_partner_options(CLI::App& verb, CoupleArguments& arguments) {
  verb.add_option("--partner", arguments.partner,
                  "Type of the partner: added-mass, dashpot, oscillator, random, socket, mpi")
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
      ->check(positive());
  return verb.add_option("--at", arguments.address,
                         whence + " comes to: unix:PATH, tcp:PORT, tcp:ADDRESS:PORT, or mpi:RANK");
}

void add_walltime(CLI::App& verb, std::string& walltime) {
  verb.add_option("--walltime", walltime,
                  "Write a checkpoint and stop, with exit code 7, before this time is over: "
                  "1:30:00 or '90 min'")
      ->check(refuse_no_time);
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

void add_partner_program(CLI::App& verb, PartnerArguments& arguments) {
  verb.add_option("--with", arguments.partner_command,
                  "Start the partner of type Socket or MPI by this command of the shell, and end "
                  "it with the run")
      ->check(refuse_no_command);
  verb.add_option("--ranks", arguments.ranks,
                  "culm is the first so many processes of the launcher, others are partners; with "
                  "--with it starts as many")
      ->check(positive());
  constexpr const char* for_culm_itself = "";
  verb.add_option("--verdict", arguments.verdict, "File to leave the exit code in")
      ->group(for_culm_itself);
  verb.add_flag("--plain", arguments.plain, "The output is no terminal, even if it looks like one")
      ->group(for_culm_itself);
}

void add_run_options(CLI::App& verb, RunArguments& arguments) {
  add_deck_options(verb, arguments);
  add_walltime(verb, arguments.walltime);
  verb.add_option("--output", arguments.folder,
                  "Folder for results; results/<name of the deck> if not given")
      ->check(refuse_empty);
  add_ending(verb, arguments.strict);
  add_partner_program(verb, arguments);
  verb.add_flag("--report", arguments.report, "Write report.html beside the results");
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
  add_partner_program(*resume, arguments.resume);
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
      ->check(positive());
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
      ->check(positive());
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

// How a verb ended.
struct End {
  int code = 0;
  bool is_alone = false;         // one rank met it alone, and others may be waiting for it
  bool leaves_partners = false;  // programs in the same launcher may be waiting for a word
};

// The error is the same on all ranks, so one speaks for them.
End report(const culm::Error& error, bool has_begun, const culm::parallel::Comm& comm) {
  if (comm.is_root()) print_lines(error.what());
  const bool has_failed = dynamic_cast<const culm::PartnerError*>(&error) != nullptr;
  return {error.exit_code(), false, has_failed || !has_begun};
}

End report_alone(const std::string& text, int code) {
  print_lines(text);
  return {code, true};
}

End report_lack_of_memory() {
  return report_alone(
      "there is not enough memory for this deck\n"
      "Try: fewer elements, a smaller 'Refinement', fewer 'Modes'; 'culm check' counts what a deck "
      "makes; --max-memory may allow more.",
      deck_error);
}

// Whether this process is to start a launcher, with which culm's processes come.
bool starts_others(const PartnerArguments& partners, bool is_inside) {
  return !is_inside && !partners.partner_command.empty();
}

End act(int argc, char** argv, Arguments& arguments, bool is_inside,
        const culm::parallel::Comm& comm) {
  CLI::App app("culm: nonlinear dynamics of slender structures", "culm");
  std::function<void(const culm::parallel::Comm&)> action;
  declare_verbs(app, arguments, action);
  const auto partners = [&]() -> const PartnerArguments& { return arguments.partners(); };
  try {
    app.parse(argc, argv);
    if (comm.is_root()) culm::app::tell_begin(partners().verdict);
    const bool is_part = partners().ranks > 0 && !starts_others(partners(), is_inside);
    action(is_part ? culm::parallel::first_ranks(partners().ranks) : comm);
    if (!partners().needs_launcher || !is_inside) return {};
    throw culm::UsageError(
        "--with starts a partner of type 'MPI' and culm together: call culm without mpiexec, and "
        "say by --ranks how many processes it takes");
  } catch (const CLI::ParseError& error) {
    return {report(error, app, comm)};
  } catch (const culm::InternalError& error) {
    return report_alone(error.what(), error.exit_code());
  } catch (const culm::Error& error) {
    return report(error, !partners().started.empty(), comm);
  } catch (const std::bad_alloc&) {
    return report_lack_of_memory();
  } catch (const std::length_error&) {
    return report_lack_of_memory();
  } catch (const std::filesystem::filesystem_error& error) {
    return report_alone(error.path1().string() + ": " + error.code().message(), file_error);
  } catch (const std::exception& error) {
    return report_alone(std::string("internal error: ") + error.what() +
                            "\nThis is a bug in culm; please report it.",
                        1);
  }
}

// One of several processes would have to wait for the others to unwind, and they for it.
[[noreturn]] void end_without_memory() {
  std::set_new_handler(nullptr);  // what is said needs some, too
  MPI_Abort(MPI_COMM_WORLD, report_lack_of_memory().code);
  std::abort();
}

int run_verb(int argc, char** argv, Arguments& arguments, bool is_inside, bool& is_root) {
  const culm::simulation::Session session(argc, argv);
  const culm::parallel::Comm comm;
  if (comm.size() > 1) std::set_new_handler(end_without_memory);
  is_root = comm.is_root();
  const End end = act(argc, argv, arguments, is_inside, comm);
  const PartnerArguments& partners = arguments.partners();
  if (is_root || end.is_alone) {
    culm::app::leave_verdict(partners.verdict, {end.code, partners.started});
  }
  if (end.is_alone && comm.size() > 1) MPI_Abort(MPI_COMM_WORLD, end.code);
  const bool has_partners = partners.ranks > 0 && partners.ranks < comm.size();
  if (end.leaves_partners && has_partners) end_all(end.code, comm);
  return end.code;
}

// Whether a verb stops where SIGTERM or SIGUSR1 asks for it, rather than to be ended by them.
bool heeds_requests(const std::vector<std::string>& words) {
  constexpr std::array verbs = {"run", "resume", "couple", "replay", "serve"};
  return !words.empty() && std::ranges::find(verbs, words.front()) != verbs.end();
}

// Starts culm and its partner as the command line asks for it; culm tells its verdict.
culm::app::Verdict launch(const culm::app::Launcher& launcher, std::vector<std::string> words,
                          const PartnerArguments& partners) {
  try {
    return launcher.run({std::move(words), partners.partner_command, std::max(partners.ranks, 1)});
  } catch (const culm::Error& error) {
    print_lines(error.what());
    return {error.exit_code(), {}};
  }
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

// What was printed may be what was asked for, as with 'reference', and a full disk has no room for
// it.
int check_printed(int code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  print_lines("standard output cannot be written");
  return code == 0 ? file_error : code;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (culm::app::is_for_python(words)) return culm::app::become_python(words);
  // a request that comes while MPI starts is heeded as a later one
  std::optional<culm::simulation::StopRequest> listening;
  if (heeds_requests(words)) listening.emplace();
  const culm::app::Launcher launcher;
  Arguments arguments;
  bool is_root = false;
  int code = run_verb(argc, argv, arguments, launcher.is_inside(), is_root);
  code = check_printed(show_model(arguments.check, code));
  std::filesystem::path folder = arguments.partners().started;
  if (code == 0 && arguments.partners().needs_launcher) {
    const culm::app::Verdict verdict = launch(launcher, words, arguments.partners());
    code = verdict.code;
    folder = verdict.started;
  }
  listening.reset();
  const RunArguments& run = arguments.any_run();
  // the folder may be that of another run, which this one has left alone
  if (!run.report || folder.empty() || code == file_error) return code;
  // mpiexec ends all processes when one returns an error, and the root has a page to draw before
  if (!is_root) return 0;
  std::vector<std::string> drawn = {"report", folder.string()};
  if (run.quiet) drawn.emplace_back("--quiet");
  const int page = culm::app::call_python(drawn);
  return code == 0 ? page : code;
}
