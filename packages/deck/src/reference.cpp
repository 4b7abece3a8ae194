#include <culm/base/error.hpp>
#include <culm/base/text.hpp>
#include <culm/deck/reference.hpp>

#include "describe.hpp"

#include <algorithm>
#include <utility>

namespace culm::deck {
namespace {

/// One section of the reference: a list or a type, with all places where it may stand.
struct Topic {
  std::string name;
  std::vector<std::string> paths;
  const Schema* schema;
  std::string body;
};

std::string sentence(const std::string& doc) { return doc.empty() ? "" : " " + doc; }

std::string field_line(const Field& field) {
  return "- `" + field.name() + "` – " + describe_fully(field) + "\n";
}

std::string slot_line(const Schema::Slot& slot) {
  std::string words =
      slot.name.empty() ? "- lists named by the user" : "- list `" + slot.name + "`";
  if (slot.presence == Presence::required) words += ", required";
  if (slot.presence == Presence::optional && !slot.name.empty()) words += ", optional";
  if (slot.presence == Presence::defaulted) words += ", from defaults if absent";
  if (!slot.by_type()) return words + "." + sentence(slot.schema->doc()) + "\n";
  words += "; `Type` is one of: " + join(slot.types(), ", ");
  if (!slot.default_type.empty()) words += "; default " + slot.default_type;
  return words + ".\n";
}

std::string body_of(const Schema& schema) {
  std::string body;
  if (!schema.doc().empty()) body += schema.doc() + "\n\n";
  for (const Field& field : schema.fields()) body += field_line(field);
  for (const Schema::Slot& slot : schema.lists()) body += slot_line(slot);
  if (schema.entries()) body += slot_line(*schema.entries());
  return body.empty() ? "No parameters.\n" : body;
}

/// Visits every schema below the root; equal ones at several places become one topic.
class Collector {
 public:
  std::vector<Topic> collect(const Schema& root) {
    visit(root.name(), "", root);
    return std::move(topics_);
  }

 private:
  void visit(const std::string& name, const std::string& path, const Schema& schema) {
    add(name, path, schema);
    for (const Schema::Slot& slot : schema.lists()) visit_slot(join_path(path, slot.name), slot);
    if (schema.entries()) visit_slot(join_path(path, "<name>"), *schema.entries());
  }

  void visit_slot(const std::string& path, const Schema::Slot& slot) {
    if (!slot.by_type()) {
      const bool named = !slot.name.empty();
      return visit(named ? slot.name : slot.schema->name(), path, *slot.schema);
    }
    for (const auto& [type, schema] : *slot.variants) visit(type, path, schema);
  }

  void add(const std::string& name, const std::string& path, const Schema& schema) {
    std::string body = body_of(schema);
    for (Topic& topic : topics_) {
      if (topic.name != name || topic.body != body) continue;
      if (std::ranges::find(topic.paths, path) == topic.paths.end()) topic.paths.push_back(path);
      return;
    }
    topics_.push_back({name, {path}, &schema, std::move(body)});
  }

  std::vector<Topic> topics_;
};

std::string title(const Topic& topic) {
  std::string places;
  for (const std::string& path : topic.paths) {
    if (path.empty()) continue;
    places += (places.empty() ? "In " : ", ") + ("`" + path + "`");
  }
  return "## " + topic.name + "\n\n" + (places.empty() ? "" : places + ".\n\n");
}

bool same_name(const std::string& a, const std::string& b) { return to_lower(a) == to_lower(b); }

std::string search(const std::vector<Topic>& topics, const std::string& name) {
  std::string text;
  std::vector<std::string> known;
  for (const Topic& topic : topics) {
    known.push_back(topic.name);
    if (same_name(topic.name, name)) text += title(topic) + topic.body + "\n";
  }
  for (const Topic& topic : topics) {
    for (const Field& field : topic.schema->fields()) {
      known.push_back(field.name());
      if (same_name(field.name(), name)) text += title(topic) + field_line(field) + "\n";
    }
  }
  if (!text.empty()) return text;
  const std::string nearest = nearest_name(name, known);
  throw UsageError("the input reference has no '" + name + "'" +
                   (nearest.empty() ? "" : " – did you mean '" + nearest + "'?"));
}

}  // namespace

std::string reference(const Schema& root, const std::string& name) {
  const std::vector<Topic> topics = Collector().collect(root);
  if (!name.empty()) return search(topics, name);
  std::string text = "# Input reference\n\n";
  for (const Topic& topic : topics) text += title(topic) + topic.body + "\n";
  return text;
}

}  // namespace culm::deck
