// Whether a text is well-formed XML, as far as programs here write it: elements, attributes in double quotes,
// text, the five named entities. No comments, no declarations.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace rubble::test {

/// The first `<` or `&` of a text or attribute that begins no named entity; empty when there is none.
inline std::string faultOfXmlText(const std::string& text) {
  for (std::size_t at = text.find_first_of("<&"); at != text.npos; at = text.find_first_of("<&", at + 1)) {
    bool isEntity = false;
    for (const char* entity : {"&amp;", "&lt;", "&gt;", "&quot;", "&apos;"})
      isEntity = isEntity || text.compare(at, std::string(entity).size(), entity) == 0;
    if (!isEntity) return "bare " + text.substr(at, 12);
  }
  return "";
}

/// Of what stands between `<` and `>` behind the name: ` key="value"` repeated.
inline std::string faultOfXmlAttributes(const std::string& text) {
  std::size_t at = 0;
  while (at < text.size()) {
    if (text[at++] != ' ') return "no space before an attribute in" + text;
    const std::size_t open = text.find("=\"", at);
    const std::size_t close = open == text.npos ? text.npos : text.find('"', open + 2);
    if (open == at || close == text.npos) return "an attribute without name or value in" + text;
    for (std::size_t c = at; c < open; ++c)
      if (!std::isalnum(static_cast<unsigned char>(text[c])) && text[c] != '-') return "a bad name in" + text;
    const std::string fault = faultOfXmlText(text.substr(open + 2, close - open - 2));
    if (!fault.empty()) return fault;
    at = close + 1;
  }
  return "";
}

/// What is wrong with the document; empty when it is well formed: one root, all elements closed in order.
inline std::string faultOfXml(const std::string& document) {
  std::vector<std::string> open;
  bool hadRoot = false;
  std::size_t at = 0;
  while (at < document.size()) {
    const std::size_t tag = std::min(document.find('<', at), document.size());
    const std::string text = document.substr(at, tag - at);
    if (open.empty() && text.find_first_not_of(" \n") != text.npos) return "text outside of the root";
    if (const std::string fault = faultOfXmlText(text); !fault.empty()) return fault;
    if (tag == document.size()) break;
    const std::size_t end = document.find('>', tag);
    if (end == document.npos) return "a tag without end";
    std::string inside = document.substr(tag + 1, end - tag - 1);
    at = end + 1;
    if (inside.starts_with("/")) {
      if (open.empty() || open.back() != inside.substr(1)) return "<" + inside + "> closes nothing";
      open.pop_back();
      continue;
    }
    if (open.empty() && hadRoot) return "two roots";
    hadRoot = true;
    const bool isClosed = inside.ends_with("/");
    if (isClosed) inside.pop_back();
    const std::size_t name = std::min(inside.find(' '), inside.size());
    if (name == 0) return "a tag without name";
    if (const std::string fault = faultOfXmlAttributes(inside.substr(name)); !fault.empty()) return fault;
    if (!isClosed) open.push_back(inside.substr(0, name));
  }
  if (!open.empty()) return "<" + open.back() + "> stays open";
  return hadRoot ? "" : "no root";
}

}  // namespace rubble::test
