#include <culm/base/error.hpp>
#include <culm/base/nearest.hpp>
#include <culm/base/read_file.hpp>
#include <culm/control/library.hpp>
#include <culm/control/library_batch.hpp>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace culm::control {
namespace {

constexpr int number_of_blades = 61;
constexpr int individual_pitch = 28;

// A path of the deck, complete, so that no other folders are searched.
std::string complete(const Options& options, const std::string& parameter) {
  const std::filesystem::path folder =
      std::filesystem::path(options.where(parameter).file).parent_path();
  return std::filesystem::absolute(folder / options.text(parameter)).lexically_normal().string();
}

std::optional<int> find_record(const std::string& text, std::span<const SwapLibrary::Record> known,
                               const Where& where, InputIssues& issues) {
  const auto named = std::ranges::find(known, text, &SwapLibrary::Record::name);
  if (named != known.end()) return named->number;
  int number = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && rest == text.data() + text.size() && number >= 4 &&
      number <= SwapLibrary::records) {
    return number;
  }
  std::vector<std::string> names;
  for (const SwapLibrary::Record& record : known) names.emplace_back(record.name);
  issues.add(where, "must be the name of a record or a number from 4 to " +
                        std::to_string(SwapLibrary::records) + ", got '" + text + "'" +
                        did_you_mean(text, names));
  return {};
}

std::string list_of(std::span<const SwapLibrary::Record> known) {
  std::string text;
  for (const SwapLibrary::Record& record : known) {
    text += (text.empty() ? "" : ", ") + std::string(record.name) + " (" +
            std::to_string(record.number) + ")";
  }
  return text;
}

void connect_inputs(const Options& options, ControlContext& context) {
  const std::vector<std::string>& records = options.texts("Records");
  const std::vector<std::string>& signals = options.texts("Signals");
  for (std::size_t k = 0; k < records.size(); ++k) {
    InputIssues& issues = context.build().issues;
    const auto record =
        find_record(records[k], SwapLibrary::measured, options.where("Records"), issues);
    auto value = model::find_function(signals[k], options.where("Signals"), context.build(),
                                      model::Follows::signals);
    if (record && value) {
      context.libraries().connect_input(options.name(), *record, *std::move(value));
    }
  }
}

void add_library(const Options& options, ControlContext& context) {
  const std::string path = complete(options, "File Name");
  std::string input;
  if (options.has("Input File")) {
    input = complete(options, "Input File");
    const std::string objection = file_objection(input);
    if (!objection.empty()) {
      context.build().issues.add(options.where("Input File"), input + ": " + objection);
    }
  }
  std::unique_ptr<SwapLibrary> library;
  try {
    library = std::make_unique<SwapLibrary>(path, options.text("Procedure"), std::move(input),
                                            options.name());
  } catch (const FileError& error) {
    context.build().issues.add(options.where("File Name"), error.what());
    return;
  }
  library->set(number_of_blades, options.integer("Blades"));
  library->set(individual_pitch, 1.0);
  context.libraries().add(options.name(), std::move(library), options.number("Interval"));
  context.when_complete([&options, &context] { connect_inputs(options, context); });
}

void connect_output(const Options& options, const model::Signal& signal, ControlContext& context) {
  InputIssues& issues = context.build().issues;
  const std::string& library = options.text("Library");
  if (!context.libraries().has(library)) {
    issues.add(options.where("Library"), "there is no library '" + library + "'" +
                                             did_you_mean(library, context.libraries().names()));
    return;
  }
  const auto record =
      find_record(options.text("Record"), SwapLibrary::demanded, options.where("Record"), issues);
  if (record) context.libraries().connect_output(library, *record, signal);
}

}  // namespace

void register_library(SignalRegistry& registry) {
  Schema library("Library",
                 "A controller in a shared object with the interface of Bladed (DISCON). It is "
                 "called in accepted states of motions; its demands are signals of type 'Library "
                 "Output'.");
  library.add(text("File Name", "The shared object, relative to the deck."))
      .add(text("Procedure", "The procedure in it that is called.").optional("DISCON"))
      .add(text("Input File", "What the library reads by itself, relative to the deck.").optional())
      .add(number("Interval", "s",
                  "Least time between two calls, a multiple of the step; each step if zero.")
               .non_negative()
               .optional(0.0))
      .add(integer("Blades", "Number of blades.").positive().optional(3))
      .add(texts("Records", "Records that it is told, by number or name: " +
                                list_of(SwapLibrary::measured) + ".")
               .min_size(1))
      .add(texts("Signals", "A signal or function for each.").min_size(1))
      .check([](const Options& options, InputIssues& issues) {
        const std::size_t count = options.texts("Records").size();
        const std::size_t found = options.texts("Signals").size();
        if (count == found) return;
        issues.add(options.where("Signals"), "must be as many as 'Records', which are " +
                                                 std::to_string(count) + "; got " +
                                                 std::to_string(found));
      });
  registry.add("Library", library, add_library);

  Schema output("Library Output", "What a library demands, held from one call to the next.");
  output.add(text("Library", "The signal of type 'Library'."))
      .add(text("Record", "The record, by number or name: " + list_of(SwapLibrary::demanded) + "."))
      .add(number("Initial", "1", "Value until the first call.").optional(0.0));
  registry.add("Library Output", output, [](const Options& options, ControlContext& context) {
    const model::Signal signal = context.libraries().add_output(
        "Library Output '" + options.name() + "'", options.number("Initial"));
    context.publish(options, signal);
    context.when_complete(
        [&options, &context, signal] { connect_output(options, signal, context); });
  });
}

}  // namespace culm::control
