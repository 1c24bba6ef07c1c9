#include <complex>
#include <utility>

#include "algebra/certificate.hpp"
#include "algebra/modular.hpp"
#include "algebra/tracking.hpp"
#include "base/processor.hpp"
#include "doors.hpp"

namespace gruebler::doors {
namespace {

using namespace algebra;

using Number = std::complex<double>;
template <int unknowns>
using TaskOf = Array<Number, 4, unknowns>;
template <int unknowns>
using UnknownsOf = Array<Number, -1, unknowns>;
using Task = TaskOf<8>;
using Unknowns = UnknownsOf<8>;

struct LevelOfTracking {
    Level level;
    const char* name;
    Track* track;
    Refine* refine;
};

// The least level first.
constexpr LevelOfTracking levels[] = {
    {Level::baseline, "baseline", algebra::baseline::track, algebra::baseline::refine},
#ifdef GRUEBLER_X86_LEVELS
    {Level::v3, "v3", algebra::v3::track, algebra::v3::refine},
    {Level::v4, "v4", algebra::v4::track, algebra::v4::refine},
#endif
};

// The best level of this processor, or the one that is named.
const LevelOfTracking& level_of(const std::string& name) {
    const Level highest = highest_level();
    const LevelOfTracking* best = nullptr;
    for (const LevelOfTracking& each : levels) {
        if (each.level > highest) break;
        if (name.empty() || name == each.name) best = &each;
    }
    expect(best != nullptr, "this processor has no level " + name);
    return *best;
}

const double* parts(const Number* numbers) { return reinterpret_cast<const double*>(numbers); }

void check_shape(int positions, int points) {
    expect(positions >= 0 && positions <= 4 && points >= 0 && 2 * positions + points <= 8,
           "positions give two equations, points one: 0 to 8 of them");
}

Family family_of(const std::string& name, int unknowns, int positions, int points) {
    if (name == "Watt I") {
        expect(points == 0 && positions > 0 && 2 * positions <= unknowns && unknowns >= 10,
               "six-bars that guide a body have up to 5 positions besides the first for 10 unknowns, 7 for 14");
        return unknowns == 10 ? Family::watt_1 : Family::watt_1_free;
    }
    expect(unknowns < 14, "fourteen unknowns have Watt I");
    if (unknowns == 10) {
        expect(positions == 0 && points == 10, "ten unknowns have 10 points: pairs besides the first");
        if (name == "Stephenson II") return Family::stephenson_2;
        expect(name == "Stephenson III", "ten unknowns have Stephenson II or Stephenson III");
        return Family::stephenson_3;
    }
    if (name.empty()) {
        check_shape(positions, points);
        return Family::four_bars;
    }
    expect(positions == 0 && (points == 7 || points == 8), "six-bars have 7 or 8 points: pairs besides the first");
    if (name == "Watt II") return Family::watt_2;
    if (name == "Stephenson II") return Family::stephenson_2;
    expect(name == "Stephenson III", "no family " + name);
    return Family::stephenson_3;
}

template <int unknowns>
nb::tuple track(const UnknownsOf<unknowns>& starts, const TaskOf<unknowns>& begin, const TaskOf<unknowns>& end,
                int positions, int points, double loose, const std::string& family, const std::string& level) {
    const Family own = family_of(family, unknowns, positions, points);
    expect(loose > 0, "loose must be positive");
    Track* kernel = level_of(level).track;
    const std::size_t count = starts.shape(0);
    std::vector<Number> ends(count * unknowns);
    std::vector<std::int64_t> status(count), steps(count);
    const Paths paths{own, positions, points, static_cast<std::int64_t>(count), parts(starts.data()), parts(begin.data()),
                      parts(end.data()), loose, reinterpret_cast<double*>(ends.data()), status.data(), steps.data()};
    run([&](Watch& watch) { return kernel(paths, watch); });
    return nb::make_tuple(hand_over<Number>(std::move(ends), {count, unknowns}),
                          hand_over<std::int64_t>(std::move(status), {count}),
                          hand_over<std::int64_t>(std::move(steps), {count}));
}

template <int unknowns>
nb::tuple refine_solutions(const UnknownsOf<unknowns>& z, const TaskOf<unknowns>& task, int positions, int points,
                           const std::string& family, const std::string& level) {
    const Family own = family_of(family, unknowns, positions, points);
    Refine* kernel = level_of(level).refine;
    const std::size_t count = z.shape(0);
    std::vector<Number> refined(z.data(), z.data() + unknowns * count);
    std::vector<double> last_steps(count);
    const Solutions solutions{own, positions, points, static_cast<std::int64_t>(count), parts(task.data()),
                              reinterpret_cast<double*>(refined.data()), last_steps.data()};
    run([&](Watch& watch) { return kernel(solutions, watch); });
    return nb::make_tuple(hand_over<Number>(std::move(refined), {count, unknowns}),
                          hand_over<double>(std::move(last_steps), {count}));
}

Candidates candidates(const Unknowns& z, const Task& task, int positions, int points) {
    check_shape(positions, points);
    return {positions, points, static_cast<std::int64_t>(z.shape(0)), parts(task.data()), parts(z.data()), nullptr};
}

NewArray<bool> certify(const Unknowns& z, const Task& task, int positions, int points) {
    Candidates all = candidates(z, task, positions, points);
    const std::size_t count = z.shape(0);
    std::vector<std::uint8_t> proved(count);
    all.proved = proved.data();
    run([&](Watch& watch) { return algebra::certify(all, watch); });
    return hand_over<bool>(std::move(proved), {count});
}

nb::tuple evaluate_equations(const Unknowns& z, const Task& task, int positions, int points, bool sharp) {
    const Candidates all = candidates(z, task, positions, points);
    const std::size_t count = z.shape(0);
    std::vector<Number> values(8 * count), derivatives(64 * count);
    algebra::evaluate_equations(all, sharp, reinterpret_cast<double*>(values.data()),
                                reinterpret_cast<double*>(derivatives.data()));
    return nb::make_tuple(hand_over<Number>(std::move(values), {count, 8}),
                          hand_over<Number>(std::move(derivatives), {count, 8, 8}));
}

using Numbers = Array<std::int64_t, -1>;
using Table = Array<std::int64_t, -1, -1>;

void check_rows(const Numbers& start, const Numbers& column, const Numbers& value, std::int64_t columns) {
    const std::size_t length = start.shape(0), entries = column.shape(0);
    bool ascends = length > 0 && start.data()[0] == 0 && start.data()[length - 1] == static_cast<std::int64_t>(entries);
    for (std::size_t i = 1; i < length; ++i) ascends = ascends && start.data()[i - 1] <= start.data()[i];
    expect(ascends, "start must ascend from 0 to the number of entries " + std::to_string(entries));
    expect(value.shape(0) == entries, "value must have a number for each column");
    for (std::size_t e = 0; e < entries; ++e)
        expect(column.data()[e] >= 0 && column.data()[e] < columns, "an entry stands in a column that is none");
}

nb::tuple eliminate(const Numbers& start, const Numbers& column, const Numbers& value, std::int64_t columns,
                    double most_multiplications, double most_entries) {
    constexpr std::int64_t most_columns = std::int64_t{1} << 31;
    expect(columns >= 0 && columns < most_columns, "the number of columns is not negative");
    check_rows(start, column, value, columns);
    const std::int64_t rows = static_cast<std::int64_t>(start.shape(0)) - 1;
    std::vector<std::int64_t> last_row(static_cast<std::size_t>(columns), -1);
    for (std::int64_t i = 0; i < rows; ++i)
        for (std::int64_t e = start.data()[i]; e < start.data()[i + 1]; ++e)
            expect(std::exchange(last_row[static_cast<std::size_t>(column.data()[e])], i) != i,
                   "row " + std::to_string(i) + " has two entries in one column");
    Echelon form;
    const MostWork most{most_multiplications, most_entries};
    const SparseRows matrix{rows, columns, start.data(), column.data(), value.data()};
    const EliminationOutcome outcome =
        run([&](Watch& watch) { return algebra::eliminate(matrix, most, form, watch); });
    const std::size_t pivots = form.pivot.size(), entries = form.column.size();
    return nb::make_tuple(outcome.end == EliminationEnd::done, outcome.core_rows, outcome.core_columns,
                          hand_over<std::int64_t>(std::move(form.pivot), {pivots}),
                          hand_over<std::int64_t>(std::move(form.start), {pivots + 1}),
                          hand_over<std::int64_t>(std::move(form.column), {entries}),
                          hand_over<std::int64_t>(std::move(form.value), {entries}));
}

std::vector<std::int64_t> residues(const Table& table) {
    std::vector<std::int64_t> numbers(table.data(), table.data() + table.size());
    for (std::int64_t& number : numbers) number = (number % prime + prime) % prime;
    return numbers;
}

NewArray<std::int64_t> solve_back(const Numbers& pivot, const Numbers& start, const Numbers& column,
                                  const Numbers& value, const Table& solutions) {
    const auto columns = static_cast<std::int64_t>(solutions.shape(0));
    check_rows(start, column, value, columns);
    expect(start.shape(0) == pivot.shape(0) + 1, "start must have a number for each pivot and one more");
    for (std::size_t k = 0; k < pivot.shape(0); ++k)
        expect(pivot.data()[k] >= 0 && pivot.data()[k] < columns, "a pivot stands in a column that is none");
    const auto copied = [](const Numbers& numbers) {
        return std::vector<std::int64_t>(numbers.data(), numbers.data() + numbers.shape(0));
    };
    const Echelon form{copied(pivot), copied(start), copied(column), copied(value)};
    std::vector<std::int64_t> solved = residues(solutions);
    const std::size_t width = solutions.shape(1);
    run([&](Watch& watch) {
        return algebra::solve_back(form, static_cast<std::int64_t>(width), solved.data(), watch);
    });
    return hand_over<std::int64_t>(std::move(solved), {solutions.shape(0), width});
}

NewArray<std::int64_t> reduce(const Table& matrix) {
    std::vector<std::int64_t> rows = residues(matrix);
    const std::size_t width = matrix.shape(1);
    std::int64_t rank = 0;
    run([&](Watch& watch) {
        return algebra::reduce(static_cast<std::int64_t>(matrix.shape(0)), static_cast<std::int64_t>(width),
                               rows.data(), rank, watch);
    });
    rows.resize(static_cast<std::size_t>(rank) * width);
    return hand_over<std::int64_t>(std::move(rows), {static_cast<std::size_t>(rank), width});
}

template <int unknowns>
void add_tracking(nb::module_& module) {
    module.def("track", track<unknowns>, nb::arg("starts").noconvert(), nb::arg("begin").noconvert(), nb::arg("end").noconvert(),
               nb::arg("positions"), nb::arg("points"), nb::arg("loose"), nb::kw_only(), nb::arg("family") = "",
               nb::arg("level") = "",
               "Solutions of one task of four-bars followed to another, straight in the space of tasks: the ends "
               "complex[paths, 8], how each ended int64[paths] (0 arrived, 1 failed, 2 infinite), steps int64[paths]."
               "\n\n"
               "starts: complex[paths, 8], moving pivots x, x*, y, y*, fixed pivots a, a*, b, b*; begin, end: "
               "complex[4, 8], displacements t and their conjugates s of the positions, then of the points, turns g of "
               "the positions, values of the unknowns that no equation is left for; loose: how far the corrector may "
               "change a prediction; family: '' for four-bars, 'Watt II', 'Stephenson II' or 'Stephenson III' for six-bars "
               "whose input and output turn through points + 1 pairs: starts are a, f, p, q or a, b, f, p or a, f, c, p "
               "of docs/theory/synthesis-functions.md (of eleven pairs q, too, and all arrays have ten columns), each with its "
               "conjugate, a task has the turns of input and output, then the coefficients of the last equation: of the unknowns, and its constant, that of p p* "
               "(where the pairs leave nothing free, the first of them times the first unknown is taken from the last output); "
               "then of Stephenson's k, k*; or 'Watt I' for those that carry a body through positions + 1 positions: starts "
               "are c, d, f, G, H (of fourteen unknowns B - A, B, too) of docs/theory/synthesis-positions.md, a task has T, "
               "P, P*, then what is given, of ten unknowns B - A and B first; level: compiled for this instruction set, the "
               "best one by default.");
    module.def("refine_solutions", refine_solutions<unknowns>, nb::arg("z").noconvert(), nb::arg("task").noconvert(),
               nb::arg("positions"), nb::arg("points"), nb::kw_only(), nb::arg("family") = "", nb::arg("level") = "",
               "Newton's method for solutions of one task, with residuals of twice the digits: the solutions "
               "complex[n, 8] and the last relative step of each float64[n], infinite where the matrix is singular.\n\n"
               "The arguments are those of `track`.");
}

}  // namespace

void add_algebra(nb::module_& module) {
    module.def("eliminate", eliminate, nb::arg("start").noconvert(), nb::arg("column").noconvert(),
               nb::arg("value").noconvert(), nb::arg("columns"), nb::arg("most_multiplications"), nb::arg("most_entries"),
               "Sparse rows of whole numbers eliminated modulo 2^31 - 1: whether it is done, rows and columns of the "
               "dense core, and the echelon form as pivot columns int64[r], starts int64[r + 1], other columns and "
               "values after division by the pivot int64[e].\n\n"
               "start: int64[m + 1]; column, value: int64[e], row i has the entries start[i]:start[i + 1], each column "
               "at most once; most_multiplications, most_entries: a core that takes more is left, and it is not done.");
    module.def("solve_back", solve_back, nb::arg("pivot").noconvert(), nb::arg("start").noconvert(),
               nb::arg("column").noconvert(), nb::arg("value").noconvert(), nb::arg("solutions").noconvert(),
               "Solutions modulo 2^31 - 1 of the equations of an echelon form, int64[columns, k], from the values of "
               "the columns without pivot.\n\n"
               "pivot, start, column, value: the form as `eliminate` gives it; solutions: int64[columns, k].");
    module.def("reduce", reduce, nb::arg("matrix").noconvert(),
               "The reduced row echelon form modulo 2^31 - 1 of a dense matrix int64[m, n], without rows of zeros.");
    add_tracking<8>(module);
    add_tracking<10>(module);
    add_tracking<14>(module);
    module.def("certify", certify, nb::arg("z").noconvert(), nb::arg("task").noconvert(), nb::arg("positions"),
               nb::arg("points"),
               "Which solutions of one task are proved, each different from all others, by an interval Newton step: "
               "bool[n].\n\nThe arguments are those of `track`.");
    module.def("evaluate_equations", evaluate_equations, nb::arg("z").noconvert(), nb::arg("task").noconvert(),
               nb::arg("positions"), nb::arg("points"), nb::kw_only(), nb::arg("sharp") = false,
               "The equations of one task at unknowns: their values complex[n, 8] and derivatives complex[n, 8, 8].\n\n"
               "sharp: values are computed with twice the digits; the other arguments are those of `track`.");
}

}  // namespace gruebler::doors
