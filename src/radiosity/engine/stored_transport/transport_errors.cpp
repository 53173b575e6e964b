#include "radiosity/engine/stored_transport/transport_errors.h"

#include "geometry/numeric.h"
#include "radiosity/engine/emitters/direct_light.h"
#include "radiosity/engine/form_factors/exchange_matrix.h"
#include "radiosity/engine/stored_transport/batch_light.h"
#include "radiosity/engine/stored_transport/linked_parts.h"
#include "radiosity/engine/stored_transport/row_spread.h"
#include "radiosity/engine/stored_transport/transport_system.h"
#include "radiosity/paper/scene/alike_neighbours.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/solution/missed_light.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hemilux {
namespace {

/// What may be missed in a dark part counts from this share of the variance on: more rays lower the
/// one and not the other.
constexpr double share_of_dark = .01;

bool any(const Vec3& v) { return v != Vec3(0.0); }

/// The sums over the patches of a linked part, by channel.
struct PartLedger {
    Vec3 used{0.0};          ///< power that ends there: absorbed, or lost
    Vec3 leaving{0.0};       ///< power that random rays stand for
    Vec3 one_ray{0.0};       ///< its mean per ray, weighted by itself
    Vec3 loss_variance{0.0}; ///< variance of the power that random rays lose
    Vec3 absorbing{0.0};     ///< area times absorptance
    double area = 0;
    double rays = 0, lost = 0; ///< numbers of rays
    bool lit = false;
};

class Account {
  public:
    explicit Account(const TransportResult& result)
        : result_(result), area_(result.system.area()), rho_(result.system.reflectance()),
          rays_(result.factors.rays()), parts_(find_linked_parts(result.counts)),
          ledgers_(parts_.count) {
        const std::size_t n = area_.size();
        lit_.resize(n);
        incident_.resize(n);
        for (std::uint32_t i = 0; i < n; ++i) {
            incident_[i] = result.light.incident(BatchLight::batches, i);
            lit_[i] = any(incident_[i]) || any(result.system.emission()[i]);
            enter(i);
        }
        for (PartLedger& part : ledgers_) {
            part.one_ray = ratio_or_zero(part.one_ray, part.leaving);
            if (part.lit)
                lit_one_ray_ = glm::max(lit_one_ray_, part.one_ray);
        }
        std::vector<Vec3> all_leaving(n);
        for (std::uint32_t i = 0; i < n; ++i)
            all_leaving[i] = leaving(i);
        const LightFoundByRays light{area_, rho_, incident_, all_leaving, rays_};
        bright_radiosity_ = bright_radiosity(light);
        missed_by_rays_ = missed_by_rays(light);
    }

    void add_missed(TransportErrors& errors) const {
        std::vector<double> dark(parts_.count); // one of them at a time has got those few rays
        double shadow_rays = 0;                 // that arrive if nothing is in their way
        for (std::uint32_t i = 0; i < area_.size(); ++i)
            shadow_rays += shadow_rays_of(i);
        for (std::uint32_t i = 0; i < area_.size(); ++i) {
            const Vec3 level = lit_[i] ? missed_loss(i) + missed_by_rays_[i] : missed_light(i);
            const double counts = weighted_area(result_, i);
            (lit_[i] ? errors.missed : dark[parts_.of[i]]) += counts * glm::dot(level, level);
            const Vec3 loss = known_loss(i);
            errors.of_losses += counts * glm::dot(loss, loss);
            const Vec3 sample = one_shadow_ray(i);
            const bool missed = result_.direct.hits(i) == 0;
            const Vec3 one = glm::max(glm::max(one_ray(i), loss), missed ? sample : Vec3(0.0));
            Vec3& sigma = errors.standard_error[i];
            sigma = glm::sqrt(glm::max(sigma * sigma, one * one) + level * level);
            const double share = shadow_rays > 0 ? shadow_rays_of(i) / shadow_rays : 0;
            errors.missed_by_shadow_rays +=
                rule_of_three * share * counts * glm::dot(sample, sample);
        }
        const double in_dark = dark.empty() ? 0 : std::ranges::max(dark);
        const double least = share_of_dark * errors.variance;
        errors.missed += in_dark;
        errors.missed_in_dark = in_dark > least ? in_dark : 0;
        errors.part = parts_.of;
        errors.lit = errors.needs_rays = lit_;
        for (std::uint32_t i = 0; i < area_.size(); ++i)
            if (dark[parts_.of[i]] > least)
                errors.needs_rays[i] = true;
    }

  private:
    /// Returns what random rays of a patch stand for [W/m2].
    [[nodiscard]] Vec3 leaving(std::uint32_t i) const {
        return rho_[i] * incident_[i] + result_.system.sampled_emission()[i];
    }
    void enter(std::uint32_t i) {
        PartLedger& part = ledgers_[parts_.of[i]];
        const auto& [escaped, absorbed] = result_.factors.lost()[i];
        const Vec3 power = area_[i] * leaving(i);
        part.area += area_[i];
        part.rays += rays_[i];
        part.lost += rays_[i] * (escaped + absorbed);
        part.lit = part.lit || lit_[i];
        part.absorbing += area_[i] * (1.0 - rho_[i]);
        part.used += area_[i] * (1.0 - rho_[i]) * incident_[i] + (escaped + absorbed) * power;
        if (rays_[i] > 0) {
            const Vec3 kept = (1 - escaped - absorbed) * power;
            part.leaving += power;
            part.one_ray += kept * power / rays_[i];
            part.loss_variance += power * power * variance_of_loss(i);
        }
    }
    /// Returns the variance of the share of a patch's rays that are lost. Where few are, each is
    /// lost by chance; of many well-distributed ones only those at the edge of an opening are.
    [[nodiscard]] double variance_of_loss(std::uint32_t i) const {
        constexpr double batches = BatchLight::batches;
        const double share = result_.factors.lost()[i].sum();
        const double of_batch = std::max(rays_[i] * std::min(share, 1 - share) / batches, 0.0);
        return batches * std::min(of_batch, std::sqrt(of_batch)) / (rays_[i] * rays_[i]);
    }
    [[nodiscard]] const PartLedger& ledger(std::uint32_t i) const { return ledgers_[parts_.of[i]]; }

    /// Returns the light that would be missing if three more rays of the part had been lost. All of
    /// the part has less light then, in proportion to what else takes light away. The mean of a
    /// Poisson distribution lies that far above any count besides the multiple of its standard
    /// deviation (Garwood 1936).
    [[nodiscard]] Vec3 missed_loss(std::uint32_t i) const {
        if (result_.system.closed())
            return Vec3(0.0);
        const PartLedger& part = ledger(i);
        const Vec3 share = rule_of_three * ratio_or_zero(part.one_ray, part.used);
        return share * rho_[i] * incident_[i];
    }

    /// Returns one standard error of the light, as all of a part is the brighter the less light is
    /// lost. It follows from the numbers of rays that were lost, however alike the batches may be
    /// by chance.
    [[nodiscard]] Vec3 known_loss(std::uint32_t i) const {
        if (result_.system.closed())
            return Vec3(0.0);
        const PartLedger& part = ledger(i);
        return ratio_or_zero(glm::sqrt(part.loss_variance), part.used) * rho_[i] * incident_[i];
    }

    /// Returns what a dark part would hold if rays had passed between it and a lit one. Neither the
    /// rays of the lit parts nor its own have found such a path.
    [[nodiscard]] Vec3 missed_light(std::uint32_t i) const {
        const PartLedger& part = ledger(i);
        if (!(part.rays > 0))
            return Vec3(0.0); // no light can reach it, by geometry
        const Vec3 by_own = rule_of_three * bright_radiosity_ * (part.area / part.rays);
        const Vec3 by_lit = rule_of_three * lit_one_ray_;
        const Vec3 power = ratio_or_zero(by_own * by_lit, by_own + by_lit);
        return rho_[i] * ratio_or_zero(power, part.absorbing);
    }

    /// Returns what a single random ray stands for, where light comes from: one of the patch's own
    /// rays, or of those that others of its part send.
    [[nodiscard]] Vec3 one_ray(std::uint32_t i) const {
        if (!(rays_[i] > 0))
            return Vec3(0.0);
        const double of_others = ledger(i).rays / ledger(i).area * area_[i];
        return rho_[i] * result_.rows.typical[i] / (rays_[i] + of_others);
    }
    [[nodiscard]] double shadow_rays_of(std::uint32_t i) const {
        return result_.direct.unblocked(i) > 0 ? double(result_.direct.samples(i)) : 0;
    }
    /// Returns the light that one shadow ray more or less would bring: through a gap that all have
    /// missed, or behind a thing that none has met.
    [[nodiscard]] Vec3 one_shadow_ray(std::uint32_t i) const {
        const double samples =
            double(result_.direct.samples(i)) * double(result_.direct.estimates());
        return samples > 0 ? rho_[i] * (result_.direct.unblocked(i) / samples) : Vec3(0.0);
    }

    const TransportResult& result_;
    std::span<const double> area_;
    std::span<const Vec3> rho_;
    std::span<const double> rays_;
    LinkedParts parts_;
    std::vector<PartLedger> ledgers_;
    std::vector<Vec3> incident_;
    std::vector<bool> lit_;
    Vec3 lit_one_ray_{0.0}, bright_radiosity_{0.0};
    std::vector<Vec3> missed_by_rays_;
};

/// Returns the factor by which a variance is raised. The standard error of a mean of a few samples
/// is poorly known. Where patches err independently it is pooled over neighbours. Where they err
/// together (0 to 1) that does not help. It is raised as Student's t asks for, so that hardly any
/// error is beyond three of them.
double raised(double together) {
    constexpr double of_few = 3; // of t with three degrees of freedom 96 of 100 are below 2 sqrt(3)
    return 1 + (of_few - 1) * together;
}

/// Measures how far a patch and its neighbours are off the mean in each batch.
class Window {
  public:
    void add(const std::array<Vec3, BatchLight::batches>& off) {
        for (std::size_t s = 0; s < off.size(); ++s) {
            sum_[s] += off[s];
            squares_ += glm::dot(off[s], off[s]);
        }
        ++count_;
    }
    /// Returns 1 where all err alike, 0 where each errs independently.
    [[nodiscard]] double together() const {
        if (count_ < 2 || !(squares_ > 0))
            return 1;
        double of_sum = 0;
        for (const Vec3& sum : sum_)
            of_sum += glm::dot(sum, sum);
        return std::clamp((of_sum / squares_ - 1) / (count_ - 1), 0.0, 1.0);
    }

  private:
    std::array<Vec3, BatchLight::batches> sum_{};
    double squares_ = 0, count_ = 0;
};

} // namespace

double weighted_area(const TransportResult& result, std::size_t patch) {
    return (result.weight.empty() ? 1 : result.weight[patch]) * result.system.area()[patch];
}

TransportErrors errors_of(const TransportResult& result, const Workers& workers) {
    constexpr double batches = BatchLight::batches;
    constexpr std::size_t patches_per_chunk = 512;
    const std::size_t n = result.system.area().size();
    TransportErrors errors;
    std::vector<Vec3> variance(n);
    std::vector<double> raise(n);
    workers.for_chunks(n, patches_per_chunk, [&](std::size_t begin, std::size_t end) {
        for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
            const Vec3 rho = result.system.reflectance()[i];
            Vec3 squares(0.0);
            const auto own = result.light.deviations(i);
            Window window;
            window.add(own);
            for (const Vec3& off : own)
                squares += off * off;
            for_alike_neighbours(result.mesh, i,
                                 [&](std::uint32_t j) { window.add(result.light.deviations(j)); });
            variance[i] = rho * rho * squares / (batches * (batches - 1));
            raise[i] = raised(window.together());
        }
    });
    for (std::size_t i = 0; i < n; ++i)
        errors.variance += weighted_area(result, i) * glm::dot(variance[i], Vec3(1.0));
    errors.standard_error = pooled_over_neighbours(result.mesh, variance);
    for (std::size_t i = 0; i < n; ++i)
        errors.standard_error[i] = glm::sqrt(raise[i] * errors.standard_error[i]);
    Account(result).add_missed(errors);
    return errors;
}

} // namespace hemilux
