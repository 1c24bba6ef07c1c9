// Points, vectors and turns of the plane as complex numbers.
//
// Products are written out, so that every compiler rounds alike; std::complex leaves it open. All is of internal linkage,
// since files that are compiled for several levels use it (base/level.hpp).
#pragma once

namespace gruebler::motion {

struct Complex {
    double x, y;
};

namespace {

inline Complex operator+(Complex a, Complex b) { return {a.x + b.x, a.y + b.y}; }
inline Complex operator-(Complex a, Complex b) { return {a.x - b.x, a.y - b.y}; }
inline Complex operator-(Complex a) { return {-a.x, -a.y}; }
inline Complex operator*(Complex a, Complex b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }
inline Complex operator*(double s, Complex a) { return {s * a.x, s * a.y}; }
inline Complex operator/(Complex a, double s) { return {a.x / s, a.y / s}; }
inline Complex& operator+=(Complex& a, Complex b) { return a = a + b; }
inline Complex& operator-=(Complex& a, Complex b) { return a = a - b; }

inline Complex conjugate(Complex a) { return {a.x, -a.y}; }
inline Complex left(Complex a) { return {-a.y, a.x}; }  // turned by a right angle
inline double dot(Complex a, Complex b) { return a.x * b.x + a.y * b.y; }
inline double cross(Complex a, Complex b) { return a.x * b.y - a.y * b.x; }

// i w; of an infinite rate no part is a number then, and nothing that is made of it.
inline Complex imaginary(double w) { return {0 * w, w}; }

// 1 / z of a vector with this squared length.
inline Complex inverse(Complex z, double square) { return {z.x / square, -z.y / square}; }

inline double square(double x) { return x * x; }
inline double larger(double a, double b) { return b > a ? b : a; }
inline double smaller(double a, double b) { return b < a ? b : a; }

}  // namespace
}  // namespace gruebler::motion
