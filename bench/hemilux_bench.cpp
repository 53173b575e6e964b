// How fast rays are traced, on the rays that solvers shoot, and beside Embree where it was found.
//
//     hemilux_bench [SCENE.obj ...] [--json FILE] [--rays N] [--rounds N] [--only TEXT]
//
// Without scenes six are made: a Cornell box and a cluttered room at three finenesses. One thread,
// CPU time, Embree and hemilux in turn, the fastest of the rounds. Both get the same rays in the
// same order: `shuffled`, or `sorted` by patch and direction. Of Embree's ways to trace them the
// fastest is taken (single rays, packets of 4, 8 and 16, streams; either coherence flag; medium and
// high quality; quads as quads or as two triangles), which a few rounds find out before the race;
// `robust` is the fastest of its watertight mode. `shadow`: whether anything lies between two
// points; hemilux leaves out the facets of both, as solvers do. `count`: all facets on each ray, of
// Embree by filters that refuse them, where their counts agree. `build` is beside its medium
// quality. Embree may use the instruction set that hemilux uses, which HEMILUX_KERNELS chooses, and
// which each row names.
#include "bvh/wide/wide_bvh.h"
#include "io/scene_files/obj.h"
#include "rays.h"
#include "scenes.h"
#include "timed_rounds.h"
#if defined(HEMILUX_EMBREE)
#include "embree_scene.h"
#endif

#include <algorithm>
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
    double hemilux, embree = 0, robust = 0; ///< millions per second; 0: not measured
    std::string way = {};                   ///< the fastest of Embree's
    std::string_view isa = name_of(chosen_instruction_set()); ///< of both
    [[nodiscard]] double ratio() const { return embree > 0 ? hemilux / embree : 0; }
};

class Report {
  public:
    void add(const Row& row) {
        std::printf("%-22s %-9s %6zu %10.3f %10.3f %10.3f %7.2f  %-8s %s\n", row.scene.c_str(),
                    row.work.c_str(), row.rays_per_patch, row.hemilux, row.embree, row.robust,
                    row.ratio(), std::string(row.isa).c_str(), row.way.c_str());
        std::fflush(stdout);
        rows_.push_back(row);
    }
    void print_means() const {
        std::printf("\n%-12s %8s %8s\n", "work", "mean", "worst");
        for (const char* work : {"shuffled", "sorted", "shadow", "count", "build"}) {
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
                << r.work << "\", \"instructions\": \"" << r.isa
                << "\", \"rays_per_patch\": " << r.rays_per_patch
                << ", \"hemilux_mrays_s\": " << r.hemilux << ", \"embree_mrays_s\": " << r.embree
                << ", \"embree_robust_mrays_s\": " << r.robust << ", \"embree_way\": \"" << r.way
                << "\", \"ratio\": " << r.ratio() << "}";
        }
        out << "\n]\n";
        if (!out.flush())
            throw std::runtime_error("cannot write " + path);
    }

  private:
    std::vector<Row> rows_;
};

double millions(std::size_t n, double seconds) { return 1e-6 * double(n) / seconds; }

#if defined(HEMILUX_EMBREE)
/// Embree's rays start at this t, in place of leaving out the facet that a ray starts on.
constexpr float start_of_theirs = 1e-6f;

/// Embree's scenes over the same facets, and its ways to trace rays in them.
class Rival {
  public:
    Rival(const FacetSoup& soup, bool robust, RTCFilterFunctionN filter = nullptr) {
        const bool has_quads =
            std::ranges::any_of(soup.facets, [](const FacetCorners& c) { return c[2] != c[3]; });
        for (const bool high : {false, true})
            for (const bool quads : {false, true})
                if (has_quads || !quads)
                    scenes_.push_back(
                        {(high ? "high" : "medium") + std::string(quads ? ", quads" : ""),
                         std::make_unique<EmbreeScene>(soup,
                                                       EmbreeBuild{robust, high, quads, filter})});
    }

    struct Way {
        const EmbreeScene* scene;
        EmbreeQuery query;
        std::string name;
    };
    /// The fastest of `queries` in any of the scenes. Ways to count are taken only where they agree
    /// with the first.
    [[nodiscard]] Way fastest(std::span<const EmbreeQuery> queries, const EmbreeRays& rays,
                              bool counts) const {
        std::vector<Way> ways;
        std::vector<std::uint32_t> out(rays.rays.size()), first;
        for (const auto& [name, scene] : scenes_)
            for (const EmbreeQuery& query : queries) {
                if (counts) {
                    embree_trace(*scene, query, rays, out);
                    if (first.empty())
                        first = out;
                    if (agreement(first, out) < .9999)
                        continue;
                }
                ways.push_back({scene.get(), query, name_of(query) + ", " + name});
            }
        std::vector<std::function<void()>> races;
        for (const Way& way : ways)
            races.push_back([&] { embree_trace(*way.scene, way.query, rays, out); });
        constexpr int rounds = 3;
        const auto seconds = fastest_of_rounds(races, rounds);
        return ways[std::size_t(std::ranges::min_element(seconds) - seconds.begin())];
    }

    static double agreement(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
        std::size_t same = 0;
        for (std::size_t k = 0; k < a.size(); ++k)
            same += a[k] == b[k];
        return double(same) / double(a.size());
    }

  private:
    struct Built {
        std::string name;
        std::unique_ptr<EmbreeScene> scene;
    };
    std::vector<Built> scenes_;
};

std::vector<EmbreeQuery> all_queries(bool occluded) {
    using By = EmbreeQuery::By;
    std::vector<EmbreeQuery> queries{{By::one, false, occluded}};
    for (const By by : {By::packets_of_4, By::packets_of_8, By::packets_of_16, By::streams})
        for (const bool coherent : {false, true})
            queries.push_back({by, coherent, occluded});
    return queries;
}

/// Without the coherent flag, with which packets that are refused count some facets twice.
std::vector<EmbreeQuery> counting_queries() {
    using By = EmbreeQuery::By;
    std::vector<EmbreeQuery> queries;
    for (const bool occluded : {false, true})
        for (const By by :
             {By::one, By::packets_of_4, By::packets_of_8, By::packets_of_16, By::streams})
            queries.push_back({by, false, occluded});
    return queries;
}
#endif

/// One scene: all works.
class Course {
  public:
    Course(std::string name, Scene scene, const Settings& settings, Report& report)
        : name_(std::move(name)), mesh_(std::move(scene)), soup_(mesh_.soup()), settings_(settings),
          report_(report) {
        bvh_ = std::make_unique<WideBvh>(soup_, WideBvhOptions{.threads = 1});
    }

    void run() {
        print_head();
        if (wanted("build"))
            build();
        const RaySet many = make_rays(mesh_, 1024, settings_.rays);
        if (wanted("shuffled"))
            closest("shuffled", many.shuffled);
        if (wanted("sorted"))
            closest("sorted", many.sorted);
        if (wanted("shadow"))
            shadow(make_shadow_rays(mesh_, many));
        if (wanted("count"))
            count(make_rays(mesh_, 64, settings_.rays).sorted);
        if (wanted("agreement"))
            agreement(many);
    }

  private:
    [[nodiscard]] bool wanted(const char* work) const {
        return settings_.only.empty() || std::string(work).find(settings_.only) == 0;
    }

    void print_head() const {
        const auto facets = static_cast<double>(soup_.facets.size());
        const BvhQuality& q = bvh_->quality();
        std::printf("%s: %zu facets, %.1f bytes each (%s), depth %d", name_.c_str(),
                    soup_.facets.size(), double(q.bytes) / facets,
                    std::string(name_of(chosen_instruction_set())).c_str(), q.depth);
#if defined(HEMILUX_EMBREE)
        std::printf("; Embree %.1f bytes", double(EmbreeScene(soup_, {}).bytes()) / facets);
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
            for (const bool quads : {false, true})
                theirs = std::min(theirs, EmbreeScene(soup_, {.quads = quads}).build_seconds());
#endif
        }
        const std::size_t n = soup_.facets.size();
        report_.add(
            {name_, "build", 0, millions(n, ours), theirs < 1e300 ? millions(n, theirs) : 0});
    }

    void closest(const char* work, std::span<const Ray> rays) const {
        std::vector<FacetHit> hits(rays.size());
        std::vector<std::function<void()>> variants{[&] { bvh_->closest_stream(rays, hits); }};
        std::string way;
#if defined(HEMILUX_EMBREE)
        const EmbreeRays theirs(rays, start_of_theirs);
        const auto queries = all_queries(false);
        const Rival fast(soup_, false), robust(soup_, true);
        std::vector<std::uint32_t> out(rays.size());
        const Rival::Way best = fast.fastest(queries, theirs, false),
                         sure = robust.fastest(queries, theirs, false);
        for (const Rival::Way* const one : {&best, &sure})
            variants.push_back([&, one] { embree_trace(*one->scene, one->query, theirs, out); });
        way = best.name;
#endif
        add(work, 1024, rays.size(), fastest_of_rounds(variants, settings_.rounds), way);
    }

    void shadow(const ShadowRaySet& set) const {
        const auto& [rays, targets] = set;
        std::vector<std::uint8_t> blocked(rays.size());
        std::vector<std::function<void()>> variants{
            [&] { bvh_->occluded_stream(set.rays, set.targets, blocked); }};
        std::string way;
#if defined(HEMILUX_EMBREE)
        const EmbreeRays theirs(rays, start_of_theirs);
        const auto queries = all_queries(true);
        const Rival fast(soup_, false), robust(soup_, true);
        std::vector<std::uint32_t> out(rays.size());
        const Rival::Way best = fast.fastest(queries, theirs, false),
                         sure = robust.fastest(queries, theirs, false);
        for (const Rival::Way* const one : {&best, &sure})
            variants.push_back([&, one] { embree_trace(*one->scene, one->query, theirs, out); });
        way = best.name;
#endif
        add("shadow", 1024, rays.size(), fastest_of_rounds(variants, settings_.rounds), way);
#if defined(HEMILUX_EMBREE)
        const std::vector<std::uint32_t> ours(blocked.begin(), blocked.end());
        std::printf("%-22s same shadows as Embree (robust): %.4f %%\n", name_.c_str(),
                    100 * Rival::agreement(ours, out));
#endif
    }

    void count(std::span<const Ray> rays) const {
        std::vector<std::uint32_t> pierced(rays.size());
        std::vector<std::function<void()>> variants{[&] { bvh_->count_stream(rays, pierced); }};
        std::string way;
#if defined(HEMILUX_EMBREE)
        const EmbreeRays theirs(rays, 0);
        const Rival rival(soup_, false, counting_filter);
        std::vector<std::uint32_t> out(rays.size());
        const Rival::Way best = rival.fastest(counting_queries(), theirs, true);
        variants.push_back([&] { embree_trace(*best.scene, best.query, theirs, out); });
        way = best.name;
#endif
        add("count", 64, rays.size(), fastest_of_rounds(variants, settings_.rounds), way);
#if defined(HEMILUX_EMBREE)
        std::printf("%-22s same counts as Embree's filter: %.4f %%\n", name_.c_str(),
                    100 * Rival::agreement(pierced, out));
#endif
    }

    void add(const char* work, std::size_t per_patch, std::size_t n,
             const std::vector<double>& seconds, const std::string& way) const {
        const auto rate = [&](std::size_t k) {
            return k < seconds.size() ? millions(n, seconds[k]) : 0;
        };
        report_.add({name_, work, per_patch, rate(0), rate(1), rate(2), way});
    }

    void agreement([[maybe_unused]] const RaySet& set) const {
#if defined(HEMILUX_EMBREE)
        const EmbreeScene robust(soup_, {.robust = true, .filter = starting_facet_filter});
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
        if (word == "--help")
            throw std::runtime_error("arguments are [SCENE.obj ...] [--json FILE] [--rays N] "
                                     "[--rounds N] [--only TEXT]");
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
    std::printf("%-22s %-9s %6s %10s %10s %10s %7s  %-8s %s\n", "scene", "work", "rays", "hemilux",
                "embree", "robust", "ratio", "both use", "Embree's way");
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
