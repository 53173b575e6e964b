// Checkpoints whose length and checksum are mended after each change, so that the changes reach the
// solvers: each is refused, or loaded by some method, which then takes a step to finite numbers.

#include "bvh/brute_force.h"
#include "io/files/error.h"
#include "io/results/checkpoint.h"
#include "radiosity/engine/saving/state.h"
#include "radiosity/engine/solving/engine_solver.h"
#include "radiosity/engine/solving/method.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/solve_error.h"
#include "saved_runs.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace {

using namespace hemilux;
using fuzz::facing_triangles;

/// The content of a whole file, however wrong its length and checksum are.
std::string_view content_of(std::string_view file) {
    constexpr std::size_t word = sizeof(std::uint64_t);
    const std::size_t line = std::min(file.find('\n'), file.size());
    const std::size_t begin = std::min(line + 1 + word, file.size());
    const std::size_t end = std::max(begin, file.size() - std::min(word, file.size()));
    return file.substr(begin, end - begin);
}

void check_finite(const Solution& solution) {
    for (const Vec3& b : solution.radiosity)
        if (!std::isfinite(b.x + b.y + b.z))
            std::abort();
}

/// A checkpoint may ask for a step of very many rays: it is then interrupted, as a user would.
class PatientTracer final : public Tracer {
  public:
    PatientTracer(const FacetSoup& soup, Monitor& monitor) : tracer_(soup), monitor_(monitor) {}
    [[nodiscard]] std::optional<Hit> closest(const Ray& ray) const override {
        count_ray();
        return tracer_.closest(ray);
    }
    [[nodiscard]] bool occluded(const Ray& ray, std::uint32_t target) const override {
        count_ray();
        return tracer_.occluded(ray, target);
    }
    [[nodiscard]] std::uint32_t count(const Ray& ray) const override {
        count_ray();
        return tracer_.count(ray);
    }

  private:
    void count_ray() const {
        constexpr int patience = 20'000;
        if (++rays_ > patience)
            monitor_.interrupted.set_wished(true);
    }

    BruteForce tracer_;
    Monitor& monitor_;
    mutable int rays_ = 0;
};

void go_on(const std::string& state) {
    static const Mesh mesh(facing_triangles());
    static const auto runs = fuzz::saved_runs();
    for (const auto& [method, options] : runs) {
        Monitor monitor;
        const PatientTracer tracer(mesh.soup(), monitor);
        const auto solver = method->make({mesh, tracer, options, monitor, everything_needed});
        try {
            StateReader reader(state);
            solver->load(reader);
            reader.expect_end();
            if (!solver->finished())
                (void)solver->step();
        } catch (const StateError&) {
            continue;
        } catch (const SolveError&) {
        }
        check_finite(solver->solution());
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view file(reinterpret_cast<const char*>(data), size);
    try {
        go_on(checkpoint_from(sealed_checkpoint(content_of(file)), "saved").state);
    } catch (const InputError&) {
    }
    return 0;
}
