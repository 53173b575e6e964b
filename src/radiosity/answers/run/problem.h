#pragma once
// What a run solves: a mesh, and what is found of it before light is sent.

#include "radiosity/answers/asked/watcher.h"
#include "radiosity/answers/run/target.h"
#include "radiosity/engine/rays/make_tracer.h"
#include "radiosity/paper/scene/mesh.h"
#include "radiosity/paper/scene/needs.h"

#include <memory>
#include <string>
#include <vector>

namespace hemilux {

struct Problem {
    std::shared_ptr<Mesh> mesh;
    std::shared_ptr<const Tracer> tracer; ///< of the mesh, also where its patches are divided
    BvhQuality tree = {};                 ///< MadeTracer
    bool keep_all = false;                ///< nothing is left out (SolveOptions::keep_all)
    unsigned threads = 0;                 ///< 0: one per core; nothing found depends on it
    Needs needs = {};
    RunTarget target = {};
    std::vector<double> weights = {}; ///< of patches for the target; empty: all alike

    /// Sets what the run is for.
    void aim_at(RunTarget aim);
    /// Finds the needs and the weights again, once patches were divided.
    void find_again();
};

/// What is chosen of how a problem is prepared, as of SolveOptions.
struct ProblemChoices {
    bool keep_all = false;
    unsigned threads = 0;
};

/// Finds what solving needs besides the mesh; takes over what was made for it already. The watcher
/// is told where rays will be slow.
[[nodiscard]] Problem prepare(std::shared_ptr<Mesh> mesh, MadeTracer made,
                              const ProblemChoices& choices, Watcher& watcher);
/// Does the same where there is a tracer of the mesh.
[[nodiscard]] Problem prepare(std::shared_ptr<Mesh> mesh, std::shared_ptr<const Tracer> tracer,
                              const ProblemChoices& choices);

/// Returns what makes rays slow, and how to mend it; empty where nothing does.
[[nodiscard]] std::string crowd_text(const Crowd& crowd, const Mesh& mesh);

} // namespace hemilux
