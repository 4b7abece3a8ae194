#include "command_line.hpp"

#include <culm/base/nearest.hpp>
#include <culm/base/text.hpp>

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <vector>

namespace culm::app {
namespace {

/// Verbs and options without group are for the program itself: help does not name them.
std::vector<const CLI::App*> verbs_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* verb) { return !verb->get_group().empty(); });
}

std::vector<const CLI::Option*> options_of(const CLI::App& verb) {
  return verb.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

std::vector<std::string> names_of_verbs(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : verbs_of(app)) names.push_back(verb->get_name());
  return names;
}

std::vector<std::string> names_of_options(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options_of(verb)) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// JSON for a text. Its readers must allow line feeds in texts.
std::string quoted(const std::string& text) {
  std::ostringstream json;
  json << std::quoted(text);
  return json.str();
}

std::string array(const std::vector<std::string>& items) { return "[" + join(items, ",\n") + "]"; }

std::string describe(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back(quoted("-" + name));
  for (const std::string& name : option.get_lnames()) names.push_back(quoted("--" + name));
  const bool positional = option.get_positional();
  if (positional) names.push_back(quoted(option.get_name(true)));
  const bool takes_value = !positional && option.get_type_size() > 0;
  return "{\"names\": " + array(names) +
         ", \"value\": " + quoted(takes_value ? option.get_type_name() : "") +
         ", \"help\": " + quoted(option.get_description()) +
         ", \"required\": " + (option.get_required() ? "true" : "false") +
         ", \"positional\": " + (positional ? "true" : "false") + "}";
}

}  // namespace

std::string explain_unknown_word(const CLI::App& app) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  if (!chosen.empty()) return explain_unknown_word(*chosen.back());
  const std::vector<std::string> extras = app.remaining();
  const auto option =
      std::ranges::find_if(extras, [](const std::string& word) { return word.starts_with("-"); });
  if (option != extras.end()) {
    const std::string name = option->substr(0, option->find('='));
    return "unknown option '" + name + "'" + did_you_mean(name, names_of_options(app));
  }
  if (extras.empty() || verbs_of(app).empty()) return {};
  return "unknown command '" + extras.front() + "'" +
         did_you_mean(extras.front(), names_of_verbs(app));
}

std::string table_of_commands(const CLI::App& app) {
  std::vector<std::string> verbs;
  for (const CLI::App* verb : verbs_of(app)) verbs.push_back(table_of_commands(*verb));
  std::vector<std::string> options;
  for (const CLI::Option* option : options_of(app)) options.push_back(describe(*option));
  return "{\"name\": " + quoted(app.get_name()) +
         ", \"summary\": " + quoted(app.get_description()) +
         ", \"footer\": " + quoted(app.get_footer()) + ",\n\"options\": " + array(options) +
         ",\n\"verbs\": " + array(verbs) + "}\n";
}

}  // namespace culm::app
