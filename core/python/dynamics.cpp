#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "doors.hpp"
#include "dynamics/series.hpp"

namespace gruebler::doors {
namespace {

using namespace dynamics;

using Ends = Array<double, -1, 4>;
using Coefficients = Array<double, -1, -1, quantities>;

Series series_of(const Ends& ends, const Coefficients& coefficients, double closed) {
    expect(ends.shape(0) == coefficients.shape(0), "ends must have a row for each piece");
    expect(coefficients.shape(1) > 0, "a series has one coefficient at least");
    Series series{};
    series.pieces = static_cast<std::int64_t>(ends.shape(0));
    series.orders = static_cast<std::int64_t>(coefficients.shape(1));
    series.piece = reinterpret_cast<const Piece*>(ends.data());
    series.coefficient = coefficients.data();
    series.closed = closed;
    return series;
}

nb::object reduced_forces(const Ends& ends, const Coefficients& coefficients, double closed, double q, double speed) {
    Reduced reduced;
    if (!reduce(series_of(ends, coefficients, closed), q, speed, reduced)) return nb::none();
    return nb::make_tuple(reduced.mass, reduced.force, reduced.power);
}

State state_of(const Array<double, width>& given) {
    State state;
    std::memcpy(state.data(), given.data(), sizeof state);
    return state;
}

nb::object free_step(const Ends& ends, const Coefficients& coefficients, double closed,
                     const Array<double, stages, stages>& a, const Array<double, stages>& b,
                     const Array<double, stages + 1>& e3, const Array<double, stages + 1>& e5, double time,
                     const Array<double, width>& state, const Array<double, width>& rate, double length, double until,
                     double relative, const Array<double, width>& absolute) {
    const Series series = series_of(ends, coefficients, closed);
    expect(std::isfinite(time) && until > time && std::isfinite(until), "the time ends after it begins");
    expect(length > 0 && std::isfinite(length), "a step has a positive length");
    const Method method{a.data(), b.data(), e3.data(), e5.data(), nullptr, nullptr};
    Step taken;
    const Ended ended = step(series, method, time, state_of(state), state_of(rate), length, until, relative,
                             state_of(absolute), taken);
    if (ended != Ended::stepped) return nb::none();
    std::vector<double> there(taken.state.begin(), taken.state.end());
    std::vector<State> rates(taken.rates.begin(), taken.rates.begin() + stages + 1);
    return nb::make_tuple(taken.time, taken.next, hand_over<double>(std::move(there), {width}),
                          hand_over<double>(std::move(rates), {stages + 1, width}), taken.evaluations);
}

constexpr std::int64_t most_steps = 1'000'000;  // no signal is heard between them

nb::object free_run(const Ends& ends, const Coefficients& coefficients, double closed,
                    const Array<double, stages, stages>& a, const Array<double, stages>& b,
                    const Array<double, stages + 1>& e3, const Array<double, stages + 1>& e5,
                    const Array<double, further_stages, all_stages>& further,
                    const Array<double, bends, all_stages>& bend, const Array<std::uint8_t, -1>& calm, double time,
                    const Array<double, width>& state, const Array<double, width>& rate, double length, double until,
                    double relative, const Array<double, width>& absolute, std::int64_t most,
                    const Array<double, -1>& stops) {
    const Series series = series_of(ends, coefficients, closed);
    expect(calm.shape(0) == ends.shape(0), "calm must have a flag for each piece");
    expect(std::isfinite(time) && until > time && std::isfinite(until), "the time ends after it begins");
    expect(length > 0 && std::isfinite(length), "a step has a positive length");
    expect(most >= 0 && most <= most_steps, "at most a million steps are taken at once");
    const double *stop = stops.data(), *last = stop + stops.shape(0);
    expect(std::is_sorted(stop, last) && (stop == last || (*stop > time && last[-1] <= until)),
           "stops are in order, after the beginning and at most at the end");
    const Method method{a.data(), b.data(), e3.data(), e5.data(), further.data(), bend.data()};
    struct Row {
        double time;
        State state;
    };
    std::vector<Row> steps;
    std::vector<State> passed;
    std::int64_t evaluations = 0;
    Run run{time, length, state_of(state), state_of(rate)};
    {
        nb::gil_scoped_release released;
        advance(
            series, method, calm.data(), run, until, relative, state_of(absolute), most, stop, last,
            [&](const Run& now, std::int64_t counted) {
                steps.push_back({now.time, now.state});
                evaluations += counted;
            },
            [&](const State& there) { passed.push_back(there); });
    }
    const std::size_t count = steps.size(), rows = passed.size();
    std::vector<double> last_rate(run.rate.begin(), run.rate.end());
    return nb::make_tuple(hand_over<double>(std::move(steps), {count, width + 1}),
                          hand_over<double>(std::move(passed), {rows, width}),
                          hand_over<double>(std::move(last_rate), {width}), run.length, evaluations);
}

}  // namespace

void add_dynamics(nb::module_& module) {
    module.def("reduced_forces", reduced_forces, nb::arg("ends").noconvert(), nb::arg("coefficients").noconvert(),
               nb::arg("closed"), nb::arg("q"), nb::arg("speed"),
               "M, Q - h and the power by speed of what has no potential, of one freedom at a value and speed of its "
               "coordinate; None where no piece lies.\n\n"
               "ends: float64[n, 4], of each piece low, high, middle and half width; coefficients: float64[n, orders, "
               "6] of Chebyshev polynomials: M, h by speed squared, Q, Q by speed, the last two of what has no "
               "potential; closed: q from which a turn leads back, or NaN.");
    module.def("free_step", free_step, nb::arg("ends").noconvert(), nb::arg("coefficients").noconvert(),
               nb::arg("closed"), nb::arg("a").noconvert(), nb::arg("b").noconvert(), nb::arg("e3").noconvert(),
               nb::arg("e5").noconvert(), nb::arg("time"), nb::arg("state").noconvert(), nb::arg("rate").noconvert(),
               nb::arg("length"), nb::arg("until"), nb::arg("relative"), nb::arg("absolute").noconvert(),
               "One step of a free motion by the rules of scipy's DOP853: time, next length, float64[3] state, "
               "float64[13, 3] rates of the stages, evaluations; None where a stage lies on no piece or the step would "
               "be too short.\n\n"
               "The first three arguments are those of `reduced_forces`; a, b, e3, e5: of `scipy.integrate.DOP853`; "
               "state: q, its speed, work; rate: its rate; absolute: float64[3].");
    module.def("free_run", free_run, nb::arg("ends").noconvert(), nb::arg("coefficients").noconvert(),
               nb::arg("closed"), nb::arg("a").noconvert(), nb::arg("b").noconvert(), nb::arg("e3").noconvert(),
               nb::arg("e5").noconvert(), nb::arg("further").noconvert(), nb::arg("bend").noconvert(),
               nb::arg("calm").noconvert(), nb::arg("time"), nb::arg("state").noconvert(), nb::arg("rate").noconvert(),
               nb::arg("length"), nb::arg("until"), nb::arg("relative"), nb::arg("absolute").noconvert(),
               nb::arg("most"), nb::arg("stops").noconvert(),
               "Many steps as those of `free_step`: float64[n, 4] time and state after each, float64[m, 3] states at the "
               "stops that were passed, float64[3] rate at the end, next length, evaluations.\n\n"
               "It ends at `until`, after `most` steps, after a step to a piece that is not calm, and before one that "
               "`free_step` does not take. further, bend: A_EXTRA, D of `scipy.integrate.DOP853`; calm: uint8, a flag "
               "for each piece; stops: float64, times in order.");
}

}  // namespace gruebler::doors
