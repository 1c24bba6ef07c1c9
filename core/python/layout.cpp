#include "doors.hpp"
#include "layout/relaxation.hpp"

namespace gruebler::doors {
namespace {

using namespace layout;

using Places = Array<double, -1, 2>;
using Pairs = Array<std::int64_t, -1, 2>;

constexpr int most_power = 20;

bool all_below(const std::int64_t* numbers, std::size_t count, std::int64_t bound, std::size_t stride = 1) {
    for (std::size_t i = 0; i < count; i += stride)
        if (numbers[i] < 0 || numbers[i] >= bound) return false;
    return true;
}

const Point* points_of(const Places& layout) { return reinterpret_cast<const Point*>(layout.data()); }

// Points and segments.
Drawing drawn(const Places& layout, const Pairs& segments) {
    Drawing drawing{};
    drawing.points = static_cast<std::int64_t>(layout.shape(0));
    drawing.segments = static_cast<std::int64_t>(segments.shape(0));
    expect(all_below(segments.data(), segments.size(), drawing.points), "a segment ends at a point that is none");
    drawing.segment = reinterpret_cast<const Segment*>(segments.data());
    return drawing;
}

// Pairs to be watched besides.
Drawing drawn(const Places& layout, const Pairs& segments, const Pairs& watched) {
    Drawing drawing = drawn(layout, segments);
    drawing.watched = static_cast<std::int64_t>(watched.shape(0));
    const bool known = all_below(watched.data(), watched.size(), drawing.segments, 2) &&
                       (watched.size() == 0 || all_below(watched.data() + 1, watched.size() - 1, drawing.points, 2));
    expect(known, "a watched pair is a segment and a point");
    drawing.pair = reinterpret_cast<const Watched*>(watched.data());
    return drawing;
}

nb::tuple relax(const Places& layout, const Pairs& segments, const Array<double, -1>& pull, const Pairs& watched,
                const Array<std::int64_t, -1, -1>& images, const Array<double, -1, 2, 2>& turns, int power,
                std::int64_t rounds) {
    Drawing drawing = drawn(layout, segments, watched);
    expect(pull.shape(0) == segments.shape(0), "pull must have a number for each segment");
    expect(images.shape(0) == turns.shape(0) && images.shape(1) == layout.shape(0),
           "images must have a row for each turn and a column for each point");
    expect(all_below(images.data(), images.size(), drawing.points), "an image is a point that is none");
    expect(power >= 2 && power <= most_power && power % 2 == 0, "the power is an even number from 2 to 20");
    expect(rounds >= 0, "the number of rounds is not negative");
    drawing.pull = pull.data();
    drawing.symmetries = static_cast<std::int64_t>(turns.shape(0));
    drawing.image = images.data();
    drawing.turn = reinterpret_cast<const Turn*>(turns.data());
    const std::size_t count = layout.shape(0);
    std::vector<Point> places(points_of(layout), points_of(layout) + count);
    const Relaxed relaxed =
        run([&](Watch& watch) { return layout::relax(drawing, power, rounds, places.data(), watch); });
    return nb::make_tuple(hand_over<double>(std::move(places), {count, 2}), relaxed.energy);
}

double closest(const Places& layout, const Pairs& segments, const Pairs& watched) {
    return layout::closest(drawn(layout, segments, watched), points_of(layout));
}

NewArray<std::int64_t> crossing_segments(const Places& layout, const Pairs& segments) {
    const Drawing drawing = drawn(layout, segments);
    std::vector<Segment> pairs;
    run([&](Watch& watch) { return layout::crossing_segments(drawing, points_of(layout), pairs, watch); });
    const std::size_t count = pairs.size();
    return hand_over<std::int64_t>(std::move(pairs), {count, 2});
}

}  // namespace

void add_layout(nb::module_& module) {
    module.def("relax", relax, nb::arg("layout").noconvert(), nb::arg("segments").noconvert(),
               nb::arg("pull").noconvert(), nb::arg("watched").noconvert(), nb::arg("images").noconvert(),
               nb::arg("turns").noconvert(), nb::arg("power"), nb::arg("rounds"),
               "A layout with less energy, sum of pull |segment|^2 + sum of distance^-power over the watched pairs, by "
               "steps so short that no watched point passes its segment: float64[n, 2] and the energy.\n\n"
               "layout: float64[n, 2]; segments: int64[m, 2] of points; pull: float64[m]; watched: int64[k, 2] of "
               "(segment, point); images: int64[g, n] and turns: float64[g, 2, 2], the symmetries that are kept; power: "
               "an even number; rounds: at most so many steps.");
    module.def("closest", closest, nb::arg("layout").noconvert(), nb::arg("segments").noconvert(),
               nb::arg("watched").noconvert(),
               "The least distance of a watched pair, infinite if there is none.\n\nThe arguments are those of `relax`.");
    module.def("crossing_segments", crossing_segments, nb::arg("layout").noconvert(), nb::arg("segments").noconvert(),
               "The pairs of segments without common point that cross: int64[k, 2].\n\n"
               "The arguments are those of `relax`.");
}

}  // namespace gruebler::doors
