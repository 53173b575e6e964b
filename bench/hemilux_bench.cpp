// How fast rays are traced, on the rays that solvers shoot, and beside Embree where it was found.
//
//     hemilux_bench [SCENE.obj ...] [--json FILE] [--rays N] [--rounds N] [--only TEXT]
//
// Without scenes six are made: a Cornell box and a cluttered room at three finenesses. One thread,
// CPU time, Embree and hemilux in turn, the fastest of the rounds. `ratio` is to Embree's
// rtcIntersect1 on the same rays in random order; of `count` to the best of Embree's ways to count
// exactly; of `build` to its medium quality.
#include "bvh/wide/wide_bvh.h"
#include "io/scene_files/obj.h"
#include "rays.h"
#include "scenes.h"
#include "timed_rounds.h"
#if defined(HEMILUX_EMBREE)
#include "embree_scene.h"
#endif

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>

using namespace hemilux;
using namespace hemilux::bench;

namespace {

struct Settings {
    std::vector<std::string> files;
    std::string json, only;
    std::size_t rays = 1 << 18;
    int rounds = 15;
};

struct Row {
    std::string scene, work;
    std::size_t rays_per_patch;
    double hemilux, embree; ///< millions per second; 0: not measured
    [[nodiscard]] double ratio() const { return embree > 0 ? hemilux / embree : 0; }
};

class Report {
  public:
    void add(const Row& row) {
        std::printf("%-22s %-12s %6zu %10.3f %10.3f %7.2f\n", row.scene.c_str(), row.work.c_str(),
                    row.rays_per_patch, row.hemilux, row.embree, row.ratio());
        std::fflush(stdout);
        rows_.push_back(row);
    }
    void print_means() const {
        std::printf("\n%-12s %8s %8s\n", "work", "mean", "worst");
        for (const char* work : {"independent", "count", "build"}) {
            double sum = 0, worst = INFINITY;
            int n = 0;
            for (const Row& row : rows_)
                if (row.work == work && row.ratio() > 0) {
                    sum += std::log(row.ratio());
                    worst = std::min(worst, row.ratio());
                    ++n;
                }
            if (n > 0)
                std::printf("%-12s %8.2f %8.2f\n", work, std::exp(sum / n), worst);
        }
    }
    void write(const std::string& path) const {
        std::ofstream out(path);
        out << "[";
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            const Row& r = rows_[i];
            out << (i ? ",\n " : "\n ") << "{\"scene\": \"" << r.scene << "\", \"work\": \""
                << r.work << "\", \"rays_per_patch\": " << r.rays_per_patch
                << ", \"hemilux_mrays_s\": " << r.hemilux << ", \"embree_mrays_s\": " << r.embree
                << ", \"ratio\": " << r.ratio() << "}";
        }
        out << "\n]\n";
        if (!out.flush())
            throw std::runtime_error("cannot write " + path);
    }

  private:
    std::vector<Row> rows_;
};

double millions(std::size_t n, double seconds) { return 1e-6 * double(n) / seconds; }

/// One scene: all works.
class Course {
  public:
    Course(std::string name, Scene scene, const Settings& settings, Report& report)
        : name_(std::move(name)), mesh_(std::move(scene)), soup_(mesh_.soup()), settings_(settings),
          report_(report) {
        bvh_ = std::make_unique<WideBvh>(soup_, WideBvhOptions{.threads = 1});
#if defined(HEMILUX_EMBREE)
        embree_ = std::make_unique<EmbreeScene>(soup_, false);
#endif
    }

    void run() {
        print_head();
        if (wanted("build"))
            build();
        const RaySet many = make_rays(mesh_, 1024, settings_.rays);
        if (wanted("independent"))
            independent(many);
        if (wanted("count"))
            count(make_rays(mesh_, 64, settings_.rays));
        if (wanted("agreement"))
            agreement(many);
    }

  private:
    [[nodiscard]] bool wanted(const char* work) const {
        return settings_.only.empty() || std::string(work).find(settings_.only) == 0;
    }

    void print_head() const {
        const auto triangles = static_cast<double>(soup_.facets.size());
        const BvhQuality& q = bvh_->quality();
        std::printf("%s: %zu facets, %.1f bytes each (%s), depth %d", name_.c_str(),
                    soup_.facets.size(), double(q.bytes) / triangles,
                    std::string(bvh_->kernels()).c_str(), q.depth);
#if defined(HEMILUX_EMBREE)
        std::printf("; Embree %.1f bytes", double(embree_->bytes()) / triangles);
#endif
        std::printf("\n");
    }

    void build() const {
        double ours = 1e300, theirs = 1e300;
        for (int r = 0; r < 3; ++r) {
            const double start = cpu_seconds();
            const WideBvh bvh(soup_, {.threads = 1});
            ours = std::min(ours, cpu_seconds() - start);
#if defined(HEMILUX_EMBREE)
            theirs = std::min(theirs, EmbreeScene(soup_, false).build_seconds());
#endif
        }
        const std::size_t n = soup_.facets.size();
        report_.add(
            {name_, "build", 0, millions(n, ours), theirs < 1e300 ? millions(n, theirs) : 0});
    }

    /// Against Embree's single rays.
    void independent(const RaySet& set) const {
        std::vector<FacetHit> hits(set.shuffled.size());
        std::vector<std::function<void()>> variants{
            [&] { bvh_->closest_stream(set.shuffled, hits); }};
#if defined(HEMILUX_EMBREE)
        std::vector<std::uint32_t> theirs(set.shuffled.size());
        variants.push_back([&] { embree_closest(*embree_, set.shuffled, theirs); });
#endif
        const auto seconds = fastest_of_rounds(variants, settings_.rounds);
        const std::size_t n = set.shuffled.size();
        report_.add({name_, "independent", 1024, millions(n, seconds[0]),
                     seconds.size() > 1 ? millions(n, seconds[1]) : 0});
    }

    void count(const RaySet& set) const {
        const std::vector<Ray>& sorted = set.sorted;
        std::vector<std::uint32_t> pierced(sorted.size());
        std::vector<std::function<void()>> variants{[&] {
            for (std::size_t k = 0; k < sorted.size(); ++k)
                pierced[k] = bvh_->count(sorted[k]);
        }};
#if defined(HEMILUX_EMBREE)
        const EmbreeScene counting(soup_, false, counting_filter);
        std::vector<std::uint32_t> theirs(sorted.size());
        for (const CountBy by : {CountBy::intersect1, CountBy::occluded1, CountBy::intersect16})
            variants.push_back([&, by] { embree_count(counting, by, sorted, theirs); });
#endif
        const auto seconds = fastest_of_rounds(variants, settings_.rounds);
        const double best =
            seconds.size() > 1 ? *std::min_element(seconds.begin() + 1, seconds.end()) : 0;
        report_.add({name_, "count", 64, millions(pierced.size(), seconds[0]),
                     best > 0 ? millions(pierced.size(), best) : 0});
#if defined(HEMILUX_EMBREE)
        std::size_t same = 0;
        embree_count(counting, CountBy::intersect1, sorted, theirs);
        for (std::size_t k = 0; k < theirs.size(); ++k)
            same += theirs[k] == pierced[k];
        std::printf("%-22s same counts as Embree's filter: %.4f %%\n", name_.c_str(),
                    100 * double(same) / double(theirs.size()));
#endif
    }

    void agreement([[maybe_unused]] const RaySet& set) const {
#if defined(HEMILUX_EMBREE)
        const EmbreeScene robust(soup_, true, starting_facet_filter);
        std::vector<FacetHit> hits(set.shuffled.size());
        bvh_->closest_stream(set.shuffled, hits);
        std::size_t same = 0, ties = 0, neither = 0;
        for (std::size_t k = 0; k < hits.size(); ++k) {
            const Ray& ray = set.shuffled[k];
            const EmbreeHit theirs = embree_robust_hit(robust, ray);
            const bool equal = theirs.facet == hits[k].facet;
            same += equal;
            if (equal)
                continue;
            const bool tie = theirs.facet != none && hits[k].facet != none &&
                             std::abs(bvh_->locate(ray, hits[k].facet).t - double(theirs.t)) < 1e-5;
            (tie ? ties : neither) += 1;
        }
        std::printf("%-22s same facet as Embree (robust): %.4f %%, at the same distance %zu, "
                    "else %zu of %zu\n",
                    name_.c_str(), 100 * double(same) / double(hits.size()), ties, neither,
                    hits.size());
#endif
    }

    std::string name_;
    Mesh mesh_;
    FacetSoup soup_;
    const Settings& settings_;
    Report& report_;
    std::unique_ptr<WideBvh> bvh_;
#if defined(HEMILUX_EMBREE)
    std::unique_ptr<EmbreeScene> embree_;
#endif
};

Settings read_settings(int argc, char** argv) {
    Settings settings;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const auto value = [&] {
            if (++i == argc)
                throw std::runtime_error(word + " needs a value");
            return std::string(argv[i]);
        };
        if (word == "--json")
            settings.json = value();
        else if (word == "--rays")
            settings.rays = std::stoul(value());
        else if (word == "--rounds")
            settings.rounds = std::stoi(value());
        else if (word == "--only")
            settings.only = value();
        else
            settings.files.push_back(word);
    }
    return settings;
}

} // namespace

int main(int argc, char** argv) try {
    const Settings settings = read_settings(argc, argv);
    Report report;
    std::printf("%-22s %-12s %6s %10s %10s %7s\n", "scene", "work", "rays", "hemilux", "embree",
                "ratio");
    for (const std::string& file : settings.files)
        Course(file, read_obj(file).scene, settings, report).run();
    if (settings.files.empty())
        for (const std::uint32_t n : {8u, 44u, 236u})
            Course("cornell-" + std::to_string(18 * n * n), cornell_box(n), settings, report).run();
    if (settings.files.empty())
        for (const std::uint32_t n : {8u, 46u, 162u})
            Course("clutter-" + std::to_string(54 * n * n), cluttered_room(n), settings, report)
                .run();
    report.print_means();
    if (!settings.json.empty())
        report.write(settings.json);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "hemilux_bench: %s\n", error.what());
    return 2;
}
