#pragma once
// Loops over several threads whose result does not depend on their number. The caller writes to a
// place of its own for each index or chunk and sums in order, afterwards or meanwhile. Helping
// threads are started when they are first needed and then wait for more until the program ends.

#include "parallel/function_ref.h"

#include <cstddef>

namespace hemilux {

/// Calls work() on this thread and on up to `helpers` others, as far as these have nothing else to
/// do, and returns when all calls have returned. work() must not throw. Each call of it must handle
/// what the others leave, as perhaps no thread comes to help. work_together may be used from
/// several threads, and from within work() itself.
void work_together(std::size_t helpers, FunctionRef<void()> work);

class Workers {
  public:
    /// Uses this many threads; 0: one per core.
    explicit Workers(unsigned threads);

    [[nodiscard]] unsigned threads() const { return threads_; }

    /// Starts the helping threads while there is something else to do. Otherwise the first loop
    /// would wait until the system finds a processor for each.
    void start() const;

    /// Calls body(begin, end) for consecutive chunks of [0, count), each exactly once, on any
    /// thread. Rethrows the first exception of a body.
    void for_chunks(std::size_t count, std::size_t chunk,
                    FunctionRef<void(std::size_t begin, std::size_t end)> body) const;

    /// Does the same with body(own, begin, end): each thread that takes part keeps what make()
    /// gives it, for all of its chunks.
    template <class Make, class Body>
    void for_chunks_with(std::size_t count, std::size_t chunk, const Make& make,
                         const Body& body) const {
        for_takers(count, chunk, [&](TakeChunk take) {
            Chunk next{};
            if (!take(next))
                return;
            auto own = make();
            do
                body(own, next.begin, next.end);
            while (take(next));
        });
    }

    /// Calls body(k) for each k in [0, count) on any thread, and take(k) once body(k) has returned.
    /// The calls of take come in the order of k, never two at a time, while others go on with their
    /// bodies.
    void for_each_in_order(std::size_t count, FunctionRef<void(std::size_t)> body,
                           FunctionRef<void(std::size_t)> take) const;

  private:
    struct Chunk {
        std::size_t begin, end;
    };
    /// Sets the next chunk; false where none is left.
    using TakeChunk = FunctionRef<bool(Chunk& next)>;

    /// Calls body on threads that take all chunks.
    void for_takers(std::size_t count, std::size_t chunk, FunctionRef<void(TakeChunk)> body) const;

    unsigned threads_;
};

} // namespace hemilux
