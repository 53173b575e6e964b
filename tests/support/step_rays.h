#pragma once
// The rays that a method shoots in a step, as the tracer sees them.

#include "support/catch.h"
#include "support/solve.h"
#include "support/watched_tracer.h"

#include <memory>
#include <utility>
#include <vector>

namespace hemilux::test {

/// The same surfaces, which absorb all: each step is one bounce.
[[nodiscard]] inline Scene black(Scene scene) {
    for (Material& material : scene.materials)
        material.reflectance = Vec3(0.0);
    return scene;
}

/// The rays of a step from one patch.
struct StepRays {
    std::uint32_t patch;
    std::vector<Ray> rays;
};

/// A run, step by step, on one thread. Faces of the model are patches; it must outlive this.
class Steps {
  public:
    Steps(const Model& model, const Method& method, const SolveOptions& options)
        : model_(model), recorder_(model.bvh,
                                   [this](std::span<const Ray> rays) {
                                       recorded_.insert(recorded_.end(), rays.begin(), rays.end());
                                   }),
          options_(options), input_{model.mesh, recorder_, options_, monitor_} {
        options_.threads = 1;
        solver_ = method.make(input_);
        REQUIRE(solver_->step()); // has the pilot's rays before its own
        first_ = std::exchange(recorded_, {});
    }

    /// The rays of the next step, by patch that emits; the first step has the pilot's besides.
    [[nodiscard]] std::vector<StepRays> next() {
        if (!first_.empty())
            return by_patch(std::exchange(first_, {}));
        recorded_.clear();
        REQUIRE(solver_->step());
        return by_patch(recorded_);
    }

  private:
    [[nodiscard]] std::vector<StepRays> by_patch(const std::vector<Ray>& rays) const {
        std::vector<StepRays> result;
        std::vector<std::size_t> place(model_.mesh.patches().size(), none);
        for (std::uint32_t i = 0; i < model_.mesh.patches().size(); ++i)
            if (model_.mesh.material(i).emission.x > 0) {
                place[model_.mesh.patches()[i].facet] = result.size();
                result.push_back({i, {}});
            }
        for (const Ray& ray : rays)
            result.at(place.at(ray.from)).rays.push_back(ray);
        REQUIRE_FALSE(result.empty());
        return result;
    }

    static constexpr std::size_t none = static_cast<std::size_t>(-1); ///< shoots no ray

    const Model& model_;
    std::vector<Ray> recorded_;
    WatchedTracer recorder_;
    Monitor monitor_;
    SolveOptions options_;
    SolverInput input_;
    std::unique_ptr<Solver> solver_;
    std::vector<Ray> first_;
};

} // namespace hemilux::test
