// The errors of the impulses of a step in a fluid, from the residuals of gaps and slips.
#pragma once

#include <Eigen/QR>
#include <cstddef>
#include <span>
#include <vector>

#include "viscontact/immersed/contacts/fluid_contacts.hpp"

namespace viscontact::particles {

/// The impulses of the closed contacts of a step, and of their friction, as the solution of a
/// system of linear equations: closed gaps and slips that stick are 0, and friction that slides is
/// mu_s times the load of the solids. The errors dp of the impulses obey W dp = -v with the values
/// v that the gaps and slips have. The error of a single impulse is v/W_cc only if its neighbours
/// bear nothing: where a light particle carries a heavy one, it is larger by the ratio of their
/// mobilities. If contacts are redundant, dp is the smallest of all solutions.
class ClosedContacts {
 public:
  /// Impulses [M L/T] in the order of StepContacts; 0 for contacts that are not closed.
  struct Impulses {
    std::vector<double> of_contacts;
    std::vector<double> of_frictions;
  };

  /// `velocities` are those with the impulses of `step`; `mu_s` [1] is the coefficient of friction.
  /// `step` and `conditions` must outlive the object.
  ClosedContacts(const StepContacts& step, double mu_s, std::span<const double> velocities,
                 const ContactConditions& conditions);

  /// False if the step does not have the velocities by unit forces of all closed contacts. Then
  /// nothing else may be called.
  bool is_known() const { return is_known_; }
  /// What must be added to the impulses.
  Impulses corrections() const;
  /// The largest changes of the impulses by changes of gaps and slips of up to `error` [L] each.
  Impulses changes_by(double error) const;

 private:
  struct Row {
    std::size_t contact = 0, friction = 0;  // numbers in the step; `friction` only of slips
    bool is_slip = false;
  };
  struct Sliding {
    std::size_t friction = 0, row = 0;  // `row` is that of the gap of its contact
    double slope = 0;                   // of the friction over the load of the solids
    double rest = 0;                    // what the friction lacks [M L/T]
  };
  double change(const Row& row, std::span<const double> velocities) const;
  void add_rows(double mu_s, std::span<const double> velocities);
  void find_values(std::span<const double> velocities);
  void factorise();
  Impulses in_order(const Eigen::VectorXd& scaled) const;

  const StepContacts& step_;
  const ContactConditions& conditions_;
  bool is_known_ = true;
  std::vector<Row> rows_;                              // closed gaps and slips that stick
  std::vector<const std::vector<double>*> responses_;  // velocities by unit forces of the rows
  std::vector<Sliding> sliding_;
  Eigen::VectorXd values_, scales_;  // of the rows; scales are roots of W_rr
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factor_;
};

/// Corrects the impulses of a solved step if their errors are larger than allowed, with one call of
/// the mobility for each correction, and updates loads and velocities.
void correct_impulses(StepContacts& step, double mu_s, const Mobility& mobility,
                      const ContactConditions& conditions);

/// Replaces the errors of impulses in `residuals` (those of measure_residuals()) by the solutions
/// of W dp = -v (ClosedContacts), with the effect of rounding. An error is allowed if it is within
/// the tolerance, or if errors of the velocities explain it. If the step does not have all
/// velocities by unit forces, residuals are multiplied by StepContacts::amplification.
void take_errors_of_impulses(StepContacts& step, double mu_s, std::span<const double> velocities,
                             const ContactConditions& conditions, StepResiduals& residuals);

}  // namespace viscontact::particles
