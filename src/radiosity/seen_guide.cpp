#include "radiosity/seen_guide.h"

#include "radiosity/density.h"
#include "radiosity/hemisphere.h"
#include "radiosity/mesh.h"
#include "radiosity/receivers.h"
#include "radiosity/shot.h"
#include "radiosity/workers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hemilux {
namespace {

/// rho^2 / A relative to the mean patch, in quarters of an octave over 63 octaves; 0: nothing seen.
constexpr double steps_per_octave = 4, lowest_octave = -24;

std::uint8_t to_byte(double value) {
    if (!(value > 0))
        return 0;
    const double step = std::round(steps_per_octave * (std::log2(value) - lowest_octave));
    return static_cast<std::uint8_t>(1 + std::clamp(step, 0.0, 254.0));
}

double from_byte(std::uint8_t byte) {
    return byte == 0 ? 0 : std::exp2((byte - 1) / steps_per_octave + lowest_octave);
}

/// The part of its rays that a triangle gets whatever was seen through it.
constexpr double floor_share = .5;

/// How many hits the three vertices of a triangle count for when it learns.
constexpr float worth_of_vertices = 4;

class SeenGuide final : public Strategy {
  public:
    SeenGuide(const SolverInput& input, const Hemisphere& hemisphere, const Workers& workers,
              bool learn)
        : mesh_(input.mesh), needs_(input.needs), hemisphere_(hemisphere),
          first_leaf_(Hemisphere::cells_up_to(hemisphere.depth() - 1)), learn_(learn) {
        const std::size_t patches = mesh_.patches().size(), vertices = hemisphere.vertices().size();
        double area = 0;
        for (const Patch& patch : mesh_.patches())
            area += patch.area;
        mean_area_ = area / static_cast<double>(patches);
        seen_.resize(patches * vertices);
        workers.for_chunks(patches, 16, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end && !input.monitor.interrupted; ++i)
                if (needs_.power(static_cast<std::uint32_t>(i)))
                    look(static_cast<std::uint32_t>(i), input.tracer);
        });
        for (std::uint32_t i = 0; i < patches; ++i)
            rays_ += needs_.power(i) ? vertices : 0;
        input.monitor.rays += rays_;
        if (learn_)
            start_learning();
    }

    void begin_step(std::uint64_t) override {
        if (!learn_)
            return;
        for (const Lesson& lesson : lessons_) {
            Known& known = known_[lesson.place];
            known.weight += lesson.hits;
            known.mean += (lesson.sum - lesson.hits * known.mean) / known.weight;
        }
        lessons_.clear();
    }

    void deal(std::uint32_t patch, std::vector<CellShare>& shares) const override {
        const auto& cells = hemisphere_.cells();
        shares.clear();
        double mean = 0;
        for (std::size_t c = first_leaf_; c < cells.size(); ++c) {
            const double power = cells[c].projected_solid_angle / std::numbers::pi;
            const double worth = std::sqrt(seen_through(patch, c));
            shares.push_back({static_cast<std::uint16_t>(c), power, power * worth});
            mean += power * worth;
        }
        for (CellShare& share : shares) {
            const double guided = mean > 0 ? share.rays / mean : share.power;
            share.rays = floor_share * share.power + (1 - floor_share) * guided;
        }
    }

    [[nodiscard]] bool learns() const override { return learn_; }
    void learn(std::uint32_t patch, std::uint16_t cell,
               std::span<const std::uint32_t> receivers) override {
        Lesson lesson{place(patch, cell), 0, static_cast<float>(receivers.size())};
        for (const std::uint32_t receiver : receivers)
            lesson.sum += static_cast<float>(value_of(receiver));
        lessons_.push_back(lesson);
    }

    [[nodiscard]] std::uint64_t density_rays() const override { return rays_; }
    [[nodiscard]] std::uint64_t density_bytes() const override {
        return seen_.size() + known_.size() * sizeof(Known);
    }

  private:
    /// What hits have told of a leaf: mean of rho^2 / A, and from how many.
    struct Known {
        float mean, weight;
    };
    struct Lesson {
        std::size_t place;
        float sum, hits;
    };

    /// rho^2 / A relative to the mean patch, mean of channels.
    [[nodiscard]] double value_of(std::uint32_t receiver) const {
        if (receiver == escaped || receiver == absorbed)
            return 0;
        const Vec3& rho = mesh_.material(receiver).reflectance;
        const double area = mesh_.patches()[receiver].area;
        return area > 0 ? mean_of_channels(rho * rho) * mean_area_ / area : 0;
    }

    void look(std::uint32_t patch, const Tracer& tracer) {
        const Patch& from = mesh_.patches()[patch];
        const Frame frame = mesh_.hemisphere_frame(patch);
        std::vector<Ray> rays;
        for (const Vec3& vertex : hemisphere_.vertices()) {
            rays.push_back({from.centre, frame.to_world(density_direction(vertex))});
            rays.back().from = from.facet;
        }
        std::vector<std::uint32_t> receivers;
        find_receivers(rays, mesh_, tracer, receivers);
        for (std::size_t v = 0; v < receivers.size(); ++v)
            seen_[patch * receivers.size() + v] = to_byte(value_of(receivers[v]));
    }

    [[nodiscard]] double mean_of_vertices(std::uint32_t patch, std::size_t cell) const {
        double sum = 0;
        for (const std::uint16_t v : hemisphere_.cells()[cell].vertex)
            sum += from_byte(seen_[patch * hemisphere_.vertices().size() + v]);
        return sum / 3;
    }
    [[nodiscard]] std::size_t place(std::uint32_t patch, std::size_t cell) const {
        return patch * (hemisphere_.cells().size() - first_leaf_) + cell - first_leaf_;
    }
    [[nodiscard]] double seen_through(std::uint32_t patch, std::size_t cell) const {
        return learn_ ? static_cast<double>(known_[place(patch, cell)].mean)
                      : mean_of_vertices(patch, cell);
    }

    void start_learning() {
        for (std::uint32_t i = 0; i < mesh_.patches().size(); ++i)
            for (std::size_t c = first_leaf_; c < hemisphere_.cells().size(); ++c)
                known_.push_back({static_cast<float>(mean_of_vertices(i, c)), worth_of_vertices});
    }

    const Mesh& mesh_;
    const Needs& needs_;
    const Hemisphere& hemisphere_;
    std::size_t first_leaf_;
    bool learn_;
    double mean_area_ = 0;
    std::vector<std::uint8_t> seen_; ///< by patch and vertex
    std::vector<Known> known_;       ///< by patch and leaf, when it learns
    std::vector<Lesson> lessons_;    ///< of the present step
    std::uint64_t rays_ = 0;
};

} // namespace

std::unique_ptr<Strategy> make_seen_guide(const SolverInput& input, const Hemisphere& hemisphere,
                                          const Workers& workers, bool learn) {
    return std::make_unique<SeenGuide>(input, hemisphere, workers, learn);
}

} // namespace hemilux
