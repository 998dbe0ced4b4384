// Which of the listed pairs take part in the problem of a step.
#pragma once

#include <cassert>
#include <cstddef>
#include <vector>

namespace viscontact::particles {

/// A pair takes part from the first round on if is_bound() or if its gap would close in the step.
/// After each solution those pairs join whose gaps the solution closes, and the problem is solved
/// again, until none joins. Solutions may be rough as long as pairs join. No pair leaves, because
/// its gap would close again.
class Selection {
 public:
  explicit Selection(std::size_t pairs) : is_decided_(pairs, 0) {}

  /// True if a pair takes part whatever its gap: a film holds it, whose lowest impulse [M L/T] is
  /// not 0, or it had an impulse in the step before.
  static bool is_bound(double lowest, double impulse) { return lowest != 0 || impulse != 0; }

  /// True if pair `k` has joined or is left out, and need not be asked again.
  bool is_decided(std::size_t k) const { return is_decided_[k] != 0; }
  void join(std::size_t k) {
    leave_out(k);
    members_.push_back(k);
  }
  /// No impulse of the pair can change its gap, or a link keeps the gap open.
  void leave_out(std::size_t k) {
    assert(!is_decided(k));
    is_decided_[k] = 1;
  }
  /// In the order of joining, which is that of the contacts in the problem.
  const std::vector<std::size_t>& members() const { return members_; }

 private:
  std::vector<char> is_decided_;
  std::vector<std::size_t> members_;
};

}  // namespace viscontact::particles
