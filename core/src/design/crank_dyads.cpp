#include "design/crank_dyads.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motion/circle.hpp"

namespace gruebler::design {
namespace {

using namespace motion;

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t ends = 2;  // the largest and the least cosine

Complex quotient(Complex a, Complex b) { return a * inverse(b, dot(b, b)); }

// One linkage at some crank angles: all its planes, and the cosines of its dyads.
class Moved {
public:
    explicit Moved(const Linkages& all)
        : all_(all), planes_(4 * all.link_count * all.angles), cosines_(all.dyad_count * all.angles) {}

    void place(std::int64_t number) {
        number_ = number;
        turn_crank();
        for (std::int64_t d = 0; d < all_.dyad_count; ++d) {
            const CrankDyad& dyad = all_.dyads[d];
            switch (dyad.form) {
                case Form::rrr: all_.lanes.place_rrr(at(dyad, d)); break;
                case Form::rrp: place_rrp(dyad, d); break;
                case Form::rpr: place_rpr(dyad, d); break;
                case Form::prp: place_prp(dyad, d); break;
                case Form::rpp: place_rpp(dyad, d); break;
            }
        }
    }

    Complex turn(std::int64_t link, std::int64_t angle) const {
        const double* own = planes_.data() + 4 * link * all_.angles;
        return {own[angle], own[all_.angles + angle]};
    }
    Complex shift(std::int64_t link, std::int64_t angle) const {
        const double* own = planes_.data() + (4 * link + 2) * all_.angles;
        return {own[angle], own[all_.angles + angle]};
    }
    const double* cosines(std::int64_t dyad) const { return cosines_.data() + dyad * all_.angles; }
    const double* angles() const { return all_.turned + number_ * all_.angles; }
    Complex point(std::int64_t element) const { return all_.points[number_ * all_.element_count + element]; }

    bool assembled(std::int64_t angle) const {
        bool good = true;
        for (std::int64_t link = 0; link < all_.link_count; ++link) good &= std::isfinite(turn(link, angle).x);
        return good;
    }

private:
    Complex line(std::int64_t element) const { return all_.lines[number_ * all_.element_count + element]; }
    double side(std::int64_t dyad) const { return all_.sides[dyad * all_.count + number_]; }
    PlaneRows plane(std::int64_t link) {
        double* own = planes_.data() + 4 * link * all_.angles;
        return {own, own + all_.angles, own + 2 * all_.angles, own + 3 * all_.angles};
    }

    void turn_crank() {
        const PlaneRows frame = plane(all_.crank.frame);
        std::fill_n(frame.turn_x, all_.angles, 1.0);
        std::fill_n(frame.turn_y, 3 * all_.angles, 0.0);
        all_.lanes.turn_crank(angles(), point(all_.crank.on_frame), point(all_.crank.on_link), plane(all_.crank.link),
                              all_.angles);
    }

    // Arrays of one dyad at hand, so that loops over angles need no table.
    struct At : RrrRows {
        Complex turned(int k, std::int64_t i) const { return {bases[k].turn_x[i], bases[k].turn_y[i]}; }
        Complex outer(int k, std::int64_t i) const {
            return turned(k, i) * on_base[k] + Complex{bases[k].shift_x[i], bases[k].shift_y[i]};
        }
        // Link k turned so that its outer joint lies at an end.
        void hang(int k, std::int64_t i, Complex turn, Complex end) const {
            const Complex shift = end - turn * on_link[k];
            links[k].turn_x[i] = turn.x, links[k].turn_y[i] = turn.y;
            links[k].shift_x[i] = shift.x, links[k].shift_y[i] = shift.y;
        }
    };

    At at(const CrankDyad& dyad, std::int64_t number) {
        At each{};
        for (int k = 0; k < 2; ++k) {
            each.bases[k] = plane(dyad.bases[k]);
            each.links[k] = plane(dyad.links[k]);
            each.on_base[k] = point(dyad.on_base[k]);
            each.on_link[k] = point(dyad.on_link[k]);
            each.inner[k] = point(dyad.inner[k]);
        }
        each.cosine = cosines_.data() + number * all_.angles;
        each.side = side(number);
        each.angles = all_.angles;
        return each;
    }

    // The second link slides along a line of its base; the side is that of the inner joint seen along this line.
    void place_rrp(const CrankDyad& dyad, std::int64_t number) {
        const At e = at(dyad, number);
        const Complex along_base = line(dyad.on_base[1]), own = conjugate(line(dyad.on_link[1]));
        const Complex first = e.inner[0] - e.on_link[0], second = e.inner[1] - e.on_link[1];
        const double r = dot(first, first), length = std::sqrt(r);
        for (std::int64_t i = 0; i < all_.angles; ++i) {
            const Complex end = e.outer(0, i), guide = e.turned(1, i) * along_base, turn = guide * own;
            const Complex reach = e.outer(1, i) + turn * second - end;
            const double beside = cross(guide, reach);
            const double travel = e.side * std::sqrt(r - beside * beside) - dot(guide, reach);
            e.hang(0, i, (reach + travel * guide) * inverse(first, r), end);
            e.hang(1, i, turn, e.outer(1, i) + travel * guide);
            e.cosine[i] = beside / length;
        }
    }

    // Both links slide along each other; the side is that of the second outer joint seen from the first along the slide.
    void place_rpr(const CrankDyad& dyad, std::int64_t number) {
        const At e = at(dyad, number);
        const Complex own = conjugate(line(dyad.inner[0])), other = conjugate(line(dyad.inner[1]));
        const double beside = (other * (e.on_link[1] - e.inner[1])).y - (own * (e.on_link[0] - e.inner[0])).y;
        for (std::int64_t i = 0; i < all_.angles; ++i) {
            const Complex end = e.outer(0, i), far = e.outer(1, i), gap = far - end;
            const double square = dot(gap, gap);
            const Complex slide = quotient(gap, {e.side * std::sqrt(square - beside * beside), beside});
            e.hang(0, i, slide * own, end);
            e.hang(1, i, slide * other, far);
            e.cosine[i] = beside / std::sqrt((square + beside * beside) / 2);
        }
    }

    // Each link slides along its base; the side is the sign of the sine from the first line to the second.
    void place_prp(const CrankDyad& dyad, std::int64_t number) {
        const At e = at(dyad, number);
        const Complex lines[2] = {line(dyad.on_base[0]), line(dyad.on_base[1])};
        const Complex own[2] = {conjugate(line(dyad.on_link[0])), conjugate(line(dyad.on_link[1]))};
        for (std::int64_t i = 0; i < all_.angles; ++i) {
            Complex guide[2], turn[2], start[2];
            for (int k = 0; k < 2; ++k) {
                guide[k] = e.turned(k, i) * lines[k];
                turn[k] = guide[k] * own[k];
                start[k] = e.outer(k, i) + turn[k] * (e.inner[k] - e.on_link[k]);
            }
            const double sine = cross(guide[0], guide[1]);
            const Complex miss = start[1] - start[0];
            e.hang(0, i, turn[0], e.outer(0, i) + (cross(miss, guide[1]) / sine) * guide[0]);
            e.hang(1, i, turn[1], e.outer(1, i) + (cross(miss, guide[0]) / sine) * guide[1]);
            e.cosine[i] = 1 - e.side * sine;
        }
    }

    // The second link slides along its base, the first one along the second; the side as before, which never changes.
    void place_rpp(const CrankDyad& dyad, std::int64_t number) {
        const At e = at(dyad, number);
        const Complex along_base = line(dyad.on_base[1]), own = conjugate(line(dyad.on_link[1]));
        const Complex inner = line(dyad.inner[1]), first = conjugate(line(dyad.inner[0]));
        for (std::int64_t i = 0; i < all_.angles; ++i) {
            const Complex end = e.outer(0, i), guide = e.turned(1, i) * along_base, turn = guide * own;
            const Complex slide = turn * inner, other = slide * first;
            e.hang(0, i, other, end);
            const Complex miss =
                e.outer(1, i) + turn * (e.inner[1] - e.on_link[1]) - end - other * (e.inner[0] - e.on_link[0]);
            const double sine = cross(slide, guide);
            e.hang(1, i, turn, e.outer(1, i) - (cross(slide, miss) / sine) * guide);
            e.cosine[i] = 1 - e.side * sine;
        }
    }

    const Linkages& all_;
    std::int64_t number_ = 0;
    std::vector<double> planes_;   // [links, 4, angles] turns and shifts
    std::vector<double> cosines_;  // [dyads, angles]
};

// Work on each linkage in turn; about as many steps of a nanosecond for each dyad and angle.
template <class Work>
bool each(const Linkages& linkages, std::int64_t steps, Watch& watch, Work work) {
    Moved moved(linkages);
    for (std::int64_t n = 0; n < linkages.count; ++n) {
        moved.place(n);
        work(n, moved);
        if (!spend(watch, steps * (linkages.dyad_count + 1) * linkages.angles)) return false;
    }
    return true;
}

// Which of some numbers is largest, the first of equal ones, and none of them that is no number.
std::int64_t top_of(const double* values, std::int64_t count, double sign) {
    std::int64_t at = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (std::int64_t i = 0; i < count; ++i) {
        if (!(sign * values[i] > most)) continue;
        most = sign * values[i];
        at = i;
    }
    return at;
}

// By which part of a step the top of the parabola through three numbers lies beside the middle one.
double beside_top(const double* values, std::int64_t count, std::int64_t at) {
    const double before = values[(at + count - 1) % count], here = values[at], after = values[(at + 1) % count];
    const double part = (before - after) / (2 * (before - 2 * here + after));
    return std::isnan(part) ? 0.0 : part < -0.5 ? -0.5 : part > 0.5 ? 0.5 : part;
}

// Where the last element goes with a link; NaN where any dyad cannot be assembled.
void write_trace(const Linkages& linkages, std::int64_t link, const Moved& moved, Complex* z) {
    const Complex point = moved.point(linkages.element_count - 1);
    for (std::int64_t i = 0; i < linkages.angles; ++i) {
        z[i] = moved.turn(link, i) * point + moved.shift(link, i);
        if (!moved.assembled(i)) z[i] = {none, none};
    }
}

// How all planes change at one crank angle, of turning joints in one plane: first with x, y of each point, last with the crank.
class Slopes {
public:
    Slopes(const Linkages& all, bool by_places)
        : all_(all), places_(by_places ? 2 * all.element_count : 0), count_(places_ + 1),
          turns_(all.link_count * count_), shifts_(turns_.size()), rows_(ends * count_), along_(ends * count_) {}

    std::int64_t count() const { return count_; }
    const Complex* turns(std::int64_t link) const { return &turns_[link * count_]; }
    const Complex* shifts(std::int64_t link) const { return &shifts_[link * count_]; }

    // With dyads up to the one before the last.
    void differentiate(const Moved& moved, std::int64_t angle, std::int64_t last) {
        const Crank& crank = all_.crank;
        std::fill_n(&turns_[crank.frame * count_], count_, Complex{0, 0});
        std::fill_n(&shifts_[crank.frame * count_], count_, Complex{0, 0});
        Complex *turn = &turns_[crank.link * count_], *shift = &shifts_[crank.link * count_];
        std::fill_n(turn, count_, Complex{0, 0});
        std::fill_n(shift, count_, Complex{0, 0});
        const Complex spin = moved.turn(crank.link, angle), pivot = moved.point(crank.on_frame);
        turn[count_ - 1] = left(spin);
        shift[count_ - 1] = -left(spin * pivot);
        add(shift, crank.on_frame, Complex{1, 0} - spin);
        for (std::int64_t d = 0; d < last; ++d) follow(moved, angle, all_.dyads[d]);
    }

    // Of the place of an element in the plane of a link.
    void of_place(const Moved& moved, std::int64_t angle, std::int64_t link, std::int64_t element, Complex* slopes) const {
        const Complex place = moved.point(element);
        for (std::int64_t n = 0; n < count_; ++n)
            slopes[n] = turns_[link * count_ + n] * place + shifts_[link * count_ + n];
        add(slopes, element, moved.turn(link, angle));
    }

private:
    // What a number changes by its own place.
    void add(Complex* slopes, std::int64_t element, Complex factor) const {
        if (places_ == 0) return;
        slopes[2 * element] += factor;
        slopes[2 * element + 1] += left(factor);
    }

    // An inner joint moves by v with Re(conj(m) v) given for both of its links m: two linear equations.
    void follow(const Moved& moved, std::int64_t angle, const CrankDyad& dyad) {
        Complex arms[2], across[2];
        for (int k = 0; k < 2; ++k) {
            Complex* outer = &rows_[k * count_];
            double* along = &along_[k * count_];
            of_place(moved, angle, dyad.bases[k], dyad.on_base[k], outer);
            arms[k] = moved.point(dyad.inner[k]) - moved.point(dyad.on_link[k]);
            across[k] = moved.turn(dyad.links[k], angle) * arms[k];
            for (std::int64_t n = 0; n < count_; ++n) along[n] = dot(across[k], outer[n]);
            if (places_ == 0) continue;
            along[2 * dyad.inner[k]] += arms[k].x;
            along[2 * dyad.inner[k] + 1] += arms[k].y;
            along[2 * dyad.on_link[k]] -= arms[k].x;
            along[2 * dyad.on_link[k] + 1] -= arms[k].y;
        }
        const double by_sine = 1 / cross(across[0], across[1]);
        const Complex first = by_sine * left(across[0]), second = by_sine * left(across[1]);
        for (int k = 0; k < 2; ++k) {
            const std::int64_t link = dyad.links[k];
            Complex *turn = &turns_[link * count_], *shift = &shifts_[link * count_];
            const Complex* outer = &rows_[k * count_];
            const Complex by_arm = inverse(arms[k], dot(arms[k], arms[k]));
            for (std::int64_t n = 0; n < count_; ++n) {
                const Complex inner = along_[count_ + n] * first - along_[n] * second;
                turn[n] = (inner - outer[n]) * by_arm;
            }
            const Complex rotation = moved.turn(link, angle), outer_place = moved.point(dyad.on_link[k]);
            add(turn, dyad.inner[k], -(rotation * by_arm));
            add(turn, dyad.on_link[k], rotation * by_arm);
            for (std::int64_t n = 0; n < count_; ++n) shift[n] = outer[n] - turn[n] * outer_place;
            add(shift, dyad.on_link[k], -rotation);
        }
    }

    const Linkages& all_;
    std::int64_t places_, count_;
    std::vector<Complex> turns_, shifts_;  // [links, numbers]
    std::vector<Complex> rows_;            // [2, numbers] of the outer joints of a dyad
    std::vector<double> along_;
};

// How the cosine of a dyad changes with x, y of each point at one angle.
void differentiate_cosine(const CrankDyad& dyad, const Moved& moved, const Slopes& slopes, std::int64_t angle,
                          double own_cosine, std::vector<Complex>& rows, double* by_number) {
    const std::int64_t count = slopes.count();
    Complex outer[2], arms[2];
    double lengths[2];
    for (int k = 0; k < 2; ++k) {
        slopes.of_place(moved, angle, dyad.bases[k], dyad.on_base[k], &rows[k * count]);
        outer[k] = moved.turn(dyad.bases[k], angle) * moved.point(dyad.on_base[k]) + moved.shift(dyad.bases[k], angle);
        arms[k] = moved.point(dyad.inner[k]) - moved.point(dyad.on_link[k]);
        lengths[k] = std::sqrt(dot(arms[k], arms[k]));
    }
    const Complex gap = outer[1] - outer[0];
    const double product = lengths[0] * lengths[1];
    for (std::int64_t n = 0; n + 1 < count; ++n) by_number[n] = -dot(gap, rows[count + n] - rows[n]) / product;
    for (int k = 0; k < 2; ++k) {
        const double by_length = lengths[k] / product - own_cosine / lengths[k];
        const double by_x = by_length * arms[k].x / lengths[k], by_y = by_length * arms[k].y / lengths[k];
        by_number[2 * dyad.inner[k]] += by_x;
        by_number[2 * dyad.inner[k] + 1] += by_y;
        by_number[2 * dyad.on_link[k]] -= by_x;
        by_number[2 * dyad.on_link[k] + 1] -= by_y;
    }
}

}  // namespace

std::string fault(const Linkages& linkages) {
    const auto is_link = [&](std::int64_t n) { return 0 <= n && n < linkages.link_count; };
    const auto is_element = [&](std::int64_t n) { return 0 <= n && n < linkages.element_count; };
    const Crank& crank = linkages.crank;
    if (!is_link(crank.frame) || !is_link(crank.link) || crank.frame == crank.link) return "the crank is no link";
    if (!is_element(crank.on_frame) || !is_element(crank.on_link)) return "the crank turns about an element that is none";
    std::vector<bool> placed(linkages.link_count, false);
    placed[crank.frame] = placed[crank.link] = true;
    for (std::int64_t d = 0; d < linkages.dyad_count; ++d) {
        const CrankDyad& dyad = linkages.dyads[d];
        const auto form = static_cast<std::int64_t>(dyad.form);
        if (form < 0 || form > static_cast<std::int64_t>(Form::rpp)) return "a dyad has a form that is none";
        if (form > 0 && linkages.lines == nullptr && linkages.count > 0) return "a sliding joint needs its line";
        for (int k = 0; k < 2; ++k) {
            if (!is_link(dyad.bases[k]) || !placed[dyad.bases[k]]) return "a dyad hangs on a link that is not placed";
            if (!is_element(dyad.on_base[k]) || !is_element(dyad.on_link[k]) || !is_element(dyad.inner[k]))
                return "a dyad has an element that is none";
        }
        for (int k = 0; k < 2; ++k) {
            if (!is_link(dyad.links[k]) || placed[dyad.links[k]]) return "a dyad places a link that is none or is placed";
            placed[dyad.links[k]] = true;
        }
    }
    for (const bool each : placed)
        if (!each) return "a link is not placed";
    return "";
}

bool move_planes(const Linkages& linkages, Complex* turns, Complex* shifts, Watch& watch) {
    return each(linkages, 20, watch, [&](std::int64_t n, const Moved& moved) {
        for (std::int64_t link = 0; link < linkages.link_count; ++link) {
            const std::int64_t row = (link * linkages.count + n) * linkages.angles;
            for (std::int64_t i = 0; i < linkages.angles; ++i)
                turns[row + i] = moved.turn(link, i), shifts[row + i] = moved.shift(link, i);
        }
    });
}

bool find_tops(const Linkages& linkages, const std::vector<std::int64_t>& watched, bool between, double* tops,
               Watch& watch) {
    return each(linkages, 25, watch, [&](std::int64_t n, const Moved& moved) {
        const double* angles = moved.angles();
        for (const std::int64_t dyad : watched) {
            const double* cosines = moved.cosines(dyad);
            for (const double sign : {1.0, -1.0}) {
                const std::int64_t at = top_of(cosines, linkages.angles, sign);
                *tops = angles[at];
                if (between) *tops += beside_top(cosines, linkages.angles, at) * (angles[1] - angles[0]);
                ++tops;
            }
        }
        (void)n;
    });
}

bool find_cosines(const Linkages& linkages, const std::vector<std::int64_t>& watched, double* cosines, Watch& watch) {
    return each(linkages, 20, watch, [&](std::int64_t n, const Moved& moved) {
        for (std::size_t k = 0; k < watched.size(); ++k)
            for (std::int64_t end = 0; end < ends; ++end) {
                const auto row = static_cast<std::int64_t>(k) * ends + end;
                cosines[row * linkages.count + n] = moved.cosines(watched[k])[row];
            }
    });
}

bool cosine_slopes(const Linkages& linkages, const std::vector<std::int64_t>& watched, double* slopes, Watch& watch) {
    Slopes planes(linkages, true);
    const std::int64_t numbers = planes.count() - 1;
    std::vector<Complex> rows(ends * planes.count());
    std::vector<double> by_number(planes.count());
    return each(linkages, 200, watch, [&](std::int64_t n, const Moved& moved) {
        for (std::size_t k = 0; k < watched.size(); ++k)
            for (std::int64_t end = 0; end < ends; ++end) {
                const auto angle = static_cast<std::int64_t>(k) * ends + end;
                planes.differentiate(moved, angle, watched[k]);
                differentiate_cosine(linkages.dyads[watched[k]], moved, planes, angle,
                                     moved.cosines(watched[k])[angle], rows, by_number.data());
                for (std::int64_t x = 0; x < numbers; ++x)
                    slopes[(angle * numbers + x) * linkages.count + n] = by_number[x];
            }
    });
}

bool trace(const Linkages& linkages, std::int64_t link, Complex* z, Watch& watch) {
    return each(linkages, 20, watch, [&](std::int64_t n, const Moved& moved) {
        write_trace(linkages, link, moved, z + n * linkages.angles);
    });
}

bool trace_slopes(const Linkages& linkages, std::int64_t link, bool by_places, Complex* z, Complex* slopes, Watch& watch) {
    Slopes planes(linkages, by_places);
    const std::int64_t count = planes.count();
    std::vector<Complex> row(count);
    return each(linkages, by_places ? 200 : 40, watch, [&](std::int64_t n, const Moved& moved) {
        write_trace(linkages, link, moved, z + n * linkages.angles);
        for (std::int64_t i = 0; i < linkages.angles; ++i) {
            planes.differentiate(moved, i, linkages.dyad_count);
            planes.of_place(moved, i, link, linkages.element_count - 1, row.data());
            const std::int64_t at = n * linkages.angles + i;
            for (std::int64_t k = 0; k < count; ++k) slopes[k * linkages.count * linkages.angles + at] = row[k];
        }
    });
}

}  // namespace gruebler::design
