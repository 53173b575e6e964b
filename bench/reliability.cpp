// How far the errors that methods report can be trusted: a row for each hard scene
// (tests/support/families) and method, over many seeds.
//
//     hemilux_reliability --family lamp --method stored-transport --seeds 40

#include "support/families/reliability.h"
#include "app/command_line/option_kinds.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

using namespace hemilux;
using namespace hemilux::test;

namespace {

struct Settings {
    std::vector<std::string> families, scenes;
    std::vector<std::string> methods{"stored-transport"};
    std::size_t seeds = 40;
    std::uint64_t first_seed = 1;
    std::optional<double> error;
    RunLimits limits;
    unsigned threads = 0;
    bool list = false, every_run = false;
};

/// Without parts every text does.
bool contains_one(const std::string& text, const std::vector<std::string>& parts) {
    return parts.empty() || std::ranges::any_of(parts, [&](const std::string& part) {
               return text.find(part) != std::string::npos;
           });
}

double percent(std::size_t part, std::size_t all) {
    return all > 0 ? 100 * double(part) / double(all) : std::numeric_limits<double>::quiet_NaN();
}

constexpr const char* explanation =
    "runs   how many, of which were ended by the limits (lim) or refused (ref)\n"
    "wrong  true error more than 1.5 times the reported one; unkn: the reported one is NaN or "
    "infinite\n"
    "part   runs in which the mean of a part is off by more than 3 standard errors; unkn: NaN\n"
    "in2 in3  % of values within 2 and 3 standard errors, patches with 30 hits; few2: those with "
    "fewer, within 2\n"
    "true, rep.  median errors [%], ratio: of their RMS; bias: of the reflected power [%]\n";

void print_head() {
    std::printf("%-52s %-11s %4s %3s %3s %5s %4s %5s %4s %6s %6s %6s %8s %8s %7s %8s %9s %7s\n",
                "scene", "method", "runs", "lim", "ref", "wrong", "unkn", "part", "unkn", "in2",
                "in3", "few2", "true", "rep.", "ratio", "bias", "rays", "s");
}

void print_row(const HardSceneEntry& entry, const Method& method, const Reliability& r) {
    std::printf(
        "%-52s %-11s %4zu %3zu %3zu %5zu %4zu %5zu %4zu %6.1f %6.1f %6.1f %8.3g %8.3g %7.3g "
        "%+8.2g %9.3g %7.2g\n",
        (entry.family + ": " + entry.name).c_str(), std::string(method.name).c_str(), r.runs,
        r.stopped, r.refused, r.wrong, r.unknown, r.parts_wrong, r.parts_unknown,
        percent(r.often.within_2, r.often.count), percent(r.often.within_3, r.often.count),
        percent(r.seldom.within_2, r.seldom.count), 100 * r.median_true, 100 * r.median_reported,
        r.rms_ratio, 100 * r.bias, r.median_rays, r.median_seconds);
    std::fflush(stdout);
}

void print_run(std::uint64_t seed, const JudgedRun& run) {
    std::printf(
        "  seed %llu: true %.4g %%, reported %.4g %%, bias %+.3g %%, %.3g rays, %.2g s%s%s%s%s\n",
        static_cast<unsigned long long>(seed), 100 * run.true_error, 100 * run.reported,
        100 * run.bias, double(run.rays), run.seconds, run.wrong ? ", wrong" : "",
        run.part_wrong ? ", part wrong" : "", run.stopped ? ", limited" : "",
        run.refused ? ", refused" : "");
}

void judge_scene(const HardSceneEntry& entry, const Settings& settings) {
    const PreparedScene scene(hard_scene(entry));
    for (const std::string& name : settings.methods) {
        const Method& method = *find_method(name);
        std::vector<JudgedRun> runs;
        for (std::size_t k = 0; k < settings.seeds; ++k) {
            runs.push_back(judge_run(scene, method, stop_rule(method, settings.error),
                                     settings.first_seed + k, settings.threads, settings.limits));
            if (settings.every_run)
                print_run(settings.first_seed + k, runs.back());
        }
        print_row(entry, method, summary(runs));
    }
}

template <class Whole>
void add_count(Command command, const std::string& name, Whole& target, const std::string& help) {
    add_whole(command, name, target, 0, std::numeric_limits<Whole>::max(), help);
}

void add_options(Command command, Settings& settings) {
    command
        .add_texts("--family", "NAME,...", settings.families,
                   "only families whose name contains one of these")
        .separated_by(',');
    command.add_texts("--scene", "NAME", settings.scenes,
                      "only scenes whose name contains one of these; names may contain commas");
    command.add_texts("--method", "NAME,...", settings.methods, "one or several; all: all of them")
        .separated_by(',');
    add_count(command, "--seeds", settings.seeds, "runs of each scene and method");
    add_count(command, "--first-seed", settings.first_seed, "the others follow it");
    add_number(command, "--error", "X", settings.error, positive,
               "reported error to stop at; else the method's own stop");
    add_count(command, "--most-rays", settings.limits.rays, "of a run");
    add_number(command, "--seconds", "S", settings.limits.seconds, positive, "of a run, at most");
    add_count(command, "--threads", settings.threads, "0: all cores");
    command.add_flag("--list", settings.list, "only names the scenes");
    command.add_flag("--every-run", settings.every_run, "a line for each run too");
}

/// False where --help was asked for, which is then printed.
bool read_arguments(int count, char** words, Settings& settings) {
    Arguments arguments("hemilux_reliability",
                        "Compares the errors that methods report with the true ones.");
    add_options(arguments.program(), settings);
    arguments.program().end_help_with(explanation);
    const std::string help = arguments.parse({words + 1, words + count});
    std::fputs(help.c_str(), stdout);
    return help.empty();
}

} // namespace

int main(int count, char** arguments) {
    Settings settings;
    try {
        if (!read_arguments(count, arguments, settings))
            return 0;
    } catch (const UsageError& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    if (settings.methods == std::vector<std::string>{"all"}) {
        settings.methods.clear();
        for (const Method* const method : methods())
            settings.methods.emplace_back(method->name);
    }
    for (const std::string& name : settings.methods)
        if (!find_method(name)) {
            std::fprintf(stderr, "there is no method '%s'\n", name.c_str());
            return 1;
        }
    if (!settings.list)
        print_head();
    for (const HardSceneEntry& entry : hard_scenes())
        if (contains_one(entry.family, settings.families) &&
            contains_one(entry.name, settings.scenes)) {
            if (settings.list)
                std::printf("%s: %s\n", entry.family.c_str(), entry.name.c_str());
            else
                judge_scene(entry, settings);
        }
    return 0;
}
