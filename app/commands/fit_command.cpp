// `fit` (docs/theory.md), `shift` and `export`. refuse_other_kind() recognises a kind of file by a
// text in it, which is given here and again in python/fits.cpp.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "viscontact/app/arguments/command_options.hpp"
#include "viscontact/app/arguments/interrupt.hpp"
#include "viscontact/app/commands/commands.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/fitting/export/export_fit.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/lubrication/scaling.hpp"
#include "viscontact/motions/fit/export_pair.hpp"
#include "viscontact/motions/job/pair_fit_stage.hpp"
#include "viscontact/pipeline/fit_stages.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::app {
namespace {

/// Accepts finite numbers > 0. CLI11's own check of positive numbers accepts "nan".
CLI::Validator positive_number() {
  return {[](const std::string& text) {
            const auto number = parse_number(text);
            return number && std::isfinite(*number) && *number > 0
                       ? std::string()
                       : fmt::format("'{}' is not a finite number > 0", text);
          },
          "", "positive number"};
}

/// Reads `word`, the value of --fix, which fixes the coefficient of 1/q (q: the gap) in the force
/// at the table's first velocity [M L^2/T^2]: at the value of lubrication theory (docs/theory.md)
/// if the word is empty, "1/q" or "theory"; at 56.5 if it is "1/q=56.5". Other words throw
/// Error(kWrongUsage).
void read_fix(const std::string& word, fitting::FitSettings& settings) {
  settings.fix_leading = true;
  if (word.empty() || word == lubrication::kLeadingTerm || word == "theory") return;
  const std::string prefix = std::string(lubrication::kLeadingTerm) + "=";
  settings.leading_value =
      word.starts_with(prefix) ? parse_number(word.substr(prefix.size())) : std::nullopt;
  if (!settings.leading_value)
    throw Error(ErrorKind::kWrongUsage,
                "--fix is '{}'; it must be 1/q or theory (the value of theory), or 1/q=NUMBER",
                word);
}

/// The values of the options of `fit`, each named after its option; `fit` is that of --output.
/// `tables` are the arguments TABLE, and `table` is the first of them. Of the texts, only `basis`,
/// `weights` and `loss` have a default.
struct FitOptions {
  std::string basis{lubrication::default_basis().name};
  std::vector<std::string> tables;
  std::string table, fit, terms, weights = "relative", loss = "none", fix;
  results::PictureRequest plot;
  bool compare_bases = false, json = false;
  /// CLI11's objects, whose count() is 0 if the option was not given.
  const CLI::Option *output_option = nullptr, *terms_option = nullptr, *fix_option = nullptr,
                    *basis_option = nullptr, *weights_option = nullptr;
};

/// Fits the tables `files` of a pair, which is a sphere and its neighbour (a plane or another
/// body). Throws Error(kWrongUsage) for options of a single table.
void fit_tables_of_pair(const FitOptions& o, const std::vector<std::filesystem::path>& files) {
  if (o.terms_option->count() + o.fix_option->count() + o.weights_option->count() > 0 ||
      !o.plot.path.empty())
    throw Error(ErrorKind::kWrongUsage,
                "--terms, --fix, --weights and --plot are options of a single table of forces; the "
                "tables of a pair take --basis, --loss and --compare-bases");
  motions::PairFitSettings settings;
  if (o.basis_option->count() > 0) settings.basis = o.basis;
  (void)from_option("--basis", [&] {
    return motions::basis_of_entry(motions::pair_entries().front(), settings.basis);
  });
  settings.loss = from_option("--loss", [&] { return lubrication::parse_loss(o.loss); });
  if (o.output_option->count() == 0 && !o.compare_bases)
    throw Error(ErrorKind::kWrongUsage, "--output is required unless --compare-bases is given");
  if (o.compare_bases)
    motions::compare_pair_bases_stage(files, settings, o.json, interrupt_token());
  if (o.output_option->count() == 0) return;
  check_outputs({o.fit});
  results::refuse_other_kind(o.fit, "\"pair fit\"", "fit of a pair");
  motions::fit_pair_stage(files, o.fit, settings, interrupt_token());
}

/// Checks the options and the files to write, then compares bases if --compare-bases is given, and
/// writes the fit if --output is given.
void fit_table(FitOptions& o) {
  const auto files = motions::pair_table_files(o.tables);
  if (motions::are_of_pair(o.tables, files)) return fit_tables_of_pair(o, files);
  o.table = files.front().string();
  fitting::FitSettings settings;
  settings.basis = o.terms_option->count() == 0
                       ? from_option("--basis", [&] { return lubrication::find_basis(o.basis); })
                       : from_option("--terms", [&] { return lubrication::parse_terms(o.terms); });
  settings.weights =
      from_option("--weights", [&] { return lubrication::parse_weights(o.weights); });
  settings.loss = from_option("--loss", [&] { return lubrication::parse_loss(o.loss); });
  if (o.fix_option->count() > 0) read_fix(o.fix, settings);
  const bool fits = o.output_option->count() > 0;
  if (!fits && !o.compare_bases)
    throw Error(ErrorKind::kWrongUsage, "--output is required unless --compare-bases is given");
  if (!o.plot.path.empty() && !o.compare_bases)
    throw Error(ErrorKind::kWrongUsage, "--plot needs --compare-bases");
  auto plot = o.plot;
  if (plot.path.empty() && fits)
    plot.path = std::filesystem::path(o.fit).replace_extension(".bases.svg").string();
  if (plot.path.empty()) plot.path = std::filesystem::path(o.table).stem().string() + ".bases.svg";
  auto outputs = std::vector<std::string>{};
  if (fits) outputs.push_back(o.fit);
  if (o.compare_bases) outputs.push_back(plot.path);
  check_outputs(outputs);
  if (fits) results::refuse_other_kind(o.fit, "\"gap_interval\"", "fit");
  if (o.compare_bases) check_picture(plot.path);
  std::optional<Error> without_picture;
  try {
    if (o.compare_bases)
      pipeline::compare_bases_stage(o.table, settings, plot, o.json, interrupt_token());
  } catch (const Error& error) {
    // gnuplot is missing or failed. The fit does not need it and is written before the error is
    // thrown.
    if (error.kind() != ErrorKind::kExternalProgram) throw;
    without_picture = error;
  }
  if (fits)
    pipeline::fit_stage(o.table, o.fit, settings, results::provenance_of({{o.table}, {}}),
                        interrupt_token());
  if (without_picture) throw Error(*without_picture);
}

/// Paths of the fit and of the output, name of the target, and the words of --below and --above. An
/// empty text means that the option was not given.
struct ExportOptions {
  std::string fit, target, output, below, above;
  double radius = 0, viscosity = 0;  // [L], [M/(L T)]; 0: as in the fit
};

/// The fit in the file `o.fit`, of one force or of all resistances of a pair, as text for
/// `o.target`, the name of a language or format (fitting/export/). The text names `source` as its
/// origin. Throws Error(kWrongUsage) if --below or --above is given for a pair or for a target
/// without them.
std::string exported(const ExportOptions& o, const std::string& source) {
  const auto or_of_fit = [](double asked, double of_fit) { return asked > 0 ? asked : of_fit; };
  if (motions::is_pair_fit(o.fit)) {
    if (!o.below.empty() || !o.above.empty())
      throw Error(ErrorKind::kWrongUsage, "--below and --above are for the fit of the approach; " +
                                              o.fit + " is that of a pair");
    auto pair = motions::read_pair_fit(o.fit);
    const double viscosity = or_of_fit(o.viscosity, pair.viscosity);
    const double radius = or_of_fit(o.radius, pair.radius);
    pair = motions::scaled_to(std::move(pair), viscosity, radius);
    return in_file(o.fit, [&] { return motions::export_pair(pair, o.target, source); });
  }
  auto fit = lubrication::read_fit(o.fit);
  const double viscosity = or_of_fit(o.viscosity, fit.viscosity);
  const double radius = or_of_fit(o.radius, fit.radius);
  fit = lubrication::scaled_to(std::move(fit), viscosity, radius);
  lubrication::OutsideInterval outside;
  if (!o.below.empty())
    outside.below = o.below == "theory_limit" ? lubrication::BelowInterval::kTheoryLimit
                                              : lubrication::BelowInterval::kLubricationLimit;
  if (!o.above.empty()) outside.above = lubrication::AboveInterval::kStokesLimit;
  return in_file(o.fit, [&] { return fitting::export_fit(fit, o.target, source, outside); });
}

}  // namespace

void add_fit(CLI::App& app) {
  auto* command = app.add_subcommand("fit", "fit a formula to a table by least squares");
  auto o = std::make_shared<FitOptions>();
  add_value(*command, "TABLE", o->tables, kFile,
            "table of forces (CSV); or tables of several motions of one pair, or their folder")
      ->required();
  o->output_option = add_value(*command, "-o,--output", o->fit, kFile, "fit to write (JSON)");
  auto* basis =
      add_value(*command, "--basis", o->basis, names_of(lubrication::bases_beside_walls(), "|"),
                "terms of the formula; of a pair: asymptotic, asymptotic_extended, "
                "asymptotic_cubic (default) or asymptotic_quartic")
          ->capture_default_str();
  o->basis_option = basis;
  o->terms_option = add_value(*command, "--terms", o->terms, "TERM,...",
                              "a basis of your own: terms, separated by commas, from: " +
                                  names_of(lubrication::terms_beside_walls()))
                        ->excludes(basis);
  o->weights_option = add_value(*command, "--weights", o->weights, "relative|absolute",
                                "residuals: relative to the force, or absolute")
                          ->capture_default_str();
  add_value(*command, "--loss", o->loss, "none|huber|cauchy",
            "weight of large residuals: none (least squares), or a robust loss, huber or cauchy, "
            "with which outliers are listed")
      ->capture_default_str();
  o->fix_option = add_value(*command, "--fix", o->fix, "[1/q[=VALUE]]",
                            "fix the coefficient of 1/q in the force at the table's first "
                            "velocity: at theory's value, or with 1/q=VALUE at this value")
                      ->expected(0, 1);
  auto* bases =
      command->add_flag("--compare-bases", o->compare_bases,
                        "print the fits in all bases side by side, and draw their residuals");
  add_json(*command, o->json)->needs(bases);
  add_picture(
      *command, o->plot,
      "picture of --compare-bases (SVG, PDF, PNG or gnuplot's script, .gp); default: FIT.bases.svg "
      "beside the fit, or without a fit TABLE.bases.svg in the current folder");
  command->callback([o] { fit_table(*o); });
}

void add_shift(CLI::App& app) {
  struct Options {
    std::string table, fit, shift;
    results::PictureRequest plot;
  };
  auto* command = app.add_subcommand(
      "shift", "fit the depth below a rough wall's crests at which a smooth wall has equal drag");
  auto o = std::make_shared<Options>();
  add_value(*command, "TABLE", o->table, kFile, "the rough wall's table (CSV)")->required();
  add_value(*command, "--fit", o->fit, kFile, "fit of the smooth wall's force (JSON)")->required();
  add_value(*command, "-o,--output", o->shift, kFile, "shifts to write, row by row (CSV)")
      ->required();
  add_picture(*command, o->plot, "picture to write (SVG, PDF, PNG or gnuplot's script, .gp)");
  command->callback([o] {
    auto outputs = std::vector{o->shift};
    if (!o->plot.path.empty()) outputs.push_back(o->plot.path);
    check_outputs(outputs);
    results::refuse_other_kind(o->shift, "# viscontact: wall shift", "file of wall shifts");
    check_picture(o->plot.path);
    pipeline::shift_stage(o->table, o->fit, o->shift, o->plot, interrupt_token());
  });
}

void add_export(CLI::App& app) {
  auto* command = app.add_subcommand("export", "write a fit as code or numbers for other programs");
  auto o = std::make_shared<ExportOptions>();
  std::string targets;
  for (const auto& target : fitting::export_targets())
    targets +=
        fmt::format("{}{} ({})", targets.empty() ? "" : ", ", target.name, target.description);
  add_value(*command, "FIT", o->fit, kFile, "fit (JSON)")->required();
  add_value(*command, "--to", o->target, names_of(fitting::export_targets(), "|"), targets)
      ->required();
  auto* output = add_value(*command, "-o,--output", o->output, kFile,
                           "file to write; default: standard output");
  add_value(*command, "--below", o->below, "lubrication_limit|theory_limit",
            "the drag below the fit's smallest gap: it grows as k/q, with the fitted k or that of "
            "theory; default: the function has no value there")
      ->check(one_of({"lubrication_limit", "theory_limit"}));
  add_value(*command, "--above", o->above, "stokes_limit",
            "the drag above the fit's largest gap: it falls to Stokes' drag; default: the function "
            "has no value there")
      ->check(one_of({"stokes_limit"}));
  add_value(*command, "--radius", o->radius, "NUMBER",
            "radius to which the fit is scaled; default: that of the fit")
      ->check(positive_number());
  add_value(*command, "--viscosity", o->viscosity, "NUMBER",
            "viscosity to which the fit is scaled; default: that of the fit")
      ->check(positive_number());
  command->callback([o, output] {
    if (output->count() > 0) {
      check_outputs({o->output});
      results::refuse_other_kind(o->output, "written by 'viscontact export'", "export");
    }
    (void)from_option("--to", [&] {
      return &require_named(fitting::export_targets(), o->target, "export target");
    });
    const auto source = std::filesystem::path(o->fit).filename().string();
    const auto text = exported(*o, source);
    if (output->count() > 0)
      results::write_output(o->output, find_named(fitting::export_targets(), o->target)->kind, text,
                            results::without_folders(results::provenance_of({{o->fit}, {}})));
    else
      fmt::print("{}", text);
  });
}

}  // namespace viscontact::app
