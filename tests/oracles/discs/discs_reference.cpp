// Prints data/reference/discs.csv, computed anew in some seconds:
//     build/release/discs_reference > data/reference/discs.csv
#include <iostream>

#include "tests/oracles/discs/reference_discs.hpp"

int main() { std::cout << viscontact::reference_discs_text(); }
