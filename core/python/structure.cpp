#include <atomic>
#include <limits>

#include "doors.hpp"
#include "structure/assembly_modes.hpp"
#include "structure/groups.hpp"
#include "structure/multiple_joints.hpp"
#include "structure/sliding.hpp"

namespace gruebler::doors {
namespace {

using namespace structure;

// --- multiple joints

// Links may go without joints, but no chain has more than 3 (links - 1) / 2 of them.
void check_simple(int links, const Array<std::int64_t, -1, -1>& simple) {
    expect(links >= 1 && links <= most_merged_links, "there are 1 to 20 links");
    expect(2 * static_cast<std::int64_t>(simple.shape(1)) <= 3 * (links - 1),
           "there are more joints than a chain of " + std::to_string(links) + " links can have");
    const std::size_t joints = simple.shape(1);
    for (std::size_t k = 0; k < simple.shape(0); ++k) {
        const std::int64_t* joint = simple.data() + k * joints;
        for (std::size_t j = 0; j < joints; ++j) {
            bool sound = joint[j] > 0 && joint[j] < std::int64_t{1} << links &&
                         bits::size(static_cast<bits::Word>(joint[j])) == 2;
            for (std::size_t i = 0; i < j; ++i) sound = sound && joint[i] != joint[j];
            if (!sound) throw nb::value_error(("chain " + std::to_string(k) + " has a joint that is not two of its links, "
                                               "or one twice").c_str());
        }
    }
}

class Growth {
public:
    Growth(int links, const Array<std::int64_t, -1, -1>& simple, int fewest, int most, int largest)
        : width_(simple.shape(1) + 1),
          search_((check_simple(links, simple), links), static_cast<int>(simple.shape(1)),
                  std::vector<bits::Word>(simple.data(), simple.data() + simple.size()), {fewest, most, largest}) {}

    NewArray<std::int64_t> next(std::int64_t many) {
        expect(many >= 0 && many <= std::numeric_limits<std::int32_t>::max(), "the number of chains is 0 to 2147483647");
        expect(!busy_.exchange(true), "another thread grows these chains");
        const std::unique_ptr<std::atomic<bool>, void (*)(std::atomic<bool>*)> freed(
            &busy_, [](std::atomic<bool>* busy) { *busy = false; });
        std::vector<std::int64_t> rows;
        run([&](Watch& watch) { return search_.grow(many, rows, watch); });
        const size_t count = rows.size() / width_;
        return hand_over<std::int64_t>(std::move(rows), {count, width_});
    }

private:
    size_t width_;
    MultipleJoints search_;
    std::atomic<bool> busy_ = false;
};

// --- sliding joints

void check_residues(const Array<std::int64_t, 2, -1, -1>& vectors) {
    for (std::size_t i = 0; i < vectors.size(); ++i)
        expect(vectors.data()[i] >= 0 && vectors.data()[i] < static_cast<std::int64_t>(prime),
               "the vectors consist of numbers from 0 to 2147483646");
}

void check_images(const Array<std::int64_t, -1, -1>& images, int simple) {
    expect(images.shape(0) >= 1 && images.shape(1) == static_cast<std::size_t>(simple),
           "an automorphism has an image of each simple column, and there is one at least");
    for (std::size_t g = 0; g < images.shape(0); ++g) {
        bits::Word seen = 0;
        for (int k = 0; k < simple; ++k) {
            const std::int64_t image = images.data()[g * images.shape(1) + k];
            if (image >= 0 && image < simple) seen |= bits::bit(static_cast<int>(image));
        }
        if (seen != bits::ones(simple))
            throw nb::value_error(("automorphism " + std::to_string(g) + " is no permutation").c_str());
    }
}

NewArray<std::int64_t> count_sliding(const Array<std::int64_t, 2, -1, -1>& vectors, int simple,
                                     const Array<std::int64_t, -1>& joint, int mobility,
                                     const Array<std::int64_t, -1, -1>& images) {
    expect(vectors.shape(1) >= 1 && vectors.shape(1) <= most_columns, "there are 1 to 62 columns");
    expect(vectors.shape(2) <= 1 << 16, "there are at most 65536 rows");
    const int columns = static_cast<int>(vectors.shape(1));
    expect(simple >= 0 && simple <= columns, "at most all columns are simple");
    expect(joint.shape(0) == vectors.shape(1), "each column has a joint");
    for (int k = 0; k < columns; ++k)
        expect(joint.data()[k] >= 0 && joint.data()[k] < most_columns, "joints are numbered from 0 to 61");
    check_residues(vectors);
    check_images(images, simple);
    const ClosureColumns chain{columns, static_cast<int>(vectors.shape(2)), simple, vectors.data(), joint.data(),
                               static_cast<std::int64_t>(images.shape(0)), images.data()};
    auto sums = run([&](Watch& watch) { return structure::count_sliding(chain, mobility, watch); });
    const size_t length = sums.size();
    return hand_over<std::int64_t>(std::move(sums), {length});
}

// --- Assur groups

NewArray<std::int64_t> describe_groups(int n, const Array<std::uint8_t, -1, -1, 2>& trusses) {
    expect(n >= 1 && n <= most_truss_links, "a truss has 1 to 32 links");
    expect(trusses.shape(1) <= most_truss_joints, "a truss has at most 62 joints");
    const std::size_t joints = trusses.shape(1);
    const std::uint8_t* ends = trusses.data();
    for (std::size_t i = 0; i < trusses.shape(0) * joints; ++i)
        if (ends[2 * i] >= n || ends[2 * i + 1] >= n || ends[2 * i] == ends[2 * i + 1])
            throw nb::value_error(
                ("truss " + std::to_string(i / joints) + " has a joint that does not join two of its links").c_str());
    std::vector<std::int64_t> rows;
    const Trusses all{n, static_cast<int>(joints), static_cast<std::int64_t>(trusses.shape(0)), ends};
    run([&](Watch& watch) { return structure::describe_groups(all, rows, watch); });
    const size_t width = 2 + 2 * joints, count = rows.size() / width;
    return hand_over<std::int64_t>(std::move(rows), {count, width});
}

// --- assembly modes

NewArray<std::int64_t> count_modes(int n, const Array<std::int64_t, -1, -1>& trusses, bool spherical) {
    expect(n >= 1 && n <= most_mode_links, "a truss has 1 to 21 links");
    expect(trusses.shape(1) <= most_mode_joints, "a truss has at most 30 joints");
    const std::size_t joints = trusses.shape(1);
    for (std::size_t k = 0; k < trusses.shape(0); ++k) {
        bool sound = true;
        int held = 0;
        for (std::size_t j = 0; j < joints; ++j) {
            const std::int64_t joint = trusses.data()[k * joints + j];
            const int links = joint > 0 ? bits::size(static_cast<bits::Word>(joint)) : 0;
            sound = sound && joint < std::int64_t{1} << n && links >= 2;
            held += 2 * (links - 1);
        }
        if (!sound || held != 3 * (n - 1))
            throw nb::value_error(("truss " + std::to_string(k) + " has joints that are not sets of two or more of its links "
                                   "or do not hold them by count").c_str());
    }
    std::vector<std::int64_t> modes;
    run([&](Watch& watch) {
        PlanarModes planar(spherical ? 1 : n);
        for (std::size_t k = 0; k < trusses.shape(0); ++k) {
            const std::int64_t* first = trusses.data() + k * joints;
            const JointSets truss(first, first + joints);
            const auto number = spherical ? count_spherical_modes(n, truss, watch) : planar.count(truss, watch);
            if (!number) return false;
            modes.push_back(*number);
        }
        return true;
    });
    const size_t count = modes.size();
    return hand_over<std::int64_t>(std::move(modes), {count});
}

}  // namespace

void add_structure(nb::module_& module) {
    nb::class_<Growth>(module, "MultipleJoints",
                       "The chains with multiple joints that grow from chains with simple ones, each once.\n\n"
                       "simple: int64[k, joints], each joint a set of two links as bits; none of the chains isomorphic to "
                       "another. Chains with `fewest` to `most` joints of more than two links, none of more than "
                       "`largest`, are listed.")
        .def(nb::init<int, const Array<std::int64_t, -1, -1>&, int, int, int>(), nb::arg("links"),
             nb::arg("simple").noconvert(), nb::arg("fewest"), nb::arg("most"), nb::arg("largest"))
        .def("next", &Growth::next, nb::arg("many"),
             "The next chains, fewer than `many` only if there are no more: int64[m, 1 + joints], the number of the chain "
             "of simple joints and the joints, zeros behind.");
    module.def("count_sliding", count_sliding, nb::arg("vectors").noconvert(), nb::arg("simple"),
               nb::arg("joint").noconvert(), nb::arg("mobility"), nb::arg("images").noconvert(),
               "For each number of sliding joints the automorphisms that fix a choice, added up over all choices in which "
               "every joint moves: int64[simple + 1].\n\n"
               "vectors: int64[2, columns, rows], the columns of the closure equations modulo 2**31 - 1, as turning and as "
               "sliding joints, of which the first `simple` can be chosen; joint: int64[columns], the joint of each; "
               "mobility: the dimension of the solutions; images: int64[automorphisms, simple], the identity first.");
    module.def("describe_groups", describe_groups, nb::arg("n"), nb::arg("trusses").noconvert(),
               "The Assur groups of trusses of n links, each once: int64[m, 2 + 2 joints]: class, order, the joints in "
               "canonical order, 0 standing for a place outside.\n\ntrusses: uint8[k, joints, 2].");
    module.def("count_modes", count_modes, nb::arg("n"), nb::arg("trusses").noconvert(), nb::arg("spherical"),
               "The complex assembly modes of trusses of n links whose joints turn, at almost all dimensions, in the plane "
               "or on the sphere: int64[k], 0 for a truss with an overconstrained part.\n\n"
               "trusses: int64[k, joints], each joint a set of two links or more as bits.");
}

}  // namespace gruebler::doors
