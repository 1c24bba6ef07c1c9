#include <algorithm>

#include "structure/assembly_modes.hpp"

namespace gruebler::structure {
namespace {

constexpr std::size_t first_room = 1 << 10;  // minors that are known; it grows

}  // namespace

PlanarModes::PlanarModes(int links)
    : n_(links), all_(bits::ones(links)), rank_(std::size_t{1} << links), closure_(std::size_t{1} << links),
      known_(first_room) {}

// The cyclomatic number of the graph whose vertices are these links and their pins, and whose edges say what meets.
int PlanarModes::independent_loops(Word links, const JointSets& joints) const {
    int loops = 0;
    for (const Word joint : joints) {
        const int meeting = bits::size(joint & links);
        if (meeting > 0) loops += meeting - 1;  // edges without the pin itself
    }
    for (Word left = links; left != 0; ++loops) {  // plus pieces, less links
        Word piece = left & (~left + 1), before = 0;
        while (piece != before) {
            before = piece;
            for (const Word joint : joints)
                if ((joint & piece) != 0) piece |= joint & links;
        }
        left &= ~piece;
    }
    return loops - bits::size(links);
}

// The loops put generic columns, one for each link, into the cographic spaces of its joints (Rado 1942): the rank of a set
// in the dual is the least over subsets of loops lost without them, plus the rest.
void PlanarModes::find_ranks(const JointSets& joints) {
    const int loops = independent_loops(all_, joints);
    std::vector<std::uint8_t>& dual = rank_;
    dual[0] = 0;
    for (Word set = 1; set <= all_; ++set) {
        int rank = loops - independent_loops(all_ & ~set, joints);
        for (Word left = set; left != 0; left = bits::without_lowest(left))
            rank = std::min(rank, dual[set & ~bits::bit(bits::lowest(left))] + 1);
        dual[set] = static_cast<std::uint8_t>(rank);
    }
    for (Word set = 0; set <= all_ >> 1; ++set) {  // r(S) = |S| - r*(all) + r*(all - S), in pairs in place
        const Word rest = all_ & ~set;
        const int whole = set == 0 ? dual[all_] : loops, of_set = dual[set], of_rest = dual[rest];
        rank_[set] = static_cast<std::uint8_t>(bits::size(set) - whole + of_rest);
        rank_[rest] = static_cast<std::uint8_t>(bits::size(rest) - whole + of_set);
    }
    for (Word set = 0; set <= all_; ++set) {
        Word closure = set;
        for (Word left = all_ & ~set; left != 0; left = bits::without_lowest(left)) {
            const Word link = left & (~left + 1);
            if (rank_[set | link] == rank_[set]) closure |= link;
        }
        closure_[set] = static_cast<std::uint32_t>(closure);
    }
}

std::optional<std::int64_t> PlanarModes::count(const JointSets& joints, Watch& watch) {
    if (!spend(watch, std::int64_t{n_} << n_)) return std::nullopt;
    find_ranks(joints);
    std::fill(known_.begin(), known_.end(), Known{});
    known_count_ = 0;
    stopped_ = false;
    const bool loopless = closure_[0] == 0;
    const std::int64_t modes = loopless && fits(0, 0, all_) ? count_minor({0, 0, all_}, watch) : 0;
    if (stopped_) return std::nullopt;
    return modes;
}

// Whether ranks of both minors on the ground set together exceed its size by one: else they have no isolated points.
bool PlanarModes::fits(Word contracted, Word deleted, Word ground) const {
    const int first = rank_[contracted | ground] - rank_[contracted], second = rank_[deleted | ground] - rank_[deleted];
    return first + second == bits::size(ground) + 1;
}

std::int64_t PlanarModes::count_minor(const Minor& minor, Watch& watch) {
    if (bits::without_lowest(minor.ground) == 0) return 1;  // one link or none
    const std::uint64_t key = minor.contracted << n_ | minor.ground;
    if (const Known& known = place_of(key); known.key != 0) return known.modes;
    const std::int64_t modes = sum_of_splits(minor, watch);
    if (2 * ++known_count_ > known_.size()) make_room();
    place_of(key) = {key, modes};
    return modes;
}

// The theorem of splits: a link e with a length of another order belongs to both parts, each other link to one.
std::int64_t PlanarModes::sum_of_splits(const Minor& minor, Watch& watch) {
    const Word e = minor.ground & (~minor.ground + 1), others = minor.ground & ~e;
    std::int64_t sum = 0;
    stopped_ = stopped_ || !spend(watch, 4LL << bits::size(others));
    for (Word upper = others; !stopped_; upper = (upper - 1) & others) {
        const Word lower = others & ~upper;
        const Word contracted = minor.contracted | e | upper, deleted = minor.deleted | e | lower;
        if ((closure_[contracted] & lower) == 0 && (closure_[deleted] & upper) == 0 &&
            (lower == 0 || fits(contracted, minor.deleted, lower)) &&
            (upper == 0 || fits(minor.contracted, deleted, upper))) {
            const std::int64_t first = count_minor({contracted, minor.deleted, lower}, watch);
            if (first != 0) sum += first * count_minor({minor.contracted, deleted, upper}, watch);
        }
        if (upper == 0) break;
    }
    return sum;
}

PlanarModes::Known& PlanarModes::place_of(std::uint64_t key) {
    const std::size_t last = known_.size() - 1;  // a power of two less one
    std::size_t place = (key * 0x9E3779B97F4A7C15u >> 20) & last;  // Fibonacci hashing
    while (known_[place].key != 0 && known_[place].key != key) place = (place + 1) & last;
    return known_[place];
}

void PlanarModes::make_room() {
    std::vector<Known> before(2 * known_.size());
    before.swap(known_);
    for (const Known& known : before)
        if (known.key != 0) place_of(known.key) = known;
}

}  // namespace gruebler::structure
