#include "radiosity/answers/vertices/indirect_light.h"

#include "parallel/asked_to_end.h"
#include "radiosity/engine/rays/receivers.h"
#include "radiosity/paper/rays/patch_start.h"

namespace hemilux {

std::vector<Vec3> indirect_irradiance(const Mesh& mesh, const Tracer& tracer,
                                      std::span<const Vec3> radiosity, unsigned rays,
                                      std::uint64_t seed, const Workers& workers,
                                      const std::function<bool()>& give_up) {
    std::vector<Vec3> irradiance(mesh.patches().size(), Vec3(0.0));
    const auto gather = [&](std::uint32_t patch) {
        const PatchStart start(mesh, patch);
        Rng rng(hash_words({seed, patch}));
        std::vector<Ray> group(rays);
        for (Ray& ray : group)
            ray = start.cosine_ray(rng);
        std::vector<std::uint32_t> receivers;
        find_receivers(group, mesh, tracer, receivers);
        for (const std::uint32_t receiver : receivers)
            if (receiver != escaped && receiver != absorbed)
                irradiance[patch] += radiosity[receiver] - mesh.material(receiver).emission;
        irradiance[patch] /= rays;
    };
    workers.for_chunks(irradiance.size(), 4, [&](std::size_t begin, std::size_t end) {
        if (give_up && give_up())
            throw Interrupted();
        for (std::size_t patch = begin; patch < end; ++patch)
            gather(static_cast<std::uint32_t>(patch));
    });
    return irradiance;
}

} // namespace hemilux
