// A new column of contacts is a row of contact_columns().
#include "viscontact/particle_runs/io/contact_columns.hpp"

#include <utility>

namespace viscontact::particles {
namespace {

bool set_value(double& value, std::span<const double> entries) {
  value = entries[0];
  return true;
}
bool set_value(std::int32_t& value, std::span<const double> entries) {
  value = static_cast<std::int32_t>(entries[0]);
  return true;
}
bool set_value(Vector& value, std::span<const double> entries) {
  std::ranges::copy(entries, value.begin());
  return true;
}
bool set_value(ContactFriction& value, std::span<const double> entries) {
  if (entries[0] < 0 || entries[0] > static_cast<double>(ContactFriction::kSlides)) return false;
  value = static_cast<ContactFriction>(entries[0]);
  return true;
}

/// A column with a member of CurrentContact.
template <auto kMember>
ContactColumn of_contact(const Declaration& declaration) {
  return {
      column<ContactRow>(declaration, [](const ContactRow& row) { return row.contact.*kMember; }),
      [](CurrentContact& contact, std::span<const double> entries) {
        return set_value(contact.*kMember, entries);
      }};
}

/// A column whose value follows from others.
template <class Read>
ContactColumn derived(const Declaration& declaration, Read read) {
  return {column<ContactRow>(declaration, read)};
}

/// The column of number k of CurrentContact::shown. Its name is that of `field` in kMemoryFields.
template <std::size_t k>
ContactColumn of_memory(const MemoryField& field) {
  return {column<ContactRow>({field.name, "", "a number that a contact law remembers"},
                             [](const ContactRow& row) { return std::get<k>(row.contact.shown); }),
          [](CurrentContact& contact, std::span<const double> entries) {
            return set_value(std::get<k>(contact.shown), entries);
          }};
}

template <std::size_t... k>
void add_memories(std::vector<ContactColumn>& columns, std::index_sequence<k...> /*of_shown*/) {
  std::vector<MemoryField> fields;
  std::ranges::copy_if(kMemoryFields, std::back_inserter(fields), &MemoryField::is_shown);
  (columns.push_back(of_memory<k>(fields[k])), ...);
}

std::int32_t id_of(const Particles& particles, std::int32_t number) {
  return number < 0 ? number : particles.id(index_of(number));
}

constexpr Condition kInPeriods{[](const RunFacts& run) { return run.is_periodic; },
                               "in periodic domains"};
constexpr Condition kOffAxis{[](const RunFacts& run) { return run.dimension > 1; },
                             "not on an axis"};

constexpr Presence kFilesOnly{.python = kNever};
constexpr Presence frames_and_python(const Condition& in_frames) {
  return {.at_end = kNever, .over_time = kNever, .frames = in_frames};
}
constexpr Presence kPythonOnly = frames_and_python(kNever);

std::vector<ContactColumn> make_contact_columns() {
  using Contact = CurrentContact;
  std::vector<ContactColumn> columns = {
      derived({"time", "T", "", {.at_end = kNever, .frames = kNever, .python = kNever}},
              [](const ContactRow& row) { return row.time; }),
      derived({"i", "", "id of the first particle; at an obstacle that of the particle", kFilesOnly,
               nullptr, "first"},
              [](const ContactRow& row) { return ids_of(row.particles, row.contact).first; }),
      derived({"j", "", "id of the second particle; at an obstacle -1, -2, ...", kFilesOnly,
               nullptr, "second"},
              [](const ContactRow& row) { return ids_of(row.particles, row.contact).second; }),
      derived({"first", "", "id of the first particle; at an obstacle -1, -2, ...", kPythonOnly},
              [](const ContactRow& row) { return id_of(row.particles, row.contact.first); }),
      derived({"second", "", "id of the second particle; at an obstacle that of the particle",
               kPythonOnly},
              [](const ContactRow& row) { return id_of(row.particles, row.contact.second); }),
      of_contact<&Contact::gap>({"gap", "L", "< 0 where the two overlap"}),
      of_contact<&Contact::gamma>(
          {"gamma", "M L/T", "minus the impulse that the film has absorbed, <= 0"}),
      of_contact<&Contact::gamma_error>(
          {"gamma_error",
           "M L/T",
           "[estimate](particles.md#the-projection) of the error of gamma",
           {.over_time = kNever, .frames = kNever}}),
      of_contact<&Contact::image>(
          {"image", "",
           "the periodic image of the second particle that meets the first one, x "
           "+ 3 y + 9 z for a shift by x, y and z periods, each -1, 0 or 1",
           frames_and_python(kInPeriods)}),
      of_contact<&Contact::friction>(
          {"friction", "", "0 none, 1 sticks, 2 slides", frames_and_python(kWithFriction)}),
      of_contact<&Contact::normal_force>(
          {"normal_force", "M L/T²", "that of film and solids, > 0 where it pushes both apart"}),
      of_contact<&Contact::normal>(
          {"normal", "1", "unit vector from the first to the second body", kPythonOnly}),
      of_contact<&Contact::tangential_force>(
          {"tangential_force",
           "M L/T²",
           "on the second particle, or at an obstacle on the particle: the friction and, of a film "
           "that pulls so hard that the step does not resolve how its pair turns, its part across "
           "the normal, which acts on the centres "
           "([physics.md](physics.md#5-many-particles-particles), (5.21))",
           {.at_end = kOffAxis, .over_time = kOffAxis, .frames = kWithFriction}}),
      of_contact<&Contact::branch>(
          {"branch", "L",
           "from the centre of the first particle, or the nearest point of an "
           "obstacle, to the centre of the second",
           kPythonOnly}),
  };
  add_memories(columns, std::make_index_sequence<std::tuple_size_v<ShownMemory>>());
  columns.push_back(of_contact<&Contact::solid_force>(
      {"solid_force",
       "M L/T²",
       "the part of `normal_force` that the solids bear, and not the film: Coulomb's law is "
       "\\|T\\| "
       "<= mu_s `solid_force`",
       {.at_end = kWithFriction, .over_time = kWithFriction, .frames = kWithFriction}}));
  // A new column stands here, at the end of the list, so that the others keep their places.
  return columns;
}

}  // namespace

const std::vector<ContactColumn>& contact_columns() {
  static const auto columns = make_contact_columns();
  return columns;
}

ColumnTable contact_column_table() {
  return column_table("contacts", contact_columns(),
                      {{Output::kAtEnd, "`final_contacts.csv`"},
                       {Output::kOverTime, "`contacts.csv`"},
                       {Output::kFrames, "frames, HDF5"},
                       {Output::kPython, "Python"}});
}

}  // namespace viscontact::particles
