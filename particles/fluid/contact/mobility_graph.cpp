// Products with W by the mobility of a fluid (mobility_graph.hpp). Units are those of the case.
#include "viscontact/particles/fluid/contact/mobility_graph.hpp"

namespace viscontact::particles {

MobilityGraph::MobilityGraph(std::span<const FluidContact> contacts, std::span<const double> b,
                             std::span<const double> allowed, std::size_t motions,
                             const Mobility& mobility, const MotionLayout& layout)
    : contacts_(contacts), motions_(motions), mobility_(mobility), layout_(layout) {
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto& contact = contacts[c];
    const double root = std::sqrt(contact.w);
    scale.push_back(root);
    per_allowed.push_back(root / allowed[c]);
    z.push_back(std::max(contact.impulse, contact.gamma) * root);
    bound.push_back(contact.gamma * root);
    linear_term.push_back(b[c] / root);
  }
}

double MobilityGraph::to_bodies(std::span<const double> values, std::span<double> y) {
  const auto impulses = y.subspan(motions_);
  std::ranges::fill(impulses, 0.0);
  for (std::size_t c = 0; c < count(); ++c)
    if (values[c] != 0) add_contact_force(contacts_[c], values[c] / scale[c], impulses, layout_);
  // The mobility is linear, so that impulses give displacements as forces give velocities.
  const auto displacements = mobility_(impulses);
  ++products_;
  std::ranges::copy(displacements, y.begin());
  double form = 0;
  for (std::size_t i = 0; i < motions_; ++i) form += displacements[i] * impulses[i];
  return form;
}

double MobilityGraph::combine(std::span<const double> y, double factor,
                              std::span<double> into) const {
  for (std::size_t i = 0; i < into.size(); ++i) into[i] = y[i] + factor * into[i];
  double form = 0;
  for (std::size_t i = 0; i < motions_; ++i) form += into[i] * into[motions_ + i];
  return form;
}

double IdentityPreconditioner::apply(std::span<const double> gradient, std::vector<double>& swept,
                                     std::vector<double>& y) const {
  double product = 0;
  for (std::size_t c = 0; c < gradient.size(); ++c) {
    swept[c] = graph_->is_free(c) ? gradient[c] : 0.0;
    product += swept[c] * gradient[c];
  }
  graph_->to_bodies(swept, y);
  return product;
}

}  // namespace viscontact::particles
