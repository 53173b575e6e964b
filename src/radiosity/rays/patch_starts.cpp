#include "radiosity/rays/patch_starts.h"

#include "radiosity/scene/mesh.h"

namespace hemilux {
namespace {

constexpr std::size_t most_kept = 25'000;

} // namespace

PatchStarts::PatchStarts(const Mesh& mesh) : mesh_(mesh) {
    const auto patches = static_cast<std::uint32_t>(mesh.patches().size());
    if (patches > most_kept)
        return;
    kept_.reserve(patches);
    for (std::uint32_t i = 0; i < patches; ++i)
        kept_.push_back(make(i));
}

PatchStart PatchStarts::make(std::uint32_t patch) const {
    const Patch& from = mesh_.patches()[patch];
    return {PolygonSampler(from.shape), mesh_.hemisphere_frame(patch), patch, from.facet};
}

const PatchStart& PatchStarts::of(std::uint32_t patch, std::optional<PatchStart>& memory) const {
    if (!kept_.empty())
        return kept_[patch];
    if (!memory || memory->patch != patch)
        memory = make(patch);
    return *memory;
}

} // namespace hemilux
