#include "module/calls.h"

namespace hemilux::lesson {

std::vector<double>& answer() {
    static std::vector<double> values;
    return values;
}

std::string& failure() {
    static std::string text;
    return text;
}

} // namespace hemilux::lesson

using namespace hemilux::lesson;

LESSON_CALL const double* answer_begin() { return answer().data(); }
LESSON_CALL std::uint32_t answer_size() { return static_cast<std::uint32_t>(answer().size()); }
LESSON_CALL const char* failure_text() { return failure().c_str(); }
