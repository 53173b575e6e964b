#include "radiosity/engine/solving/engine_solver.h"

#include <stdexcept>

namespace hemilux {

void EngineSolver::save(StateWriter&) const {
    throw std::logic_error("this method cannot save its state");
}

void EngineSolver::load(StateReader&) { throw std::logic_error("this method cannot load a state"); }

} // namespace hemilux
