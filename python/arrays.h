#pragma once
// Arrays of NumPy from vectors, without a copy, and back.

#include "geometry/vector.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace hemilux {

namespace py = pybind11;

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Integers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

namespace arrays_detail {

/// Makes an array that owns the vector, whose elements NumPy sees as numbers of type Number.
template <class Number, class T>
py::array_t<Number> owning(std::vector<T>&& values, const std::vector<py::ssize_t>& shape) {
    static_assert(sizeof(T) % sizeof(Number) == 0);
    auto kept = std::make_unique<std::vector<T>>(std::move(values));
    const void* const data = kept->data();
    py::capsule owner(kept.get(), [](void* p) { delete static_cast<std::vector<T>*>(p); });
    (void)kept.release(); // now the capsule's
    return py::array_t<Number>(shape, static_cast<const Number*>(data), owner);
}

} // namespace arrays_detail

/// Returns an array of shape (n,) that owns the vector. Number may differ from T in its sign.
template <class Number, class T>
[[nodiscard]] py::array_t<Number> array_as(std::vector<T>&& values) {
    static_assert(sizeof(T) == sizeof(Number));
    const auto size = static_cast<py::ssize_t>(values.size());
    return arrays_detail::owning<Number>(std::move(values), {size});
}

template <class T>
[[nodiscard]] py::array_t<T> array_of(std::vector<T>&& values) {
    return array_as<T>(std::move(values));
}

/// Returns an array of shape (n, 3).
[[nodiscard]] inline py::array_t<double> array_of(std::vector<Vec3>&& values) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    const auto size = static_cast<py::ssize_t>(values.size());
    return arrays_detail::owning<double>(std::move(values), {size, 3});
}

/// Returns the rows of an array of shape (n, 3), which Python has checked.
[[nodiscard]] inline std::span<const Vec3> rows_of(const Doubles& array) {
    return {reinterpret_cast<const Vec3*>(array.data()), static_cast<std::size_t>(array.shape(0))};
}

/// Returns an array with a number for each patch or face, by make(index).
template <class T, class Make>
[[nodiscard]] auto array_by(std::size_t size, const Make& make) {
    std::vector<T> values;
    values.reserve(size);
    for (std::size_t i = 0; i < size; ++i)
        values.push_back(make(i));
    return array_of(std::move(values));
}

} // namespace hemilux
