// Escapes texts for HTML and for addresses (RFC 3986). Every text of the user must pass through
// escaped(), because it could contain markup.
#include "viscontact/report/html/html.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace viscontact::report {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (static_cast<unsigned char>(c) < ' ' && c != '\n' && c != '\t')
      result += "\uFFFD";  // XML does not allow control characters, not even escaped
    else
      result += c;
  }
  return result;
}

std::string section(std::string_view heading, const std::string& body) {
  return body.empty() ? "" : fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", heading, body);
}

namespace {

/// The name of a relative file as part of an address (RFC 3986).
std::string as_url(const std::string& file) {
  std::string url;
  for (const char c : file) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("-._~/").find(c) != std::string_view::npos;
    url += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return url;
}

}  // namespace

std::string link_to(const results::RunFolder& run, const std::string& file,
                    std::string_view words) {
  const std::string text = escaped(words.empty() ? file : words);
  return std::filesystem::exists(run.path / file)
             ? fmt::format("<a href=\"{}\">{}</a>", escaped(as_url(file)), text)
             : text;
}

}  // namespace viscontact::report
