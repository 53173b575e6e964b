#include "radiosity/paper/solving/solver.h"

#include <stdexcept>

namespace hemilux {

void Solver::save(StateWriter&) const {
    throw std::logic_error("this method cannot save its state");
}

void Solver::load(StateReader&) { throw std::logic_error("this method cannot load a state"); }

} // namespace hemilux
