#pragma once
// Finds the factors of all pairs of patches that see each other, each with its error.
//
// 1. Rays of each patch find who sees whom, and how much of the view is sky and ground. Rays
//    between pairs that face each other look for what these missed.
// 2. A factor far below what counts is the free one times the share of a few rays that arrive.
// 3. Every other pair is exact where nothing lies between, and else estimated by lines
//    (hidden_exchange.h).

#include "bvh/wide/wide_bvh.h"
#include "parallel/workers.h"
#include "radiosity/engine/factors/pairs/free_pairs.h"
#include "radiosity/engine/factors/rows/exchange_list.h"
#include "radiosity/engine/factors/rows/measured_rows.h"

#include <cstdint>
#include <functional>
#include <span>

namespace hemilux {

class Mesh;
class SkyBands;
struct Monitor;

/// This says which standard error a factor may have.
struct FactorTolerance {
    double least; ///< that any pair may have which exchanges nothing [-]
    /// `larger` is the larger of the two factors of a pair [-], `smaller_index` and `larger_index`
    /// are its patches.
    std::function<double(std::uint32_t smaller_index, std::uint32_t larger_index, double larger)>
        of;
};

/// Asks for a relative error `error` of factors above `least`. Those below may have five times the
/// absolute error of `least`, and less the nearer they are to it.
[[nodiscard]] FactorTolerance relative_above(double error, double least);

struct ExchangeOptions {
    std::uint32_t rays = 1024; ///< from each patch; a power of two, 256 at least
    FactorTolerance tolerance = relative_above(.01, 1e-3);
    std::uint64_t seed = 1;
    int up = 2;                      ///< axis that points to the sky
    const SkyBands* bands = nullptr; ///< parts of the sky, if they are asked for
    /// The free pairs of the mesh: if they are given, those that are clear are left out of the
    /// list, and all others are in it, each right on average whether rays of its patches met the
    /// other or not. So the mean over seeds is right, and what few rays find of a pair may be far
    /// off.
    const FreePairs* free_pairs = nullptr;
    /// Traces light through the panes of the scene; null: panes do not count.
    const Tracer* through_panes = nullptr;
    /// Tolerances of passes over all pairs before that of `tolerance`, as multiples of it: what the
    /// end of the time leaves of the last pass is as exact as the one before.
    std::vector<double> before = {};
    /// Is called as rows are found, from all threads, with the bytes that the pairs found so far
    /// will take at the peak of summing and writing them. What it throws ends the work.
    std::function<void(double bytes)> ask = {};
    /// Is called before rows are measured. It may fill in those that another run with the same
    /// options measured; these are not measured again.
    std::function<void(std::span<MeasuredRow>)> load = {};
    /// Is called from one thread after every few hundred rows, and at last when no more will be
    /// measured.
    std::function<void(std::span<const MeasuredRow>, bool is_last)> keep = {};
};

/// The work that all took.
struct ExchangeWork : PairWork {
    /// Patches whose pairs of higher index are less exact than they should be, as the time was over
    /// or the run was interrupted.
    std::uint64_t rows_left = 0;
};

struct FoundExchange {
    ExchangeList list;
    ExchangeWork work;
    bool is_void = false;
};

/// When the monitor's time ends or it is interrupted, pairs that were not reached keep what the
/// pass before found, or what the rays of both patches say of them. The result is void if an
/// interrupt came before all rays were traced. But for these it has the same bytes for any number
/// of threads. The tree must be that of the mesh.
[[nodiscard]] FoundExchange find_exchange(const Mesh& mesh, const WideBvh& tree,
                                          const ExchangeOptions& options, const Workers& workers,
                                          Monitor& monitor);

} // namespace hemilux
