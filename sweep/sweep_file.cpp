#include "sweep/sweep_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>

#include "common/csv.hpp"
#include "common/error.hpp"
#include "common/file.hpp"
#include "common/interrupt.hpp"
#include "common/number.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

/// What of a sweep decides its rows.
std::string identity_of(const SweepPlan& plan) {
  std::string text = read_file(plan.case_path) + write_fit(plan.fit);
  // A force that the case reads from a file.
  for (const auto& file : read_case(plan.case_path).force_files) text += read_file(file);
  for (const auto& v : plan.variations) {
    text += fmt::format("{}={}:{}:{}:{};", v.key, format_number(v.first), format_number(v.last),
                        v.logarithmic, v.count);
    for (const double value : v.values) text += format_number(value) + ",";
  }
  return sha256(fmt::format("{}{}{}{}{}{}{}", text, plan.samples, plan.seed,
                            fmt::join(plan.models, ","), plan.reference,
                            static_cast<int>(plan.below), static_cast<int>(plan.above)));
}

std::string header_of(const SweepPlan& plan, const std::string& version) {
  return write_csv_comments({{"viscontact", "sweep"},
                             {"case", sha256(read_file(plan.case_path))},
                             {"fit", sha256(write_fit(plan.fit))},
                             {"reference", plan.reference},
                             {"rows", std::to_string(sweep_size(plan))},
                             {"sweep", identity_of(plan)},
                             {"version of Viscontact", version}}) +
         fmt::format("{}\n", fmt::join(sweep_columns(plan), ","));
}

/// Whole rows after the header, and the bytes up to the end of the last one. Nothing if the file does not begin with the header.
struct Kept {
  std::uint64_t rows = 0, bytes = 0;
};
std::optional<Kept> kept_rows(const fs::path& path, const std::string& header) {
  std::ifstream file(path, std::ios::binary);
  std::string begin(header.size(), '\0');
  if (!file.read(begin.data(), static_cast<std::streamsize>(begin.size())) || begin != header)
    return {};
  Kept kept{0, header.size()};
  std::string line;
  while (std::getline(file, line) && !file.eof()) {
    ++kept.rows;
    kept.bytes += line.size() + 1;
  }
  return kept;
}

/// A file that is appended to, every call checked.
class Appended {
 public:
  explicit Appended(const fs::path& path) : path_(path), file_(std::fopen(path.c_str(), "ab")) {
    if (!file_) fail();
  }
  void write(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail();
  }
  void flush() {
    if (std::fflush(file_.get()) != 0) fail();
  }

 private:
  [[noreturn]] void fail() const {
    throw_bad_input({path_.string()}, fmt::format("cannot be written ({})", std::strerror(errno)));
  }
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  fs::path path_;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace

std::uint64_t write_sweep(
    const Sweep& sweep, const fs::path& path, int jobs, const std::string& version,
    const std::function<void(std::uint64_t done, std::uint64_t size)>& progress) {
  const std::uint64_t size = sweep_size(sweep.plan());
  const std::string header = header_of(sweep.plan(), version);
  if (const auto finished = kept_rows(path, header); finished && finished->rows == size) return 0;
  const fs::path target = check_output_file(path);
  fs::path part = target;
  part += ".part";
  auto kept = kept_rows(part, header);
  if (kept) {
    fs::resize_file(part, kept->bytes);  // a row that was cut off
  } else {
    write_file(part, header);
    kept = {0, header.size()};
  }
  Appended file(part);
  constexpr std::uint64_t kRowsBetweenFlushes = 64;
  const std::uint64_t taken =
      run_sweep(sweep, kept->rows, jobs, [&](std::uint64_t index, const std::string& row) {
        file.write(row);
        if (index % kRowsBetweenFlushes == 0) file.flush();
        progress(index + 1, size);
      });
  file.flush();
  if (taken < size)
    throw Error(ExitCode::kInterrupted,
                fmt::format("interrupted; {} of {} rows are kept in {}: the same command goes on",
                            taken, size, part.string()));
  fs::rename(part, target);
  sync_folder_of(target);
  return size - kept->rows;
}

}  // namespace viscontact
