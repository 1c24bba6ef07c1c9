// The module gruebler._core: a door a kernel, arrays in, arrays out.
#include "base/processor.hpp"
#include "doors.hpp"

namespace nb = nanobind;

NB_MODULE(_core, module) {
    if (!gruebler::has_baseline()) {
        PyErr_SetString(PyExc_ImportError, "gruebler needs a processor with x86-64-v2 (SSE 4.2 and POPCNT)");
        throw nb::python_error();
    }
    gruebler::doors::add_algebra(module);
    gruebler::doors::add_atlas(module);
    gruebler::doors::add_counting(module);
    gruebler::doors::add_design(module);
    gruebler::doors::add_dynamics(module);
    gruebler::doors::add_labelling(module);
    gruebler::doors::add_layout(module);
    gruebler::doors::add_motion(module);
    gruebler::doors::add_space(module);
    gruebler::doors::add_structure(module);
}
