#include "radiosity/engine/stored_transport/linked_parts.h"

#include "radiosity/engine/form_factors/ray_counts.h"
#include "radiosity/engine/sparse/disjoint_sets.h"

#include <algorithm>

namespace hemilux {
namespace {

/// Numbers the sets in the order of their least members.
LinkedParts parts_of(DisjointSets& sets, std::uint32_t patches) {
    LinkedParts parts;
    for (std::uint32_t i = 0; i < patches; ++i) {
        const std::uint32_t first = sets.find(i);
        parts.of.push_back(first == i ? parts.count++ : parts.of[first]);
    }
    return parts;
}

/// Finds the least name that any rank has for each patch; the patch's owner finds it.
void take_least(std::vector<std::uint32_t>& names, const OwnBlocks& own) {
    std::vector<std::vector<std::uint32_t>> sent(own.ranks().count());
    for (std::size_t i = 0; i < names.size(); ++i)
        sent[own.owner(i)].push_back(names[i]);
    for (const std::vector<std::uint32_t>& of_rank : own.ranks().exchange(sent))
        for (std::size_t k = 0; k < of_rank.size(); ++k)
            names[own.item(k)] = std::min(names[own.item(k)], of_rank[k]);
    own.gather(names);
}

/// Joins the sets of all ranks. Each rank knows what its own rays have joined; until all know the
/// same, they join what any does.
LinkedParts parts_of_all(DisjointSets& sets, const OwnBlocks& own, std::uint32_t patches) {
    for (bool differ = own.ranks().are_several(); differ;) {
        std::vector<std::uint32_t> names;
        for (std::uint32_t i = 0; i < patches; ++i)
            names.push_back(sets.find(i));
        take_least(names, own);
        differ = false;
        for (std::uint32_t i = 0; i < patches; ++i) {
            differ |= sets.find(i) != names[i];
            sets.join(i, names[i]);
        }
        differ = own.ranks().any(differ);
    }
    return parts_of(sets, patches);
}

} // namespace

LinkedParts find_linked_parts(std::span<const RayCounts> batches) {
    const std::uint32_t patches = batches[0].patches();
    DisjointSets sets(patches);
    for (const RayCounts& batch : batches)
        for (std::uint32_t i = 0; i < patches; ++i)
            for (const std::uint32_t word : batch.row(i))
                sets.join(i, batch.words().column(word));
    return parts_of_all(sets, batches[0].own_rows(), patches);
}

} // namespace hemilux
