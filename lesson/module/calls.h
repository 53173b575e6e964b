#pragma once
// How the figures of the lesson call C++ and get answers.
//
// A function of the module takes numbers, addresses of numbers and texts, and answers whether it
// succeeded. Its results are doubles, one after the other, in answer(); what was wrong is a text in
// failure(). lesson/site/engine.js reads both.

#include "geometry/vector.h"

#include <cstdint>
#include <exception>
#include <string>
#include <vector>

/// Marks a function that pages may call.
#define LESSON_CALL extern "C" __attribute__((used, visibility("default")))

namespace hemilux::lesson {

[[nodiscard]] std::vector<double>& answer();
[[nodiscard]] std::string& failure();

inline void put(double value) { answer().push_back(value); }
inline void put(const Vec3& v) { put(v.x), put(v.y), put(v.z); }

/// Returns an object as a number that pages keep, and back.
template <class T>
[[nodiscard]] double handle_of(T* object) {
    return double(reinterpret_cast<std::uintptr_t>(object));
}

/// Calls body(), which puts its results.
template <class Body>
bool answered(const Body& body) {
    answer().clear();
    failure().clear();
    try {
        body();
        return true;
    } catch (const std::exception& error) {
        failure() = error.what();
        return false;
    }
}

} // namespace hemilux::lesson
