// The compiled core of the package `hemilux`: its parts, and the program's errors as Python's.
//
// What the package's functions check, convert and explain stands in its Python files. The functions
// here take what these have checked.

#include "app/settings/exit_code.h"
#include "io/files/error.h"
#include "python/parts.h"
#include "python/scene.h"
#include "radiosity/paper/solution/solve_error.h"

namespace hemilux {
namespace {

void translate(std::exception_ptr thrown) {
    try {
        if (thrown)
            std::rethrow_exception(thrown);
    } catch (const InputError& error) {
        PyErr_SetString(PyExc_ValueError, error.what());
    } catch (const UsageError& error) {
        PyErr_SetString(PyExc_ValueError, error.what());
    } catch (const OutputError& error) {
        PyErr_SetString(PyExc_OSError, error.what());
    } catch (const SolveError& error) {
        PyErr_SetString(PyExc_ArithmeticError, error.what());
    }
}

} // namespace
} // namespace hemilux

PYBIND11_MODULE(_hemilux, module) {
    using namespace hemilux;
    module.attr("__version__") = HEMILUX_VERSION;
    py::register_exception_translator(translate);
    add_mesh(module);
    add_view_factors(module);
    add_solve(module);
    add_lighting(module);
    add_compare(module);
    add_rays(module);
    add_density(module);
}
