// The classes Fit and PairFit and the functions tabulate, fit and fit_pair of Python
// (docs/python.md).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/lubrication/pairs/pair_resistance.hpp"
#include "viscontact/lubrication/pairs/squeeze_film.hpp"
#include "viscontact/lubrication/scaling.hpp"
#include "viscontact/motions/fit/fit_pair.hpp"
#include "viscontact/motions/job/pair_fit_stage.hpp"
#include "viscontact/particles/contact/film_law.hpp"
#include "viscontact/pipeline/tabulate/tabulate_stage.hpp"
#include "viscontact/python/call.hpp"
#include "viscontact/results/foreign_files.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/rolling/case/rolling_case.hpp"
#include "viscontact/swimmer/job/swimmer_stage.hpp"

namespace viscontact::python {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorKind::kWrongUsage, message);
}

/// The drag below and above the interval of the fit that these names stand for. Without a name, the
/// force at a gap on that side throws Error(kBadInput).
lubrication::OutsideInterval outside_of(const std::optional<std::string>& below,
                                        const std::optional<std::string>& above) {
  lubrication::OutsideInterval outside;
  if (below == "lubrication_limit")
    outside.below = lubrication::BelowInterval::kLubricationLimit;
  else if (below == "theory_limit")
    outside.below = lubrication::BelowInterval::kTheoryLimit;
  else if (below)
    refuse(
        fmt::format("below is '{}'; it must be None, lubrication_limit or theory_limit", *below));
  if (above == "stokes_limit")
    outside.above = lubrication::AboveInterval::kStokesLimit;
  else if (above)
    refuse(fmt::format("above is '{}'; it must be None or stokes_limit", *above));
  return outside;
}

/// `value`, or `other` if there is none. Throws Error(kWrongUsage), which names the argument
/// `name`, unless `value` is finite and > 0.
double positive_or(const std::optional<double>& value, double other, const char* name) {
  if (value && !(*value > 0 && std::isfinite(*value)))
    refuse(fmt::format("{} is {}; it must be a finite number > 0", name, *value));
  return value.value_or(other);
}

/// Scaled to `radius` [L] and `viscosity` [M/(L T)] if they are given.
PythonFit read_python_fit(const fs::path& path, const std::optional<std::string>& below,
                          const std::optional<std::string>& above,
                          const std::optional<double>& radius,
                          const std::optional<double>& viscosity) {
  auto fit = lubrication::read_fit(path);
  const double new_viscosity = positive_or(viscosity, fit.viscosity, "viscosity");
  const double new_radius = positive_or(radius, fit.radius, "radius");
  return {lubrication::scaled_to(std::move(fit), new_viscosity, new_radius), path.string(),
          outside_of(below, above)};
}

/// `kind`, as in app/commands/fit_command.cpp, is a text that every file of this kind contains.
/// Throws Error(kBadInput) if the file would replace one that is not of this kind.
void write_to(const fs::path& path, const std::string& text, const char* kind,
              const char* kind_in_words) {
  results::refuse_other_kind(path, kind, kind_in_words);
  if (!results::has_content(path, text))
    results::write_output(path, TextKind::kJson, text, results::provenance_of({}));
}

py::dict terms_of(const lubrication::Fit& fit) {
  py::dict terms;
  for (const auto& term : fit.terms) terms[py::str(term.name)] = term.coefficient;
  return terms;
}

std::vector<std::string> warnings_of(const lubrication::Fit& fit) {
  return fit.diagnostics ? fit.diagnostics->warnings : std::vector<std::string>{};
}

/// Throws Error(kWrongUsage) for arguments that exclude each other.
PythonFit fit_table(const fs::path& path, const std::optional<std::string>& basis,
                    const std::optional<std::string>& terms, const std::string& weights,
                    const std::string& loss, const py::object& fix,
                    const std::optional<std::string>& below,
                    const std::optional<std::string>& above,
                    const std::optional<fs::path>& output) {
  fitting::FitSettings settings;
  if (basis && terms) refuse("basis and terms are both given; give one of them");
  if (basis) settings.basis = lubrication::find_basis(*basis);
  if (terms) settings.basis = lubrication::parse_terms(*terms);
  settings.weights = lubrication::parse_weights(weights);
  settings.loss = lubrication::parse_loss(loss);
  if (!fix.is_none()) {
    settings.fix_leading = true;
    if (!py::isinstance<py::str>(fix))
      settings.leading_value = fix.cast<double>();
    else if (fix.cast<std::string>() != "theory")
      refuse("fix must be None, \"theory\" or the coefficient of 1/q");
  }
  const auto outside = outside_of(below, above);
  auto fit = long_call([&](const StopToken& stop) {
    const auto table = lubrication::read_force_table(path);
    auto made =
        with_place(path.string(), [&] { return fitting::fit_force_table(table, settings, stop); });
    made.table_sha256 = results::content_sha256(read_file(path));
    made.versions = results::library_versions();
    return made;
  });
  if (output) write_to(*output, lubrication::write_fit(fit), "\"gap_interval\"", "fit");
  return {std::move(fit), path.string(), outside};
}

motions::PairFit fit_pair_tables(const std::vector<fs::path>& paths, const std::string& basis,
                                 const std::string& loss, const std::optional<fs::path>& output) {
  motions::PairFitSettings settings{basis, lubrication::parse_loss(loss)};
  std::vector<std::string> words;
  for (const auto& path : paths) words.push_back(path.string());
  if (words.empty()) refuse("no table is given");
  auto fit = long_call([&](const StopToken& stop) {
    const auto files = motions::pair_table_files(words);
    auto made = with_place(files.front().string(), [&] {
      return motions::fit_pair(motions::read_pair_tables(files), settings, stop);
    });
    made.versions = results::library_versions();
    return made;
  });
  if (output) write_to(*output, motions::write_pair_fit(fit), "\"pair fit\"", "fit of a pair");
  return fit;
}

/// The tables of a case of one sphere, a rolling sphere or a swimmer. One table is the file
/// `output`; the tables of several motions are files in the folder `output`. `asked` names the
/// motions; if it is empty, the case names them.
std::vector<pipeline::CaseTable> tables_of(const fs::path& case_file, const fs::path& output,
                                           const std::vector<std::string>& asked) {
  const auto kind = case_file::kind_of_case(case_file);
  if (kind == case_file::CaseKind::kSwimmer)
    return {swimmer::case_table(swimmer::read_swimmer_case(case_file), output)};
  auto tabulation =
      kind == case_file::CaseKind::kRolling
          ? rolling::read_rolling_case(case_file).tabulation
          : std::optional(case_file::required_tabulation(case_file::read_case(case_file)));
  if (!tabulation) throw_bad_input({case_file.string()}, "the section [tabulation] is missing");
  if (!asked.empty())
    tabulation->motions = with_place(
        "motions", [&] { return freefem_axi::parse_motions(asked, tabulation->geometry); });
  const bool several = tabulation->motions.size() > 1;
  return pipeline::case_tables(
      case_file, read_file(case_file), *tabulation, [&](lubrication::MotionKind motion) {
        return several ? output / (std::string(to_string(motion)) + ".csv") : output;
      });
}

/// Returns the paths of the tables. `jobs` is the number of rows that are computed at once; 0 means
/// the number of cores. If rows failed, the error that names them is thrown after the other rows
/// are written.
std::vector<fs::path> tabulate(const fs::path& case_file, const fs::path& output, int jobs,
                               const std::vector<std::string>& motions) {
  if (jobs < 0) refuse(fmt::format("jobs is {}; it must be > 0, or 0 for all cores", jobs));
  if (jobs == 0) jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  return long_call([&](const StopToken& stop) {
    const auto tables = tables_of(case_file, output, motions);
    std::vector<fs::path> files;
    for (const auto& one : tables) {
      results::refuse_other_kind(one.table, "# case: ", "table");
      for (const auto& other : one.plan.companions)
        results::refuse_other_kind(other.path, "# case: ", "table");
      if (one.motions.empty()) files.push_back(one.table);
      for (const auto& [motion, file] : one.motions) files.push_back(file);
    }
    if (const auto failure = pipeline::tabulate_stage(tables, jobs, stop)) throw Error(*failure);
    return files;
  });
}

void add_fit(py::module_& module) {
  py::class_<PythonFit>(module, "Fit", R"(The lubrication force of a fit file.

Fit(path, below=None, above=None, radius=None, viscosity=None)

path       fit file (JSON), which `viscontact fit`, `viscontact run` or viscontact.fit() has written
below      "lubrication_limit" or "theory_limit": the force below the interval; None: an error
above      "stokes_limit": the force above the interval; None: an error
radius, viscosity
           of the sphere [L] and of the fluid [M/(L T)], to which the fit is scaled; None: its own

F_lub(q, u) = -R(q) u is the force [M L/T^2] on the sphere at the gap q [L] and the velocity u [L/T],
u > 0 away from the neighbour. A gap is a number or an array of any shape; the answer has the same
shape. A gap outside the interval is an InputError.)")
      .def(py::init(&read_python_fit), py::arg("path"), py::kw_only(),
           py::arg("below") = py::none(), py::arg("above") = py::none(),
           py::arg("radius") = py::none(), py::arg("viscosity") = py::none())
      .def_static(
          "exact_plane",
          [](double viscosity, double radius) {
            positive_or(viscosity, 0, "viscosity");
            positive_or(radius, 0, "radius");
            return PythonFit(lubrication::exact_plane_fit(viscosity, radius), "exact_plane", {});
          },
          "The exact drag of a sphere near a plane, at every gap > 0.\n\n"
          "viscosity [M/(L T)], radius [L]: numbers > 0",
          py::arg("viscosity"), py::arg("radius"))
      .def(
          "resistance",
          [](const PythonFit& fit, const Doubles& gap) {
            return mapped(gap, [&](double q) { return fit.force().resistance(q); });
          },
          "R(gap) [M/T] at gaps [L].", py::arg("gap"))
      .def(
          "force",
          [](const PythonFit& fit, const Doubles& gap, const py::object& velocity) {
            return -mapped(gap, [&](double q) { return fit.force().resistance(q); }) *
                   (py::isinstance<py::float_>(velocity) || py::isinstance<py::int_>(velocity)
                        ? velocity
                        : py::object(Doubles::ensure(velocity)));
          },
          "F_lub(gap, velocity) = -R(gap) velocity [M L/T^2] at gaps [L] and velocities [L/T], "
          "whose\n"
          "shapes are combined as NumPy does.",
          py::arg("gap"), py::arg("velocity"))
      .def(
          "impulse",
          [](const PythonFit& fit, const Doubles& gap) {
            return mapped(gap, [&](double q) { return fit.force().impulse(q); });
          },
          "Gamma(gap) [M L/T]: the integral of R from the radius to the gap [L].", py::arg("gap"))
      .def(
          "gap_of_impulse",
          [](const PythonFit& fit, const Doubles& impulse) {
            return mapped(impulse, [&](double g) { return fit.force().gap_of_impulse(g); });
          },
          "The gap [L] with Gamma(gap) = impulse [M L/T].", py::arg("impulse"))
      .def(
          "write",
          [](const PythonFit& fit, const fs::path& path) {
            write_to(path, lubrication::write_fit(fit.fit()), "\"gap_interval\"", "fit");
          },
          "Writes the fit file (JSON).", py::arg("path"))
      .def_property_readonly(
          "interval",
          [](const PythonFit& fit) {
            const auto [low, high] = fit.force().interval();
            return std::pair(low, high);
          },
          "The smallest and the largest gap [L] that the functions accept.")
      .def_property_readonly(
          "radius", [](const PythonFit& fit) { return fit.fit().radius; }, "of the sphere [L]")
      .def_property_readonly(
          "viscosity", [](const PythonFit& fit) { return fit.fit().viscosity; },
          "of the fluid [M/(L T)]")
      .def_property_readonly(
          "reference_velocity", [](const PythonFit& fit) { return fit.fit().reference_velocity; },
          "u0 [L/T], at which the coefficients are those of the force")
      .def_property_readonly(
          "basis", [](const PythonFit& fit) { return fit.fit().basis; }, "name of the basis")
      .def_property_readonly(
          "terms", [](const PythonFit& fit) { return terms_of(fit.fit()); },
          "The coefficient of each term in F_lub(q, u0), by its name.")
      .def_property_readonly(
          "largest_relative_residual",
          [](const PythonFit& fit) { return fit.fit().largest_relative_residual; },
          "The largest |fit/force - 1| of the rows of the table.")
      .def_property_readonly(
          "warnings", [](const PythonFit& fit) { return warnings_of(fit.fit()); },
          "Sentences that say what is wrong with the fit; mostly empty.")
      .def("__repr__", [](const PythonFit& fit) {
        const auto [low, high] = fit.force().interval();
        return fmt::format("<viscontact.Fit basis {}, radius {}, viscosity {}, gaps {} to {}>",
                           fit.fit().basis, fit.fit().radius, fit.fit().viscosity, low, high);
      });
}

void add_pair_fit(py::module_& module) {
  using motions::PairFit;
  py::class_<PairFit> pair(
      module, "PairFit",
      R"(The resistances of a sphere beside its neighbour, from a fit file of a pair.

PairFit(path, radius=None, viscosity=None)

path       fit file of a pair (JSON), which `viscontact fit` or viscontact.fit_pair() has written
radius, viscosity
           of the sphere [L] and of the fluid [M/(L T)], to which the fit is scaled; None: its own

The neighbour is at rest, and z goes from it to the sphere. With the velocities u along x, u_z along
z [L/T] and the angular velocities w about y, w_z about z [1/T], the fluid exerts

  F_z = -squeeze u_z,            F_x = -slide u + slide_roll w,
  T_y = slide_roll u - roll w,   T_z = -spin w_z.

A fit of tables with strains also has the stresslets S of the sphere, and the loads on a neighbour
that is a sphere.

A gap is a number or an array of any shape; the answer has the same shape. Outside the interval the
formula goes on.)");
  pair.def(py::init([](const fs::path& path, const std::optional<double>& radius,
                       const std::optional<double>& viscosity) {
             auto fit = motions::read_pair_fit(path);
             const double new_viscosity = positive_or(viscosity, fit.viscosity, "viscosity");
             const double new_radius = positive_or(radius, fit.radius, "radius");
             return motions::scaled_to(std::move(fit), new_viscosity, new_radius);
           }),
           py::arg("path"), py::kw_only(), py::arg("radius") = py::none(),
           py::arg("viscosity") = py::none());
  const std::array dimensions = {"[M/T]", "[M L/T]", "[M L^2/T]"};
  for (std::size_t e = 0; e < motions::pair_entries().size(); ++e) {
    const auto& named = motions::pair_entries()[e];
    const auto entry = static_cast<motions::PairEntry>(e);
    pair.def(
        std::string(named.name).c_str(),
        [entry](const PairFit& fit, const Doubles& gap) {
          return mapped(gap, [&](double q) { return motions::entry_value(fit, entry, q); });
        },
        fmt::format("{} {} at gaps [L].", named.description,
                    dimensions.at(static_cast<std::size_t>(named.power - 1)))
            .c_str(),
        py::arg("gap"));
  }
  pair.def(
          "write",
          [](const PairFit& fit, const fs::path& path) {
            write_to(path, motions::write_pair_fit(fit), "\"pair fit\"", "fit of a pair");
          },
          "Writes the fit file (JSON).", py::arg("path"))
      .def_property_readonly(
          "interval",
          [](const PairFit& fit) { return std::pair(fit.gap_interval[0], fit.gap_interval[1]); },
          "The gaps [L] that all tables contain.")
      .def_readonly("radius", &PairFit::radius, "of the sphere [L]")
      .def_readonly("viscosity", &PairFit::viscosity, "of the fluid [M/(L T)]")
      .def_readonly("geometry", &PairFit::geometry, "the neighbour in words")
      .def_property_readonly(
          "terms",
          [](const PairFit& fit) {
            py::dict entries;
            for (const auto& [entry, one] : fit.entries)
              entries[py::str(
                  std::string(motions::pair_entries()[static_cast<std::size_t>(entry)].name))] =
                  terms_of(one.fit);
            return entries;
          },
          "For each resistance that the tables determine, the coefficient of each term by its "
          "name.")
      .def("__repr__", [](const PairFit& fit) {
        return fmt::format("<viscontact.PairFit {}, radius {}, viscosity {}, gaps {} to {}>",
                           fit.geometry, fit.radius, fit.viscosity, fit.gap_interval[0],
                           fit.gap_interval[1]);
      });
}

/// The matrices of pairs in an array of the shape of the arguments, combined as NumPy does, and 22
/// by 22.
py::array pair_resistances(const py::object& radius1, const py::object& radius2,
                           const py::object& gap, double viscosity, bool balanced) {
  const py::sequence same =
      py::module_::import("numpy").attr("broadcast_arrays")(radius1, radius2, gap);
  const Doubles one = same[0].cast<Doubles>(), two = same[1].cast<Doubles>(),
                gaps = same[2].cast<Doubles>();
  constexpr auto kComponents = lubrication::kPairComponents;
  std::vector<py::ssize_t> shape(gaps.shape(), gaps.shape() + gaps.ndim());
  shape.insert(shape.end(), 2, static_cast<py::ssize_t>(kComponents));
  Doubles matrices(shape);
  const auto count = static_cast<std::size_t>(gaps.size());
  const std::span<const double> of_one(one.data(), count), of_two(two.data(), count),
      of_gap(gaps.data(), count);
  const std::span to(matrices.mutable_data(), count * kComponents * kComponents);
  const py::gil_scoped_release released;
  lubrication::pair_resistances(
      of_one, of_two, of_gap, viscosity, to,
      balanced ? lubrication::PairForm::kBalanced : lubrication::PairForm::kComplete);
  return matrices;
}

void require_film(double radius, double neighbour, double gap, double viscosity) {
  const auto is_positive = [](double x) { return x > 0 && std::isfinite(x); };
  if (!is_positive(radius) || !is_positive(gap) || !is_positive(viscosity))
    refuse(fmt::format(
        "a film needs a radius, gaps and a viscosity that are positive and finite; they "
        "are {}, {} and {}",
        radius, gap, viscosity));
  if (!(neighbour > 0 || neighbour < -radius))
    refuse(
        fmt::format("the radius of the neighbour is {}; it must be positive, infinite for a plane, "
                    "or minus the radius of a round wall that is larger than {}",
                    neighbour, radius));
}

lubrication::SqueezeIntegral squeeze(bool discs) {
  return particles::squeeze_integral(discs ? particles::FilmShape::kDiscs
                                           : particles::FilmShape::kSpheres);
}

double film_gamma(double radius, double neighbour, double begins_at, double gap, double viscosity,
                  bool discs) {
  require_film(radius, neighbour, gap, viscosity);
  require_film(radius, neighbour, begins_at, viscosity);
  if (!(gap <= begins_at)) refuse("a film is not thicker than the gap at which it begins");
  return -viscosity * squeeze(discs)(radius, neighbour, gap, begins_at);
}

double film_gap(double radius, double neighbour, double begins_at, double gamma, double viscosity,
                bool discs) {
  require_film(radius, neighbour, begins_at, viscosity);
  if (!(gamma <= 0 && std::isfinite(gamma))) refuse("gamma must be finite and at most 0");
  return lubrication::gap_of_squeeze(squeeze(discs), radius, neighbour, begins_at,
                                     -gamma / viscosity);
}

}  // namespace

void add_fits(py::module_& module) {
  add_fit(module);
  add_pair_fit(module);
  module.def("fit", &fit_table, R"(Fits a formula to a table of forces by least squares.

table      path of the table (CSV)
basis      "lecture" (default), "asymptotic" or "asymptotic_extended"
terms      in place of a basis: terms separated by commas, such as "1/q, ln q, 1"
weights    "relative" or "absolute": which residuals are minimised
loss       "none", "huber" or "cauchy"
fix        "theory" or a number [M L^2/T^2]: fixes the coefficient of 1/q in the force
below, above  as in Fit
output     path of the fit file to be written; None: no file is written

Returns a Fit.)",
             py::arg("table"), py::arg("basis") = py::none(), py::kw_only(),
             py::arg("terms") = py::none(), py::arg("weights") = "relative",
             py::arg("loss") = "none", py::arg("fix") = py::none(), py::arg("below") = py::none(),
             py::arg("above") = py::none(), py::arg("output") = py::none());
  module.def("fit_pair", &fit_pair_tables,
             R"(Fits the resistances of a pair to the tables of its motions.

tables     list of paths: tables (CSV), or folders with approach.csv, slide.csv, roll.csv, spin.csv
basis      "asymptotic", "asymptotic_extended", "asymptotic_cubic" or "asymptotic_quartic"
loss       "none", "huber" or "cauchy"
output     path of the fit file to be written; None: no file is written

Returns a PairFit.)",
             py::arg("tables"), py::kw_only(),
             py::arg("basis") = std::string(motions::kDefaultPairBasis), py::arg("loss") = "none",
             py::arg("output") = py::none());
  module.def("pair_resistance", &pair_resistances, py::arg("radius1"), py::arg("radius2"),
             py::arg("gap"), py::arg("viscosity") = 1.0, py::kw_only(), py::arg("balanced") = false,
             R"(The resistance of two spheres in unbounded Stokes flow to all motions and strains.

radius1, radius2  radii [L], within a factor of 1e9 of each other; infinite: a plane at rest, whose
                  rows and columns are 0
gap               distance of the surfaces [L], > 0
viscosity         of the fluid [M/(L T)]
balanced          True: the form without the resistance of the pair as a whole, K - K N (N^T K N)^-1
                  N^T K with its rigid motions N, whose forces and torques add up to 0

Radii and gaps are numbers or arrays, whose shapes are combined as NumPy does. Returns an array with
two further dimensions of 22: the symmetric matrix R with loads = R components. The axis z goes from
sphere 1 to sphere 2. The components of sphere 1, and then those of sphere 2, are
    velocity x, y, z; angular velocity x, y, z, each less that of the undisturbed flow at the centre;
    its strain rate E = e1 (zz - 1/3) sqrt(3/2)
        + (e2 (xz + zx) + e3 (yz + zy) + e4 (xx - yy) + e5 (xy + yx))/sqrt(2).
The loads are force and torque of the sphere on the fluid, and its stresslet in the basis of E.
docs/pairs.md has the errors for each ratio of the radii.)");
  module.def("film_gamma", py::vectorize(film_gamma), py::arg("radius"), py::arg("neighbour"),
             py::arg("begins_at"), py::arg("gap"), py::arg("viscosity") = 1.0, py::kw_only(),
             py::arg("discs") = false,
             R"(gamma of a film: minus the impulse that presses it from a gap to a smaller one.

radius      of the sphere or disc [L]
neighbour   its radius [L]; infinite for a plane, minus the radius of a round wall around the sphere
begins_at   gap at which the film begins [L]: the threshold gap in a fluid, r_eff without one
gap         to which it is pressed [L], at most begins_at; 2 s gives gamma_min of the roughness s
viscosity   [M/(L T)]
discs       True: of cylinders per length

Arguments are numbers or arrays. Returns gamma [M L/T], of discs [M/T]. docs/physics.md, (6.8).)");
  module.def("film_gap", py::vectorize(film_gap), py::arg("radius"), py::arg("neighbour"),
             py::arg("begins_at"), py::arg("gamma"), py::arg("viscosity") = 1.0, py::kw_only(),
             py::arg("discs") = false,
             R"(The gap [L] of a film from gamma <= 0, the inverse of film_gamma().)");
  module.def("_tabulate", &tabulate, py::arg("case"), py::arg("output"), py::arg("jobs"),
             py::arg("motions"));
}

}  // namespace viscontact::python
