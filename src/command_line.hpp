/// What can be said about a command line as declared: of its mistakes, and as a table.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace culm::app {

/// A word that no verb or option is, with the nearest one that is, in one line; empty if the
/// mistake is another one.
std::string explain_unknown_word(const CLI::App& app);

/// All verbs with their options and sentences as JSON, for the manual and for completion: objects
/// with `name`, `summary`, `footer`, `verbs` and `options`; these with `names`, `value` (what
/// follows; empty for flags and words without a dash), `help`, `required` and `positional`.
std::string table_of_commands(const CLI::App& app);

}  // namespace culm::app
