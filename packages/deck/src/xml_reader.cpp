#include "xml_reader.hpp"

#include <culm/base/error.hpp>
#include <culm/base/text.hpp>

#include <libxml/parser.h>
#include <libxml/xmlerror.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <utility>

namespace culm::deck {
namespace {

std::string to_text(const xmlChar* text) {
  return text ? reinterpret_cast<const char*>(text) : std::string();
}

/// The tree under construction. libxml2 is C: nothing may be thrown through it, so a mistake is
/// noted and the parser stopped.
class Builder {
 public:
  explicit Builder(xmlParserCtxt* parser) : parser_(parser) {}

  void begin(std::string name, std::vector<XmlAttribute> attributes) {
    if (open_.size() >= max_depth) {
      return fail("lists are nested deeper than " + std::to_string(max_depth) + " levels");
    }
    XmlElement element;
    element.name = std::move(name);
    element.line = line_of_tag();
    element.attributes = std::move(attributes);
    open_.push_back(std::move(element));
  }

  void end() {
    if (open_.empty()) return;
    XmlElement element = std::move(open_.back());
    open_.pop_back();
    if (open_.empty()) {
      root_ = std::move(element);
    } else {
      open_.back().children.push_back(std::move(element));
    }
  }

  void text(std::string_view text) {
    if (open_.empty() || trim(text).empty() || !open_.back().stray_text.empty()) return;
    open_.back().stray_text = trim(text);
    // The parser stands at the end of the text.
    const auto rest = text.substr(text.find(open_.back().stray_text));
    open_.back().stray_line =
        parser_->input->line - static_cast<int>(std::ranges::count(rest, '\n'));
  }

  void fail(std::string message) { fail(std::move(message), parser_->input->line); }

  void fail(std::string message, int line) {
    if (message_.empty()) {
      message_ = std::move(message);
      line_ = line;
    }
    xmlStopParser(parser_);
  }

  bool failed() const { return !message_.empty(); }
  InputError error(const std::string& file) const { return {Where{file, line_, {}}, message_}; }
  XmlElement take_root() { return std::move(root_); }

 private:
  /// The parser stands at the end of the tag, which may have begun many lines before. No '<' can
  /// stand inside a tag, so the last one is its beginning.
  int line_of_tag() const {
    const xmlParserInput& input = *parser_->input;
    const std::string_view read(reinterpret_cast<const char*>(input.base),
                                static_cast<std::size_t>(input.cur - input.base));
    const auto begin = read.rfind('<');
    if (begin == std::string_view::npos) return input.line;
    return input.line - static_cast<int>(std::ranges::count(read.substr(begin), '\n'));
  }

  xmlParserCtxt* parser_;
  std::vector<XmlElement> open_;
  XmlElement root_;
  std::string message_;
  int line_ = 0;
};

Builder& builder(void* data) { return *static_cast<Builder*>(data); }

void start_element(void* data, const xmlChar* local, const xmlChar* prefix, const xmlChar* uri,
                   int /*namespaces*/, const xmlChar** /*namespace_pairs*/, int attribute_count,
                   int /*defaulted*/, const xmlChar** attributes) {
  std::string name = to_text(local);
  if (name == "include" && to_text(uri) == "http://www.w3.org/2001/XInclude") {
    name = "xi:include";
  } else if (prefix) {
    name = to_text(prefix) + ":" + name;
  }
  std::vector<XmlAttribute> list;
  // Five pointers per attribute: name, prefix, namespace, begin and end of the value.
  for (int i = 0; i < attribute_count; ++i) {
    const xmlChar** part = attributes + std::ptrdiff_t{5} * i;
    const std::string attribute = (part[1] ? to_text(part[1]) + ":" : "") + to_text(part[0]);
    list.push_back({attribute, std::string(reinterpret_cast<const char*>(part[3]),
                                           static_cast<std::size_t>(part[4] - part[3]))});
  }
  builder(data).begin(std::move(name), std::move(list));
}

void end_element(void* data, const xmlChar* /*local*/, const xmlChar* /*prefix*/,
                 const xmlChar* /*uri*/) {
  builder(data).end();
}

void characters(void* data, const xmlChar* text, int length) {
  builder(data).text({reinterpret_cast<const char*>(text), static_cast<std::size_t>(length)});
}

void document_type(void* data, const xmlChar* /*name*/, const xmlChar* /*external*/,
                   const xmlChar* /*system*/) {
  builder(data).fail("a DOCTYPE is not allowed in a deck");
}

void parse_error(void* data, xmlError* error) {
  // An undeclared prefix is harmless: <xi:include> is understood without declaration, and any
  // other prefixed name is refused by name.
  if (error->domain == XML_FROM_NAMESPACE || error->level < XML_ERR_ERROR) return;
  const std::string_view message = error->message ? error->message : "unknown reason";
  const auto first_line = trim(message.substr(0, message.find('\n')));
  builder(data).fail("not well-formed XML: " + std::string(first_line), error->line);
}

void check_text(const std::string& text, const std::string& file) {
  if (text.size() > max_bytes) {
    throw InputError(Where{file, 0, {}}, "the file is larger than 64 MB");
  }
  if (trim(text).empty()) throw InputError(Where{file, 1, {}}, "the file is empty");
  const auto zero = std::ranges::find(text, '\0');
  if (zero != text.end()) {
    const auto line = 1 + std::count(text.begin(), zero, '\n');
    throw InputError(Where{file, static_cast<int>(line), {}},
                     "not a text file: there is a zero byte in it");
  }
}

}  // namespace

XmlElement read_xml(const std::string& text, const std::string& file) {
  check_text(text, file);
  const std::unique_ptr<xmlParserCtxt, decltype(&xmlFreeParserCtxt)> parser(xmlNewParserCtxt(),
                                                                            &xmlFreeParserCtxt);
  internal_check(parser != nullptr, "libxml2 gives no parser");
  Builder tree(parser.get());
  std::memset(parser->sax, 0, sizeof *parser->sax);
  parser->sax->initialized = XML_SAX2_MAGIC;
  parser->sax->startElementNs = start_element;
  parser->sax->endElementNs = end_element;
  parser->sax->characters = characters;
  parser->sax->cdataBlock = characters;
  parser->sax->internalSubset = document_type;
  parser->sax->serror = parse_error;
  parser->userData = &tree;
  // NOENT decodes "&amp;"; it can do no harm, because without DOCTYPE nobody defines entities.
  // HUGE lifts the limit of 10 MB per attribute; depth and size have our own limits.
  const int options = XML_PARSE_NONET | XML_PARSE_NOENT | XML_PARSE_HUGE;
  xmlCtxtReadMemory(parser.get(), text.data(), static_cast<int>(text.size()), nullptr, nullptr,
                    options);
  if (tree.failed()) throw tree.error(file);
  XmlElement root = tree.take_root();
  if (root.name.empty()) throw InputError(Where{file, 1, {}}, "not well-formed XML: no element");
  return root;
}

}  // namespace culm::deck
