#include "tests/program/browser.hpp"

#include <gmock/gmock.h>

#include <sstream>

#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/system/process.hpp"

namespace viscontact {
namespace {

constexpr std::string_view kTell = R"JS(
<script>
const tell = found => {
  const pre = parent.document.createElement('pre');
  pre.id = 'found';
  pre.textContent = JSON.stringify(found);
  parent.document.body.append(pre);
  console.log('reader has finished');
};
</script>
)JS";

std::string attribute(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
  return result;
}

std::string in_frame(const std::string& page, int width) {
  return "<!DOCTYPE html><meta charset=utf-8><body style=\"margin:0\"><iframe "
         "style=\"border:0;height:900px;width:" +
         std::to_string(width) + "px\" srcdoc=\"" + attribute(page) + "\"></iframe></body>";
}

/// Expects the reader's one word.
void expect_quiet(const std::string& log) {
  std::istringstream lines(log);
  int finished = 0;
  for (std::string line; std::getline(lines, line);)
    if (line.find(":CONSOLE") != std::string::npos) {
      EXPECT_THAT(line, ::testing::HasSubstr("reader has finished"));
      ++finished;
    }
  EXPECT_EQ(finished, 1) << log;
}

}  // namespace

nlohmann::json read_in_browser(const std::string& page, std::string_view script, int width) {
  const TemporaryFolder scratch;
  const auto file = scratch.file("read.html", in_frame(page + std::string(kTell) + "<script>" +
                                                           std::string(script) + "</script>\n",
                                                       width));
  const auto errors = scratch.path() / "browser.log";
  const auto result =
      run_process({"/bin/sh", "-c", "exec chromium \"$@\" 2>'" + errors.string() + "'", "sh",
                   "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                   "--no-first-run", "--user-data-dir=" + (scratch.path() / "profile").string(),
                   "--host-resolver-rules=MAP * ~NOTFOUND", "--enable-logging=stderr",
                   "--virtual-time-budget=120000", "--window-size=1300,1000", "--dump-dom",
                   "file://" + file.string()});
  const std::string log = read_file(errors);
  constexpr int kNotFound = 127;  // of the shell
  if (result.exit_status == kNotFound) {
    ADD_FAILURE() << "no chromium; run scripts/setup";
    return {};
  }
  expect_quiet(log);
  constexpr std::string_view kStart = "<pre id=\"found\">";
  const auto start = result.output.find(kStart);
  if (start == std::string::npos) {
    ADD_FAILURE() << "the page did not finish:\n" << log;
    return {};
  }
  const auto begin = start + kStart.size();
  return nlohmann::json::parse(
      result.output.substr(begin, result.output.find("</pre>", begin) - begin));
}

}  // namespace viscontact
