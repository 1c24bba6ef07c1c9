// What the doors share: arrays, checks, and work without the lock of the interpreter.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/watch.hpp"

namespace gruebler::doors {

namespace nb = nanobind;

// An array of numpy as it is: of this kind, C-contiguous, nothing converted; -1 stands for any length. One that begins
// between two numbers in memory, as views of bytes may, is copied: kernels read whole numbers, several at once.
template <class Number, int... lengths>
struct Array : nb::ndarray<const Number, nb::numpy, nb::shape<lengths...>, nb::c_contig, nb::device::cpu> {
    using Base = nb::ndarray<const Number, nb::numpy, nb::shape<lengths...>, nb::c_contig, nb::device::cpu>;
    using Base::Base;
};

// An array of numpy that is written: one that begins between two numbers is refused, as a copy would not reach the caller.
template <class Number, int... lengths>
struct Room : nb::ndarray<Number, nb::numpy, nb::shape<lengths...>, nb::c_contig, nb::device::cpu> {
    using Base = nb::ndarray<Number, nb::numpy, nb::shape<lengths...>, nb::c_contig, nb::device::cpu>;
    using Base::Base;
};

template <class Number>
bool begins_at_a_number(const Number* data) {
    return reinterpret_cast<std::uintptr_t>(data) % alignof(Number) == 0;
}

template <class Number>
using NewArray = nb::ndarray<nb::numpy, Number>;

inline void expect(bool truth, const std::string& otherwise) {
    if (!truth) throw nb::value_error(otherwise.c_str());
}

// An array of numpy that takes over the memory of a vector; `Item` consists of numbers of the array's kind.
template <class Number, class Item>
NewArray<Number> hand_over(std::vector<Item>&& items, std::initializer_list<size_t> shape) {
    auto* owned = new std::vector<Item>(std::move(items));
    nb::capsule owner(owned, [](void* all) noexcept { delete static_cast<std::vector<Item>*>(all); });
    return NewArray<Number>(reinterpret_cast<Number*>(owned->data()), shape, owner);
}

// Whether no signal came, such as Ctrl-C; with the lock for this moment. The error of a handler stays set.
inline bool goes_on(void*) {
    nb::gil_scoped_acquire held;
    return PyErr_CheckSignals() == 0;
}

// Runs a kernel without the lock of the interpreter; a handler's error (KeyboardInterrupt) goes to the caller.
template <class Work>
auto run(Work work) {
    Watch watch{goes_on, nullptr};
    auto outcome = [&] {
        nb::gil_scoped_release released;
        return work(watch);
    }();
    if (PyErr_Occurred()) throw nb::python_error();
    return outcome;
}

void add_algebra(nb::module_& module);
void add_atlas(nb::module_& module);
void add_counting(nb::module_& module);
void add_design(nb::module_& module);
void add_dynamics(nb::module_& module);
void add_labelling(nb::module_& module);
void add_layout(nb::module_& module);
void add_motion(nb::module_& module);
void add_space(nb::module_& module);
void add_structure(nb::module_& module);

}  // namespace gruebler::doors

template <class Number, int... lengths>
struct nanobind::detail::type_caster<gruebler::doors::Array<Number, lengths...>> {
    using Array = gruebler::doors::Array<Number, lengths...>;
    using Whole = make_caster<typename Array::Base>;
    NB_TYPE_CASTER(Array, Whole::Name)

    bool from_python(handle given, uint8_t flags, cleanup_list* cleanup) noexcept {
        Whole whole;
        if (!whole.from_python(given, flags, cleanup)) return false;
        if (!gruebler::doors::begins_at_a_number(whole.value.data())) {
            PyObject* copy = PyObject_CallMethod(given.ptr(), "copy", nullptr);
            const bool copied = copy && whole.from_python(copy, flags, cleanup);
            Py_XDECREF(copy);
            if (!copied) return PyErr_Clear(), false;
        }
        static_cast<typename Array::Base&>(value) = std::move(whole.value);
        return true;
    }
};

template <class Number, int... lengths>
struct nanobind::detail::type_caster<gruebler::doors::Room<Number, lengths...>> {
    using Room = gruebler::doors::Room<Number, lengths...>;
    using Whole = make_caster<typename Room::Base>;
    NB_TYPE_CASTER(Room, Whole::Name)

    bool from_python(handle given, uint8_t flags, cleanup_list* cleanup) noexcept {
        Whole whole;
        if (!whole.from_python(given, flags, cleanup) || !gruebler::doors::begins_at_a_number(whole.value.data()))
            return false;
        static_cast<typename Room::Base&>(value) = std::move(whole.value);
        return true;
    }
};
