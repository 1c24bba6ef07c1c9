// The kinds of Assur groups met so far, found again by their joints.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "atlas/mechanisms.hpp"

namespace gruebler::atlas {

// Rows of one width; open addressing, at most half full.
class GroupTable {
public:
    GroupTable(int joints, std::vector<std::int16_t>& rows)
        : width_(static_cast<std::size_t>(group_width(joints))), rows_(rows), slots_(1024, -1) {}

    // The number of the row with the same joints, or of the one that is added; sets `added`.
    std::int32_t find(const std::vector<std::int16_t>& row, bool& added) {
        std::size_t slot = hash(row) & (slots_.size() - 1);
        for (; slots_[slot] >= 0; slot = (slot + 1) & (slots_.size() - 1)) {
            if (std::equal(row.begin() + head, row.end(), at(slots_[slot]) + head)) {
                added = false;
                return slots_[slot];
            }
        }
        added = true;
        const auto number = static_cast<std::int32_t>(rows_.size() / width_);
        rows_.insert(rows_.end(), row.begin(), row.end());
        slots_[slot] = number;
        if (2 * static_cast<std::size_t>(number) >= slots_.size()) grow();
        return number;
    }

    std::int16_t* at(std::int32_t number) { return rows_.data() + static_cast<std::size_t>(number) * width_; }

private:
    static constexpr int head = sizeof(GroupHead) / sizeof(std::int16_t);

    std::size_t width_;
    std::vector<std::int16_t>& rows_;
    std::vector<std::int32_t> slots_;  // a power of two of them

    // FNV-1a over the joints.
    static std::size_t hash(const std::vector<std::int16_t>& row) {
        std::uint64_t code = 0xCBF29CE484222325;
        for (std::size_t i = head; i < row.size(); ++i) code = (code ^ static_cast<std::uint16_t>(row[i])) * 0x100000001B3;
        return static_cast<std::size_t>(code ^ code >> 32);
    }

    void grow() {
        slots_.assign(2 * slots_.size(), -1);
        std::vector<std::int16_t> row;
        for (std::size_t k = 0; k < rows_.size() / width_; ++k) {
            row.assign(rows_.begin() + static_cast<std::ptrdiff_t>(k * width_),
                       rows_.begin() + static_cast<std::ptrdiff_t>((k + 1) * width_));
            std::size_t slot = hash(row) & (slots_.size() - 1);
            while (slots_[slot] >= 0) slot = (slot + 1) & (slots_.size() - 1);
            slots_[slot] = static_cast<std::int32_t>(k);
        }
    }
};

}  // namespace gruebler::atlas
