#include "radiosity/engine/shooting/additions.h"

namespace hemilux {
namespace {

constinit Additions added_so_far;

} // namespace

const Additions& additions() { return added_so_far; }

bool add_to_engine(const Additions& added) {
    added_so_far = added;
    return true;
}

bool has_aimer() { return added_so_far.make_aimer != nullptr; }

} // namespace hemilux
