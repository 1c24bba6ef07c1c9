#include "space/following.hpp"

#include <cmath>
#include <limits>

namespace gruebler::space {
namespace {

constexpr double closed = 1e-12;       // extents and radians: joints that are open by less are closed
constexpr double settled_at = 1e-14;   // one turn more would only change by rounding
constexpr double independent = 1e-7;   // of the largest pivot: below it the rank has changed; lengths in extents
constexpr double largest_step = 0.1;   // radians and sizes, of a drive
constexpr double smallest_step = 1e-6; // of the largest: a step that is halved so often has met something
constexpr double narrow = 1e-4;        // radians and sizes: no longer are steps over which a determinant turns over
constexpr int most_turns = 8;          // of Newton's method in a step
constexpr double apart = 0.2;          // of the step: a larger correction may lead to another assembly mode
constexpr double far = 0.5;            // radians: turns of balls are counted anew, far from a Cardan angle of 90 degrees
constexpr std::int64_t work_of_a_step = 3000;  // nanoseconds

double larger(double a, double b) { return b > a ? b : a; }

double size(double x) {  // infinite if it is no number
    const double own = std::fabs(x);
    return own <= std::numeric_limits<double>::max() ? own : std::numeric_limits<double>::infinity();
}

double largest(const std::vector<double>& numbers) {
    double most = 0;
    for (const double x : numbers) most = larger(most, size(x));
    return most;
}

Screw<double> operator+(const Screw<double>& a, const Screw<double>& b) { return {a.turn + b.turn, a.shift + b.shift}; }
Screw<double> operator*(double k, const Screw<double>& a) { return {k * a.turn, k * a.shift}; }
// How a screw changes that is carried by a twist.
Screw<double> bracket(const Screw<double>& twist, const Screw<double>& a) {
    return {cross(twist.turn, a.turn), cross(twist.turn, a.shift) + cross(twist.shift, a.turn)};
}

}  // namespace

// --- conditions --------------------------------------------------------------------------------------------------------

Conditions::Conditions(const Linkage& linkage)
    : Tree(linkage.structure, linkage.pitches), linkage_(linkage), nodes_of_rows_(0), between_(parts_between(structure)) {
    const auto conditions = static_cast<std::size_t>(linkage.conditions());
    values.resize(conditions), derivatives.resize(conditions * static_cast<std::size_t>(structure.unknowns));
    for (std::size_t ball = 0; ball < turns.size(); ball += turn_size) turns[ball] = turns[ball + 4] = turns[ball + 8] = 1;
    std::vector<int> columns(static_cast<std::size_t>(structure.nodes));
    for (int row = 0; row < structure.rows; ++row) {
        const std::int64_t* ask = structure.row_at(row);
        const RowKind kind = static_cast<RowKind>(ask[0]);
        const int origin = kind == RowKind::across ? 0 : 8;
        columns[static_cast<std::size_t>(ask[1])] |= origin | (kind == RowKind::length ? 0 : 1 << ask[3]);
        columns[static_cast<std::size_t>(ask[2])] |= origin | (kind == RowKind::across ? 1 << ask[4] : 0);
    }
    for (int k = 0; k < structure.nodes; ++k) {
        const std::int64_t* own = structure.node_at(k);
        const auto at = static_cast<std::size_t>(k);
        if (columns[at]) marks_.push_back({k, columns[at]});
        if (columns[at] || own[4] >= 0) nodes_of_rows_ = k + 1;
        if (static_cast<Kind>(own[1]) != Kind::still) continue;
        still[at] = read_frame(linkage.frames + k * frame_size);
        if (own[0] >= 0 && !settled[static_cast<std::size_t>(own[0])]) continue;
        move(nullptr, k, k + 1);
        settled[at] = 1;
    }
}

void Conditions::evaluate(const double* q) {
    move(q, 0, nodes_of_rows_);
    const auto unknowns = static_cast<std::size_t>(structure.unknowns);
    for (int row = 0; row < structure.rows; ++row) {
        const std::int64_t* ask = structure.row_at(row);
        const double length = linkage_.lengths[row];
        const Opening<double> own =
            opening(ask, frame(static_cast<int>(ask[1])), frame(static_cast<int>(ask[2])), length);
        const double scale = static_cast<RowKind>(ask[0]) == RowKind::length ? 1 / length : 1;
        values[static_cast<std::size_t>(row)] = scale * own.value;
        double* derivative = derivatives.data() + static_cast<std::size_t>(row) * unknowns;
        for (std::size_t i = 0; i < unknowns; ++i) derivative[i] = 0;
        for (const Part& part : between_[static_cast<std::size_t>(row)]) {
            const std::int64_t unknown = structure.node_at(part.node)[4];
            if (unknown >= 0) derivative[unknown] = scale * part.sign * work_of(own.wrench, screw(part.node));
        }
    }
    for (int row = 0; row < linkage_.gear_rows; ++row) {
        const auto at = static_cast<std::size_t>(structure.rows + row);
        double sum = 0;
        for (std::size_t i = 0; i < unknowns; ++i) {
            const double weight = linkage_.gears[static_cast<std::size_t>(row) * unknowns + i];
            sum += weight * q[i];
            derivatives[at * unknowns + i] = weight;
        }
        values[at] = sum;
    }
}

// --- rates -------------------------------------------------------------------------------------------------------------

Series::Series(const Conditions& conditions) : conditions_(conditions) {
    const Structure& structure = conditions.structure;
    const auto nodes = static_cast<std::size_t>(structure.nodes);
    q.resize(static_cast<std::size_t>((most_orders + 1) * structure.unknowns));
    carrier_.resize(nodes);
    for (int k = 0; k < structure.nodes; ++k) {
        const std::int64_t* own = structure.node_at(k);
        const bool moves = own[4] >= 0;
        if (moves) moving_.push_back(k);
        carrier_[static_cast<std::size_t>(k)] = moves ? k : own[0] >= 0 ? carrier_[static_cast<std::size_t>(own[0])] : -1;
    }
    for (int k = 0; k < most_orders; ++k) twists_[k].resize(nodes), screws_[k].resize(nodes), frames_[k].resize(nodes);
    open_.resize(static_cast<std::size_t>(conditions.linkage().conditions()));
    change_.resize(static_cast<std::size_t>(structure.unknowns));
}

const Screw<double>& Series::screw(int node, int order) const {
    return order ? screws_[order][static_cast<std::size_t>(node)] : conditions_.screw(node);
}

const Frame<double>& Series::frame(int node, int order) const {
    return order ? frames_[order - 1][static_cast<std::size_t>(node)] : conditions_.frame(node);
}

// The coefficient of t^(order - 1) of the twists, from those of the unknowns up to t^order.
void Series::set_twists(int order) {
    const Structure& structure = conditions_.structure;
    for (const int node : moving_) {
        const std::int64_t* own = structure.node_at(node);
        const int parent = carrier_[static_cast<std::size_t>(own[0])];
        Screw<double> sum{};
        if (parent >= 0) sum = twists_[order - 1][static_cast<std::size_t>(parent)];
        for (int i = 0; i < order; ++i)
            sum = sum + (order - i) * q[static_cast<std::size_t>((order - i) * structure.unknowns + own[4])] * screw(node, i);
        twists_[order - 1][static_cast<std::size_t>(node)] = sum;
    }
}

void Series::turn_screws(int order) {
    for (const int node : moving_) {
        Screw<double> sum{};
        for (int i = 0; i < order; ++i)
            sum = sum + bracket(twists_[i][static_cast<std::size_t>(node)], screw(node, order - 1 - i));
        screws_[order][static_cast<std::size_t>(node)] = 1.0 / order * sum;
    }
}

void Series::set_frame(int node, int order, int columns) {
    Frame<double>& f = frames_[order - 1][static_cast<std::size_t>(node)];
    const int carrier = carrier_[static_cast<std::size_t>(node)];
    if (carrier < 0) {
        f = {};
        return;
    }
    const auto at = static_cast<std::size_t>(carrier);
    const double share = 1.0 / order;
    for (int k = 0; k < 3; ++k) {
        if (!(columns >> k & 1)) continue;
        Vector<double> sum{};
        for (int i = 0; i < order; ++i) sum = sum + cross(twists_[i][at].turn, frame(node, order - 1 - i).axis(k));
        for (int i = 0; i < 3; ++i) f.r[3 * i + k] = share * sum.x[i];
    }
    if (!(columns & 8)) return;
    Vector<double> sum = twists_[order - 1][at].shift;
    for (int i = 0; i < order; ++i) sum = sum + cross(twists_[i][at].turn, frame(node, order - 1 - i).origin());
    for (int i = 0; i < 3; ++i) f.p[i] = share * sum.x[i];
}

// The coefficient of t^order of a row.
double Series::open(int row, int order) const {
    const std::int64_t* ask = conditions_.structure.row_at(row);
    const int first = static_cast<int>(ask[1]), second = static_cast<int>(ask[2]);
    const int axis = static_cast<int>(ask[3]), other = static_cast<int>(ask[4]);
    const auto gap = [&](int k) { return frame(second, k).origin() - frame(first, k).origin(); };
    double sum = 0;
    for (int i = 0; i <= order; ++i) switch (static_cast<RowKind>(ask[0])) {
            case RowKind::across: sum += dot(frame(first, i).axis(axis), frame(second, order - i).axis(other)); break;
            case RowKind::offset: sum += dot(frame(first, i).axis(axis), gap(order - i)); break;
            case RowKind::length: sum += dot(gap(i), gap(order - i)) / (2 * conditions_.linkage().lengths[row]); break;
        }
    return sum;
}

// The coefficient of a row is J q_k and what lower orders leave: of the first order nothing.
void Series::solve(int orders, const std::vector<int>& passive, const LeastSquares& matrix) {
    const auto unknowns = static_cast<std::size_t>(conditions_.structure.unknowns);
    for (int order = 1; order <= orders; ++order) {
        double* own = q.data() + static_cast<std::size_t>(order) * unknowns;
        for (const int k : passive) own[k] = 0;
        for (double& each : open_) each = 0;
        if (order > 1) {
            set_twists(order);
            set_marks(order);
            for (int row = 0; row < conditions_.structure.rows; ++row) open_[static_cast<std::size_t>(row)] = open(row, order);
        }
        for (std::size_t row = order > 1 ? static_cast<std::size_t>(conditions_.structure.rows) : 0; row < open_.size(); ++row)
            for (std::size_t k = 0; k < unknowns; ++k) open_[row] += conditions_.derivatives[row * unknowns + k] * own[k];
        matrix.solve(open_.data(), change_.data());
        for (std::size_t i = 0; i < passive.size(); ++i) own[passive[i]] = -change_[i];
        set_twists(order);
        if (order == orders) return;
        set_marks(order);
        turn_screws(order);
    }
}

void Series::set_marks(int order) {
    for (const Mark& mark : conditions_.marks()) set_frame(mark.node, order, mark.columns);
}

// --- following ---------------------------------------------------------------------------------------------------------

namespace {

class Follower {
public:
    Follower(const Linkage& linkage, const Path& path)
        : path_(path),
          conditions_(linkage),
          series_(conditions_),
          here_(linkage.conditions(), path.passives),
          there_(linkage.conditions(), path.passives),
          q_(path.start, path.start + linkage.structure.unknowns),
          guess_(q_),
          predicted_(q_),
          begin_(static_cast<std::size_t>(path.drives)),
          change_(static_cast<std::size_t>(path.passives)),
          passive_(path.passive, path.passive + path.passives),
          placed_(static_cast<std::size_t>(path.links * terms)),
          is_length_(conditions_.values.size()),
          is_shift_(q_.size()) {
        const Structure& structure = linkage.structure;
        conditions_.turns.assign(path.turns, path.turns + structure.balls * turn_size);
        for (int row = 0; row < structure.rows; ++row)
            is_length_[static_cast<std::size_t>(row)] = static_cast<RowKind>(structure.row_at(row)[0]) != RowKind::across;
        for (int k = 0; k < structure.nodes; ++k) {
            const std::int64_t* own = structure.node_at(k);
            if (own[4] < 0 || static_cast<Kind>(own[1]) != Kind::shifts) continue;
            is_shift_[static_cast<std::size_t>(own[4])] = true, shifts_.push_back(static_cast<int>(own[4]));
        }
    }

    bool follow(Followed& followed, Watch& watch) {
        conditions_.evaluate(q_.data());
        bool sound = factor(here_, extent(q_));
        for (std::int64_t row = 0; row < path_.rows; ++row) {
            bool passes = false;
            double part = 0;
            if (sound && !go_to(path_.values + row * path_.drives, part, passes, watch)) return false;
            path_.passed[row] = passes;
            followed.part = part;
            if (part < 1) break;
            followed.gap = larger(followed.gap, largest(conditions_.values));
            write(row);
            followed.rows = row + 1;
        }
        followed.place = q_, followed.turns = conditions_.turns;
        return true;
    }

private:
    Path path_;
    Conditions conditions_;
    Series series_;
    LeastSquares here_, there_;  // where the path is, where the step leads
    std::vector<double> q_, guess_, predicted_, begin_, change_;
    std::vector<int> passive_;
    static constexpr int terms = most_orders + 1;
    std::vector<Frame<double>> placed_;       // [links, terms]
    std::vector<char> is_length_, is_shift_;  // of rows, of unknowns
    std::vector<int> shifts_;                 // unknowns

    // The extent of a position: its longest shift, at least a size; a power of 2, so that to scale by it does not round.
    double extent(const std::vector<double>& q) const {
        double most = 1;
        for (const int k : shifts_) most = larger(most, std::fabs(q[static_cast<std::size_t>(k)]));
        int power = 0;
        const double part = std::frexp(most, &power);
        return std::ldexp(1.0, part > 0.5 ? power : power - 1);
    }

    // By how much the position that was evaluated last is open, lengths in extents.
    double gap(double extent) const {
        double most = 0;
        for (std::size_t row = 0; row < conditions_.values.size(); ++row)
            most = larger(most, size(conditions_.values[row]) / (is_length_[row] ? extent : 1));
        return most;
    }

    // Of the position that was evaluated last; false if the rank is not full.
    bool factor(LeastSquares& matrix, double extent) {
        const auto unknowns = static_cast<std::size_t>(conditions_.structure.unknowns);
        for (std::size_t row = 0; row < is_length_.size(); ++row) matrix.row_units()[row] = is_length_[row] ? extent : 1;
        for (std::size_t k = 0; k < passive_.size(); ++k) {
            double* column = matrix.column(static_cast<int>(k));
            matrix.column_units()[k] = is_shift_[static_cast<std::size_t>(passive_[k])] ? extent : 1;
            for (std::size_t row = 0; row < conditions_.values.size(); ++row)
                column[row] = conditions_.derivatives[row * unknowns + static_cast<std::size_t>(passive_[k])];
        }
        return matrix.factor(independent);
    }

    // Closes `guess_` by Newton's method. A stationary point is not a closed position: only the residual counts.
    bool close() {
        double last = std::numeric_limits<double>::infinity();
        for (int turn = 0; turn < most_turns; ++turn) {
            conditions_.evaluate(guess_.data());
            const double unit = extent(guess_), open = gap(unit);
            if (!(open <= std::numeric_limits<double>::max()) || !factor(there_, unit)) return false;
            if (open < settled_at || (open < closed && open > last / 4)) return true;
            last = open;
            there_.solve(conditions_.values.data(), change_.data());
            for (std::size_t k = 0; k < passive_.size(); ++k) guess_[static_cast<std::size_t>(passive_[k])] -= change_[k];
        }
        return false;
    }

    // Predicts `guess_` and closes it, with the drives at the target if there is one; false if that leads elsewhere.
    bool step(double length, const double* target) {
        const auto unknowns = static_cast<std::size_t>(conditions_.structure.unknowns);
        double moved = 0, bent = 0;
        for (std::size_t k = 0; k < unknowns; ++k) {
            const double* own = series_.q.data() + k;
            const double along = length * own[unknowns];
            const double aside = length * length * (own[2 * unknowns] + length * own[3 * unknowns]);
            guess_[k] = q_[k] + along + aside;
            moved = larger(moved, std::fabs(along)), bent = larger(bent, std::fabs(aside));
        }
        if (bent > moved) return false;  // beyond where the series holds any closed position may be the nearest
        for (std::size_t k = 0; target && k < begin_.size(); ++k) guess_[static_cast<std::size_t>(path_.drive[k])] = target[k];
        predicted_ = guess_;
        if (!close()) return false;
        double correction = 0;
        for (std::size_t k = 0; k < unknowns; ++k) correction = larger(correction, std::fabs(guess_[k] - predicted_[k]));
        return correction <= apart * moved + closed;
    }

    // Towards drive values, as far as it goes: what part of the way; whether that passes a change of mode.
    bool go_to(const double* target, double& at, bool& passes, Watch& watch) {
        const auto unknowns = static_cast<std::size_t>(conditions_.structure.unknowns);
        double way = 0;
        for (std::size_t k = 0; k < begin_.size(); ++k) {
            begin_[k] = q_[static_cast<std::size_t>(path_.drive[k])];
            way = larger(way, std::fabs(target[k] - begin_[k]));
        }
        if (!(way <= longest_way)) return at = 0, true;
        const double most = way <= largest_step ? 1 : largest_step / way;
        double length = most;
        at = 0;
        while (at < 1) {
            for (double& each : series_.q) each = 0;
            for (std::size_t k = 0; k < begin_.size(); ++k)
                series_.q[unknowns + static_cast<std::size_t>(path_.drive[k])] = target[k] - begin_[k];
            series_.solve(most_orders, passive_, here_);
            bool is_last, turned;
            while (true) {
                if (!spend(watch, work_of_a_step)) return false;
                is_last = length >= 1 - at;
                if (is_last) length = 1 - at;
                if (step(length, is_last ? target : nullptr)) {
                    turned = here_.turns_over(there_);  // at a change of mode, over a gap, or to a mode beside its own
                    if (!turned || length * way <= narrow) break;
                }
                length /= 2;
                if (length < smallest_step * most) return true;
            }
            at = is_last ? 1 : at + length;
            passes ^= turned;
            q_.swap(guess_);
            std::swap(here_, there_);
            if (count_anew()) {
                conditions_.evaluate(q_.data());
                if (!factor(here_, extent(q_))) return true;
            }
            length = length * 2 < most ? length * 2 : most;
        }
        return true;
    }

    // Counts turns of balls from here where they have grown.
    bool count_anew() {
        bool any = false;
        for (int k = 0; k < conditions_.structure.nodes; ++k) {
            const std::int64_t* own = conditions_.structure.node_at(k);
            if (own[5] < 0) continue;
            double* angles = q_.data() + own[4];
            if (!(std::fabs(angles[0]) > far || std::fabs(angles[1]) > far || std::fabs(angles[2]) > far)) continue;
            conditions_.count_from(k, angles);
            for (int i = 0; i < 3; ++i) angles[i] = 0;
            any = true;
        }
        return any;
    }

    void write(std::int64_t row) {
        const auto unknowns = static_cast<std::size_t>(conditions_.structure.unknowns), conditions = conditions_.values.size();
        const auto passives = passive_.size();
        for (double& each : series_.q) each = 0;
        for (int order = 1; order <= path_.orders; ++order)
            for (int k = 0; k < path_.drives; ++k)
                series_.q[static_cast<std::size_t>(order) * unknowns + static_cast<std::size_t>(path_.drive[k])] =
                    path_.rates[((order - 1) * path_.rows + row) * path_.drives + k];
        for (std::size_t k = 0; k < unknowns; ++k) series_.q[k] = q_[k];
        series_.solve(path_.orders, passive_, here_);
        double* derivatives = path_.derivatives + static_cast<std::size_t>(row) * conditions * passives;
        for (std::size_t i = 0; i < conditions; ++i)
            for (std::size_t k = 0; k < passives; ++k)
                derivatives[i * passives + k] = conditions_.derivatives[i * unknowns + static_cast<std::size_t>(passive_[k])];
        conditions_.move(q_.data(), conditions_.nodes_of_rows(), conditions_.structure.nodes);
        for (int order = 0; order <= path_.orders; ++order) {
            double* values = path_.unknowns + (order * path_.rows + row) * conditions_.structure.unknowns;
            for (std::size_t k = 0; k < unknowns; ++k) values[k] = series_.q[static_cast<std::size_t>(order) * unknowns + k];
            for (int link = 0; link < path_.links; ++link) {
                if (path_.link[link] < 0) continue;
                const int node = static_cast<int>(path_.link[link]);
                if (order) series_.set_frame(node, order);
                placed(link)[order] = series_.frame(node, order);
            }
        }
        for (int k = 0; k < path_.rods; ++k) {
            const std::int64_t* own = path_.rod + k * rod_fields;
            place_rod(path_.balls + k * rod_vectors * 3, placed(own[1]), placed(own[2]), placed(own[0]), path_.orders);
        }
        for (int link = 0; link < path_.links; ++link) write_poses(row, link);
    }

    Frame<double>* placed(std::int64_t link) { return placed_.data() + link * terms; }

    void write_poses(std::int64_t row, int link) {
        const double scale = path_.unit[0], *centre = path_.unit + 1;
        double factorial = 1;
        for (int order = 0; order <= path_.orders; ++order) {
            const Frame<double>& f = placed(link)[order];
            const Vector<double> arm = f.turned({{centre[0], centre[1], centre[2]}});
            factorial *= order ? order : 1;
            double* pose = path_.poses + ((order * path_.rows + row) * path_.links + link) * frame_size;
            for (int i = 0; i < 3; ++i) {
                for (int j = 0; j < 3; ++j) pose[4 * i + j] = factorial * f.r[3 * i + j];
                pose[4 * i + 3] = factorial * (scale * f.p[i] - arm.x[i] + (order ? 0 : centre[i]));
            }
            pose[15] = order == 0;
        }
    }
};

}  // namespace

bool follow(const Linkage& linkage, const Path& path, Followed& followed, Watch& watch) {
    return Follower(linkage, path).follow(followed, watch);
}

}  // namespace gruebler::space
