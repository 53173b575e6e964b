#pragma once
// How the program fails: by its exit code and what it says.

#include "app/program.h"
#include "support/catch.h"

#include <string>

namespace test {

/// It ends with this code, names what is wrong on stderr and says nothing on stdout.
inline void check_fails(const Workplace& place, int code, const std::string& arguments,
                        const std::string& message) {
    CAPTURE(arguments);
    const Workplace::Outcome outcome = place.hemilux(arguments);
    CHECK(outcome.code == code);
    CHECK_THAT(outcome.err, Catch::Contains(message));
    CHECK(outcome.out.empty());
}

} // namespace test
