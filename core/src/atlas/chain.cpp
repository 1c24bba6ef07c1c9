#include "atlas/chain.hpp"

#include <array>

namespace gruebler::atlas {
namespace {

using namespace bits;

// Colours as gruebler.structure.isomorphism has them.
constexpr int link_colour = 1, first_joint_colour = 2, hub_edge_colour = 0;

}  // namespace

bool Chain::read(int n, std::int64_t multiple, int edges, const std::int32_t* ends, const std::int32_t* kinds) {
    if (multiple < 0 || multiple > most_vertices - n) return false;
    links = n;
    hubs = static_cast<int>(multiple);
    joints.clear();
    near.assign(static_cast<std::size_t>(n), 0);
    labeller.begin(vertices(), link_colour);
    std::array<Joint, most_vertices> hub{};
    std::array<int, most_vertices> degree{};
    for (int e = 0; e < edges; ++e) {
        const int u = ends[2 * e], v = ends[2 * e + 1], kind = kinds[e];
        if (u < 0 || u >= n || v < 0 || v >= vertices() || u == v) return false;
        ++degree[u];
        ++degree[v];
        if (v < n) {
            joints.push_back({bit(u) | bit(v), kind});
            labeller.join(u, v, 1 + 2 * kind);
        } else {
            if (has(hub[v].links, u)) return false;
            hub[v].links |= bit(u);
            hub[v].kind = kind;
            labeller.join(u, v, hub_edge_colour);
        }
    }
    for (int v = 0; v < vertices(); ++v)
        if (degree[v] < 2 || (v >= n && degree[v] > most_members)) return false;
    for (int v = n; v < vertices(); ++v) {
        joints.push_back(hub[v]);
        labeller.colour(v, first_joint_colour + 2 * hub[v].kind);
    }
    for (const Joint& joint : joints)
        for (Word set = joint.links; set != 0; set = without_lowest(set)) near[lowest(set)] |= joint.links & ~bit(lowest(set));
    return true;
}

}  // namespace gruebler::atlas
