#pragma once
// Names the method `stored-transport` for those who solve by it without being asked for a method.

#include "radiosity/engine/solving/method.h"

namespace hemilux {

extern const Method stored_transport_method;

} // namespace hemilux
