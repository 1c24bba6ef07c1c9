// The five dyads in closed form, with velocity, acceleration and jerk.
//
// Each has two bodies and two unknowns at every order: the value by a square root (the assembly mode is its sign), the
// derivatives by one system of two linear equations whose matrix is the same for all orders. docs/theory/kinematics.md has the
// derivations.
#pragma once

#include "motion/plan.hpp"

namespace gruebler::motion {

// By `Slot`. The outer ones are where they are, the other four against their body, as it was before the dyad was placed.
using DyadElements = ElementJet[slots];

// The square of the number whose sign is the assembly mode, without unit: negative if nothing can be assembled.
//
// For RRR and RRP it is sin^2 of the transmission angle, for RPR the way along the slide in units of the size. PRP and RPP have
// one mode only: for them it is the sine of the angle between the lines, 0 where they are parallel. `driven` says that a drive
// changes the length of the arm of an RRP: then it is the way along the slide in units of the size, which is zero, and changes
// its sign, where an arm on the slide's line comes through the length 0.
double dyad_square(Kind kind, const DyadElements& elements, double size, bool driven);

// Whether the outer joints of RRR or RPR meet, or both of the arm of an RRP, so that their line has no direction.
//
// RPR has its slide in that line; with the slide through both joints any direction closes, so their line is not asked even
// where they are only nearly one. The same holds of an arm without length whose outer joint is on the slide.
bool outer_joints_meet(Kind kind, const DyadElements& elements, double size);

// Places both bodies; `root` is the signed root of `dyad_square`.
void place_dyad(Kind kind, double root, const DyadElements& elements, double size, bool driven, BodyJet& a, BodyJet& b);

// Writes velocity, acceleration and jerk of both bodies up to the order; they are placed already.
void dyad_rates(Kind kind, int order, const DyadElements& elements, BodyJet& a, BodyJet& b);

}  // namespace gruebler::motion
