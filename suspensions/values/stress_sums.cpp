// Viscosity and normal stresses.
#include "viscontact/suspensions/values/stress_sums.hpp"

#include <cmath>
#include <limits>

namespace viscontact::suspensions {

using particles::Rheology;

void set_stresses(const StressSums& sums, const SymmetricTensor& strain_rate, double least_rate,
                  double viscosity, double volume, Rheology& rheology) {
  const double square = 2 * strain_rate.contracted(strain_rate), rate = std::sqrt(square);
  if (!(rate > 0) || rate < least_rate) return;
  rheology.shear_rate = rate;
  if (std::isinf(volume)) {
    for (auto member :
         {&Rheology::viscosity, &Rheology::n1, &Rheology::n2, &Rheology::pressure,
          &Rheology::viscosity_film, &Rheology::viscosity_contact, &Rheology::viscosity_friction})
      rheology.*member = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  const auto part = [&](const StressPart& sum) {
    return sum.power / (volume * viscosity * square);
  };
  rheology.viscosity_film = part(sums.film);
  rheology.viscosity_contact = part(sums.contact);
  rheology.viscosity_friction = part(sums.friction);
  rheology.viscosity = 1 + rheology.viscosity_film + rheology.viscosity_contact +
                       rheology.viscosity_friction + part(sums.repulsion);
  SymmetricTensor all;
  for (const auto* sum : {&sums.film, &sums.contact, &sums.friction, &sums.repulsion})
    all.add(1 / (volume * viscosity * rate), sum->stress);
  rheology.pressure = -all.trace() / 3;
  all.add(2 / rate, strain_rate);
  const auto& s = all.components;
  rheology.n1 = s[0] - s[1];
  rheology.n2 = s[1] - s[2];
}

}  // namespace viscontact::suspensions
