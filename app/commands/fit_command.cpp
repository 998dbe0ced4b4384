// Options of `fit` (fits of a table, comparison of bases) and `export` (a fit as code or numbers).
#include "viscontact/app/commands/fit_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "viscontact/app/command_options.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/common/number.hpp"
#include "viscontact/fitting/export/export_fit.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/pipeline/pipeline.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact {
namespace {

/// Reads the value of --fix, which fixes the leading coefficient. No value, "1/q" or "theory" fixes
/// it at its value by lubrication theory; "1/q=56.5" fixes it at 56.5. Throws Error(kWrongUsage)
/// for any other value.
void read_fix(const std::string& word, FitSettings& settings) {
  settings.hold_leading = true;
  if (word.empty() || word == kLeadingTerm || word == "theory") return;
  const std::string prefix = std::string(kLeadingTerm) + "=";
  settings.leading_value =
      word.starts_with(prefix) ? parse_number(word.substr(prefix.size())) : std::nullopt;
  if (!settings.leading_value)
    throw Error(
        ErrorKind::kWrongUsage,
        fmt::format("--fix is '{}'; it must be 1/q (theory's coefficient) or 1/q=NUMBER", word));
}

}  // namespace

void add_fit(CLI::App& app) {
  struct Options {
    std::string table, fit, basis = "lecture", terms, weights = "relative", loss = "none", fix,
                            plot;
    bool compare_bases = false, json = false;
  };
  auto* command = app.add_subcommand("fit", "least squares of a table");
  auto o = std::make_shared<Options>();
  command->add_option("TABLE", o->table, "table of forces (CSV)")->required()->type_name(kFile);
  auto* output =
      command->add_option("-o,--output", o->fit, "fit to write (JSON)")->type_name(kFile);
  auto* basis = command->add_option("--basis", o->basis, "terms of the formula")
                    ->type_name(words_of(all_bases()))
                    ->capture_default_str();
  auto* terms =
      command
          ->add_option("--terms", o->terms,
                       "a basis of your own: comma-separated, of: " + names_of(all_terms()))
          ->type_name("TERM,...")
          ->excludes(basis);
  command->add_option("--weights", o->weights, "residuals: relative to the force, or absolute")
      ->type_name("relative|absolute")
      ->capture_default_str();
  command
      ->add_option("--loss", o->loss,
                   "how large residuals count: none (least squares), or robust: huber, cauchy; "
                   "names the outliers")
      ->type_name("none|huber|cauchy")
      ->capture_default_str();
  auto* fix =
      command
          ->add_option(
              "--fix", o->fix,
              "hold the coefficient of 1/q: at theory's value, or at that of 1/q=VALUE (of the "
              "force at the table's first velocity)")
          ->expected(0, 1)
          ->type_name("[1/q[=VALUE]]");
  auto* bases = command->add_flag("--compare-bases", o->compare_bases,
                                  "print every basis side by side, and draw their residuals");
  add_json(*command, o->json)->needs(bases);
  command
      ->add_option("--plot", o->plot,
                   "picture of --compare-bases (SVG); default: beside the fit, or the table's "
                   "name with .bases.svg here")
      ->type_name(kFile);
  command->callback([o, output, terms, fix] {
    FitSettings settings;
    settings.basis = terms->count() == 0
                         ? from_option("--basis", [&] { return find_basis(o->basis); })
                         : from_option("--terms", [&] { return parse_terms(o->terms); });
    settings.weights = from_option("--weights", [&] { return parse_weights(o->weights); });
    settings.loss = from_option("--loss", [&] { return parse_loss(o->loss); });
    if (fix->count() > 0) read_fix(o->fix, settings);
    if (output->count() == 0 && !o->compare_bases)
      throw Error(ErrorKind::kWrongUsage,
                  "--output is required where --compare-bases is not given");
    if (!o->plot.empty() && !o->compare_bases)
      throw Error(ErrorKind::kWrongUsage, "--plot needs --compare-bases");
    std::filesystem::path plot = o->plot;
    if (plot.empty() && output->count() > 0)
      plot = std::filesystem::path(o->fit).replace_extension(".bases.svg");
    if (plot.empty()) plot = std::filesystem::path(o->table).stem().string() + ".bases.svg";
    auto outputs = std::vector<std::string>{};
    if (output->count() > 0) outputs.push_back(o->fit);
    if (o->compare_bases) outputs.push_back(plot.string());
    check_outputs(outputs);
    if (output->count() > 0) refuse_other_kind(o->fit, "\"gap_interval\"", "fit");
    if (o->compare_bases) refuse_other_kind(plot, "<svg", "picture");
    std::optional<Error> without_picture;
    try {
      if (o->compare_bases) compare_bases_stage(o->table, settings, plot, o->json);
    } catch (const Error& error) {
      // The fit does not need gnuplot, so it is written before this error is thrown.
      if (error.kind() != ErrorKind::kExternalProgram) throw;
      without_picture = error;
    }
    if (output->count() > 0) fit_stage(o->table, o->fit, settings, provenance_of({{o->table}, {}}));
    if (without_picture) throw Error(*without_picture);
  });
}

void add_export(CLI::App& app) {
  struct Options {
    std::string fit, target, output;
  };
  auto* command = app.add_subcommand("export", "a fit as code or numbers for other programs");
  auto o = std::make_shared<Options>();
  std::string targets;
  for (const auto& target : export_targets())
    targets +=
        fmt::format("{}{} ({})", targets.empty() ? "" : ", ", target.name, target.description);
  command->add_option("FIT", o->fit, "fit (JSON)")->required()->type_name(kFile);
  command->add_option("--to", o->target, targets)
      ->required()
      ->type_name(words_of(export_targets()));
  auto* output =
      command->add_option("-o,--output", o->output, "file to write; default: standard output")
          ->type_name(kFile);
  command->callback([o, output] {
    if (output->count() > 0) {
      check_outputs({o->output});
      refuse_other_kind(o->output, "written by 'viscontact export'", "export");
    }
    (void)from_option("--to",
                      [&] { return &require_named(export_targets(), o->target, "export target"); });
    const Fit fit = read_fit(o->fit);
    std::string text;
    try {
      text = export_fit(fit, o->target, std::filesystem::path(o->fit).filename().string());
    } catch (const Error& error) {
      throw Error(error.kind(), fmt::format("{}: {}", o->fit, error.what()));
    }
    if (output->count() > 0)
      write_output(o->output, find_named(export_targets(), o->target)->kind, text,
                   without_folders(provenance_of({{o->fit}, {}})));
    else
      fmt::print("{}", text);
  });
}

}  // namespace viscontact
