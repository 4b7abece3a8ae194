// The program culm-precice: a deck takes part in a coupling by preCICE.

#include "couple.hpp"
#include "structure.hpp"

#include <CLI/CLI.hpp>

#include <exception>
#include <iostream>

namespace {

void declare(CLI::App& app, culm::adapter::Settings& settings) {
  app.add_option("deck", settings.deck, "The deck")->required();
  app.add_option("--port", settings.port, "Port whose points are the vertices of the mesh")
      ->required();
  app.add_option("--config", settings.configuration, "Configuration of preCICE")->required();
  app.add_option("--participant", settings.participant)->capture_default_str();
  app.add_option("--mesh", settings.mesh)->capture_default_str();
  app.add_option("--displacement", settings.displacement, "Data that culm writes")
      ->capture_default_str();
  app.add_option("--force", settings.force, "Data that culm reads")->capture_default_str();
  app.add_option("--moment", settings.moment, "Data that culm reads; none by default");
  app.add_option("--analysis", settings.analysis, "Analysis that makes the steps; the first one");
  app.add_option("--table", settings.table, "File for what is exchanged, by time window");
  app.add_option("--set", settings.overrides, "PATH=VALUE overrides a value of the deck")
      ->allow_extra_args(false);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Couples a deck with other programs through preCICE", "culm-precice");
  culm::adapter::Settings settings;
  declare(app, settings);
  try {
    app.parse(argc, argv);
    culm::adapter::couple(settings);
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : CULM_USAGE;
  } catch (const culm::adapter::Failure& failure) {
    std::cerr << "culm-precice: " << failure.what() << '\n';
    return failure.exit_code();
  } catch (const std::exception& error) {
    std::cerr << "culm-precice: preCICE: " << error.what() << '\n';
    return culm::adapter::left;
  }
}
