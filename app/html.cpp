#include "app/html.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace viscontact {

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
    else
      result += c;
  }
  return result;
}

std::string section(std::string_view heading, const std::string& body) {
  return body.empty() ? "" : fmt::format("<section>\n<h2>{}</h2>\n{}</section>\n", heading, body);
}

std::string link_to(const RunFolder& run, const std::string& file, std::string_view words) {
  const std::string text = escaped(words.empty() ? file : words);
  return std::filesystem::exists(run.path / file)
             ? fmt::format("<a href=\"{}\">{}</a>", escaped(file), text)
             : text;
}

}  // namespace viscontact
