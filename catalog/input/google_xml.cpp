// SPDX-License-Identifier: GPL-3.0-or-later
// Google's feed as XML: RSS 2.0 (<item>) or Atom (<entry>), attributes in the namespace of Merchant Center. expat reads
// it piece by piece and keeps nothing; a document type is refused where it begins, and with it every entity of one's
// own.
#include <expat.h>

#include <algorithm>
#include <memory>

#include "feed_table.hpp"
#include "google.hpp"
#include "text.hpp"

namespace vitrine::input {
namespace {

constexpr int deepest_element = 16;
constexpr std::size_t max_text = 32'768;  // of one attribute

struct Feed {
  XML_Parser parser = nullptr;
  const std::string& file;
  const Rules& rules;
  std::vector<GoogleRow> rows;
  int depth = 0;
  int item_depth = 0;  // depth of the open item; 0 outside
  std::string text;    // of the open attribute
  bool cut = false;    // the attribute is longer than we keep
  bool skip = false;   // inside something of another namespace
  std::optional<Error> error;

  void stop(const char* code, const std::string& what, const std::string& remedy) {
    if (!error) error = bad(code, place(), what, remedy);
    XML_StopParser(parser, XML_FALSE);
  }
  int line() const { return static_cast<int>(XML_GetCurrentLineNumber(parser)); }
  std::string place() const {
    return file + ":" + std::to_string(XML_GetCurrentLineNumber(parser)) + ": column " +
           std::to_string(XML_GetCurrentColumnNumber(parser) + 1);
  }
};

/// "namespace|name" in its parts. Item elements are those of Google, of Atom, or of none.
bool ours(std::string_view name, std::string_view& local) {
  const auto bar = name.rfind('|');
  local = bar == std::string_view::npos ? name : name.substr(bar + 1);
  const std::string_view space = bar == std::string_view::npos ? "" : name.substr(0, bar);
  return space.empty() || space == "http://base.google.com/ns/1.0" || space == "https://base.google.com/ns/1.0" ||
         space == "http://www.w3.org/2005/Atom";
}

void XMLCALL on_start(void* user, const XML_Char* name, const XML_Char**) {
  Feed& feed = *static_cast<Feed*>(user);
  std::string_view local;
  const bool known = ours(name, local);
  if (++feed.depth > deepest_element)
    return feed.stop("FEED_XML", "elements are nested more than 16 deep", "Give a plain product feed.");
  if (feed.depth == 1 && local != "rss" && local != "feed")
    return feed.stop("FEED_XML", "the file is no product feed: its root is <" + one_line(local, 60) + ">",
                     "Give RSS (<rss>) or Atom (<feed>) as Merchant Center takes them.");
  if (feed.item_depth == 0 && (local == "item" || local == "entry") && known) {
    if (feed.rows.size() >= max_rows)
      return feed.stop("FEED_TOO_LARGE", "the feed has more than 1,000,000 products",
                       "Split it into several catalogues.");
    feed.item_depth = feed.depth;
    feed.rows.emplace_back();
    feed.rows.back().product.line = feed.line();
  } else if (feed.item_depth > 0 && feed.depth == feed.item_depth + 1) {
    feed.text.clear();
    feed.cut = false;
    feed.skip = !known;
  }
}

void XMLCALL on_text(void* user, const XML_Char* text, int length) {
  Feed& feed = *static_cast<Feed*>(user);
  // The text of nested elements, such as <g:shipping>, belongs to nothing that we read.
  if (feed.item_depth == 0 || feed.depth != feed.item_depth + 1 || feed.skip) return;
  const std::size_t room = max_text - feed.text.size();
  feed.text.append(text, std::min(room, static_cast<std::size_t>(length)));
  feed.cut = feed.cut || static_cast<std::size_t>(length) > room;
}

void XMLCALL on_end(void* user, const XML_Char* name) {
  Feed& feed = *static_cast<Feed*>(user);
  if (feed.item_depth > 0 && feed.depth == feed.item_depth + 1 && !feed.skip) {
    std::string_view local;
    ours(name, local);
    const std::string column = plain_column(local);
    const auto alias = feed.rules.columns.find(column);
    const std::string& known = alias == feed.rules.columns.end() ? column : alias->second;
    GoogleRow& row = feed.rows.back();
    // Lines inside an element are layout.
    std::string value = feed.text;
    std::replace_if(
        value.begin(), value.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    value = trimmed(value);
    if (feed.cut && known != "description")
      row.product.refusal = bad("PRODUCT_VALUE", feed.place() + ": <" + one_line(local, 60) + ">",
                                "the text is longer than 32,768 bytes", "Shorten it.");
    take_google_attribute(row, known, shortened(value, max_text));
    for (std::size_t i = 0; i < feed.rules.measures.size(); ++i)
      if (!feed.rules.measures[i].column.empty() && feed.rules.measures[i].column == known)
        row.product.columns.emplace_back(i, one_line(value, 100));
  }
  if (feed.item_depth == feed.depth) feed.item_depth = 0;
  --feed.depth;
}

void XMLCALL on_doctype(void* user, const XML_Char*, const XML_Char*, const XML_Char*, int) {
  static_cast<Feed*>(user)->stop("FEED_XML", "the file declares a document type", "Remove the line <!DOCTYPE ...>.");
}

}  // namespace

Products read_google_xml(const std::string& file, std::string_view text, const Rules& rules) {
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreateNS(nullptr, '|'),
                                                                            XML_ParserFree);
  if (!parser) throw std::bad_alloc();
  Feed feed{parser.get(), file, rules, {}, 0, 0, "", false, false, {}};
  // The same hash seed every time: no entity or attribute of a stranger is kept that could be made to collide, as the
  // document type is refused and attributes of one element are few.
  XML_SetHashSalt(parser.get(), 1);
  XML_SetUserData(parser.get(), &feed);
  XML_SetElementHandler(parser.get(), on_start, on_end);
  XML_SetCharacterDataHandler(parser.get(), on_text);
  XML_SetStartDoctypeDeclHandler(parser.get(), on_doctype);
  XML_SetParamEntityParsing(parser.get(), XML_PARAM_ENTITY_PARSING_NEVER);
  constexpr std::size_t piece = 1 << 20;
  for (std::size_t at = 0; !feed.error;) {
    const std::size_t n = std::min(piece, text.size() - at);
    const bool last = at + n == text.size();
    const XML_Status status = XML_Parse(parser.get(), text.data() + at, static_cast<int>(n), last);
    if (status == XML_STATUS_ERROR && !feed.error) {
      const XML_Error code = XML_GetErrorCode(parser.get());
      const bool unbound = code == XML_ERROR_UNBOUND_PREFIX;
      feed.error = bad("FEED_XML", feed.place(), std::string("the XML is broken: ") + XML_ErrorString(code),
                       unbound ? "Add xmlns:g=\"http://base.google.com/ns/1.0\" to the root element."
                               : "Export the feed again; & must be written &amp; and < as &lt;.");
    }
    at += n;
    if (last) break;
  }
  if (feed.error) return *feed.error;
  return merge_google_rows(std::move(feed.rows), file);
}

}  // namespace vitrine::input
