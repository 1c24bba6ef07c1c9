#include "algebra/modular.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

namespace gruebler::algebra {
namespace {

using Residue = std::uint32_t;
using Wide = std::uint64_t;

constexpr Wide p = prime;

constexpr double dense_at = 0.1;          // the share of entries from which a dense core is cheaper than sparse rows
constexpr std::size_t dense_from = 40;    // ... provided that it has at least so many rows
constexpr double most_entries = 4e6;      // in sparse rows, from which the core is taken as dense
constexpr std::int64_t work_of_an_entry = 2;  // in the steps of the watch

// 2^31 = 1: the upper bits are added to the lower ones. The sum of a residue and a product of residues fits.
Residue reduced(Wide v) {
    v = (v & p) + (v >> 31);
    v = (v & p) + (v >> 31);
    return static_cast<Residue>(v >= p ? v - p : v);
}

Residue residue(std::int64_t v) {
    v %= prime;
    return static_cast<Residue>(v < 0 ? v + prime : v);
}

Residue times(Residue a, Residue b) { return reduced(Wide{a} * b); }
Residue negative(Residue a) { return a == 0 ? 0 : static_cast<Residue>(p - a); }

// Euclid: a u = r modulo p all the time.
Residue inverse(Residue a) {
    std::int64_t r = a, next_r = prime, u = 1, next_u = 0;
    while (next_r != 0) {
        const std::int64_t quotient = r / next_r;
        r = std::exchange(next_r, r - quotient * next_r);
        u = std::exchange(next_u, u - quotient * next_u);
    }
    return residue(u);
}

// Adds a multiple of one row to another, from a column on.
template <class Number>
void add(Number* __restrict row, const Number* __restrict other, Residue factor, std::int64_t from, std::int64_t end) {
    for (std::int64_t c = from; c < end; ++c)
        row[c] = reduced(static_cast<Wide>(row[c]) + Wide{factor} * static_cast<Residue>(other[c]));
}

struct Entry {
    std::int64_t column;
    Residue value;
};
using Row = std::vector<Entry>;  // columns ascend

bool before(const Entry& entry, std::int64_t column) { return entry.column < column; }

// The elimination of sparse rows, and of what is left as a dense matrix.
class Eliminator {
public:
    Eliminator(const SparseRows& matrix, Echelon& form, Watch& watch)
        : form_(form), watch_(watch), rows_(matrix.rows), in_column_(matrix.columns), count_(matrix.columns) {
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            for (std::int64_t k = matrix.start[i]; k < matrix.start[i + 1]; ++k)
                if (const Residue v = residue(matrix.value[k]); v != 0) rows_[i].push_back({matrix.column[k], v});
            std::sort(rows_[i].begin(), rows_[i].end(),
                      [](const Entry& a, const Entry& b) { return a.column < b.column; });
            for (const Entry& entry : rows_[i]) meet(entry.column, i);
            entries_ += rows_[i].size();
            if (rows_[i].empty()) continue;
            ++active_;
            shortest_.emplace(rows_[i].size(), i);
        }
    }

    EliminationOutcome run(const MostWork& most) {
        while (!shortest_.empty()) {
            const auto [size, i] = shortest_.top();
            shortest_.pop();
            if (rows_[i].size() != size) continue;  // it has changed since
            const double area = static_cast<double>(active_) * static_cast<double>(met_);
            if (active_ >= dense_from && static_cast<double>(entries_) > std::min(dense_at * area, most_entries)) {
                const auto rows = static_cast<std::int64_t>(active_);
                const double work = area * static_cast<double>(std::min(rows, met_));
                if (work > most.multiplications || area > most.entries)
                    return {EliminationEnd::core_too_large, rows, met_};
                return {eliminate_core() ? EliminationEnd::done : EliminationEnd::interrupted, rows, met_};
            }
            if (!take(i)) return {EliminationEnd::interrupted, 0, 0};
        }
        return {EliminationEnd::done, 0, 0};
    }

private:
    Echelon& form_;
    Watch& watch_;
    std::vector<Row> rows_;                             // those that are left; the others are empty
    std::vector<std::vector<std::size_t>> in_column_;   // rows that have or had an entry there
    std::vector<std::int64_t> count_;                   // of rows that have one
    std::int64_t met_ = 0;                              // columns with entries
    std::size_t active_ = 0, entries_ = 0;
    using Length = std::pair<std::size_t, std::size_t>;
    std::priority_queue<Length, std::vector<Length>, std::greater<>> shortest_;
    Row sum_;

    void meet(std::int64_t column, std::size_t row) {
        in_column_[column].push_back(row);
        if (count_[column]++ == 0) ++met_;
    }
    void leave(std::int64_t column) {
        if (--count_[column] == 0) --met_;
    }

    // Takes a row with its rarest column as the pivot, and eliminates this column from all others.
    bool take(std::size_t i) {
        Row row = std::move(rows_[i]);
        rows_[i].clear();
        --active_;
        entries_ -= row.size();
        for (const Entry& entry : row) leave(entry.column);
        auto rarest = row.begin();
        for (auto entry = row.begin(); entry != row.end(); ++entry)
            if (count_[entry->column] < count_[rarest->column]) rarest = entry;
        const std::int64_t pivot = rarest->column;
        const Residue scale = inverse(rarest->value);
        row.erase(rarest);
        form_.pivot.push_back(pivot);
        for (Entry& entry : row) {
            entry.value = times(entry.value, scale);
            form_.column.push_back(entry.column);
            form_.value.push_back(entry.value);
        }
        form_.start.push_back(static_cast<std::int64_t>(form_.column.size()));
        const std::vector<std::size_t> candidates = std::move(in_column_[pivot]);
        in_column_[pivot].clear();
        for (const std::size_t k : candidates) {
            Row& target = rows_[k];
            const auto at = std::lower_bound(target.begin(), target.end(), pivot, before);
            if (at == target.end() || at->column != pivot) continue;
            if (!spend(watch_, work_of_an_entry * static_cast<std::int64_t>(target.size() + row.size()))) return false;
            const std::size_t length = target.size();
            subtract(target, k, at->value, pivot, row);
            entries_ = entries_ - length + target.size();
            if (target.empty())
                --active_;
            else if (target.size() != length)
                shortest_.emplace(target.size(), k);
        }
        return true;
    }

    // Takes a multiple of a row, and the pivot column, away from row k.
    void subtract(Row& target, std::size_t k, Residue factor, std::int64_t pivot, const Row& row) {
        const Residue less = negative(factor);
        sum_.clear();
        auto one = target.begin();
        auto other = row.begin();
        while (one != target.end() || other != row.end()) {
            if (one != target.end() && one->column == pivot) {
                leave(pivot);
                ++one;
            } else if (other == row.end() || (one != target.end() && one->column < other->column)) {
                sum_.push_back(*one++);
            } else if (one == target.end() || other->column < one->column) {
                sum_.push_back({other->column, times(less, other->value)});
                meet(other->column, k);
                ++other;
            } else {
                const Residue v = reduced(one->value + Wide{less} * other->value);
                if (v != 0)
                    sum_.push_back({one->column, v});
                else
                    leave(one->column);
                ++one;
                ++other;
            }
        }
        target.assign(sum_.begin(), sum_.end());
    }

    // The rest as a dense matrix, column by column; false if the watch ends the work.
    bool eliminate_core() {
        std::vector<std::int64_t> columns;
        for (std::size_t c = 0; c < count_.size(); ++c)
            if (count_[c] > 0) columns.push_back(static_cast<std::int64_t>(c));
        const auto width = static_cast<std::int64_t>(columns.size());
        std::vector<Residue> matrix(active_ * columns.size());
        std::vector<Residue*> row;
        for (const Row& sparse : rows_) {
            if (sparse.empty()) continue;
            row.push_back(matrix.data() + row.size() * columns.size());
            for (const Entry& entry : sparse) {
                const auto at = std::lower_bound(columns.begin(), columns.end(), entry.column) - columns.begin();
                row.back()[at] = entry.value;
            }
        }
        std::size_t top = 0;
        for (std::int64_t k = 0; k < width && top < row.size(); ++k) {
            std::size_t first = top;
            while (first < row.size() && row[first][k] == 0) ++first;
            if (first == row.size()) continue;
            std::swap(row[top], row[first]);
            const Residue scale = inverse(row[top][k]);
            form_.pivot.push_back(columns[k]);
            for (std::int64_t c = k + 1; c < width; ++c) {
                row[top][c] = times(row[top][c], scale);
                if (row[top][c] == 0) continue;
                form_.column.push_back(columns[c]);
                form_.value.push_back(row[top][c]);
            }
            form_.start.push_back(static_cast<std::int64_t>(form_.column.size()));
            for (std::size_t i = top + 1; i < row.size(); ++i) {
                if (!spend(watch_, width - k)) return false;
                if (row[i][k] != 0) add(row[i], row[top], negative(row[i][k]), k + 1, width);
            }
            ++top;
        }
        return true;
    }
};

}  // namespace

EliminationOutcome eliminate(const SparseRows& matrix, const MostWork& most, Echelon& form, Watch& watch) {
    return Eliminator(matrix, form, watch).run(most);
}

bool solve_back(const Echelon& form, std::int64_t width, std::int64_t* solutions, Watch& watch) {
    for (std::size_t k = form.pivot.size(); k-- > 0;) {
        std::int64_t* solution = solutions + form.pivot[k] * width;
        std::fill(solution, solution + width, 0);
        for (std::int64_t e = form.start[k]; e < form.start[k + 1]; ++e) {
            if (!spend(watch, width)) return false;
            add(solution, solutions + form.column[e] * width, negative(residue(form.value[e])), 0, width);
        }
    }
    return true;
}

bool reduce(std::int64_t rows, std::int64_t columns, std::int64_t* matrix, std::int64_t& rank, Watch& watch) {
    rank = 0;
    for (std::int64_t k = 0; k < columns && rank < rows; ++k) {
        const auto row = [matrix, columns](std::int64_t i) { return matrix + i * columns; };
        std::int64_t first = rank;
        while (first < rows && row(first)[k] == 0) ++first;
        if (!spend(watch, rows)) return false;
        if (first == rows) continue;
        std::int64_t* top = row(rank);
        if (first != rank) std::swap_ranges(top, top + columns, row(first));
        const Residue scale = inverse(static_cast<Residue>(top[k]));
        for (std::int64_t c = k; c < columns; ++c) top[c] = times(static_cast<Residue>(top[c]), scale);
        for (std::int64_t i = 0; i < rows; ++i) {
            if (i == rank || row(i)[k] == 0) continue;
            if (!spend(watch, columns - k)) return false;
            add(row(i), top, negative(static_cast<Residue>(row(i)[k])), k, columns);
        }
        ++rank;
    }
    return true;
}

}  // namespace gruebler::algebra
