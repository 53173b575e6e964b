#pragma once
// The means by which a caller follows work and ends it early: a program draws bars by it and writes
// pictures between steps, a page shows how far it is. Answers do not depend on it.

#include "radiosity/answers/asked/finding.h"

#include <atomic>
#include <memory>
#include <string>
#include <utility>

namespace hemilux {

class Watcher {
  public:
    virtual ~Watcher() = default;

    /// A stage of the work, which lasts as long as this object.
    class Stage {
      public:
        virtual ~Stage() = default;
    };
    /// Begins a stage of this name. `share` says how much of it is done, from 0 to 1, where that is
    /// known; it outlives the stage.
    [[nodiscard]] virtual std::unique_ptr<Stage> begin(const std::string& /*name*/,
                                                       const std::atomic<double>* /*share*/) {
        return nullptr;
    }
    /// Takes what there is to say while the work goes on.
    virtual void take(const Finding& /*finding*/) {}

    void tell(Finding::Kind kind, std::string text) { take({kind, std::move(text)}); }
};

} // namespace hemilux
