#pragma once
// An array of plain values for random access over many megabytes: it asks for huge pages, without
// which a third of the time goes into looking up addresses.

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

namespace hemilux {

/// Asks the system to hold this memory in huge pages; it may refuse.
void advise_huge_pages(void* memory, std::size_t bytes);

template <class T>
class HugeArray {
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    HugeArray() = default;
    /// Allocates the array; the values are not initialised.
    explicit HugeArray(std::size_t size) : size_(size) {
        if (size == 0)
            return;
        const std::size_t page = bytes() >= huge_page ? huge_page : alignof(T);
        const std::size_t whole = (bytes() + page - 1) / page * page;
        data_.reset(static_cast<T*>(std::aligned_alloc(page, whole)));
        if (!data_)
            throw std::bad_alloc();
        if (page == huge_page)
            advise_huge_pages(data_.get(), whole);
    }

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::size_t bytes() const { return size_ * sizeof(T); }
    [[nodiscard]] T* data() { return data_.get(); }
    [[nodiscard]] const T* data() const { return data_.get(); }

  private:
    static constexpr std::size_t huge_page = std::size_t{1} << 21;
    struct Free {
        void operator()(T* p) const { std::free(p); }
    };
    std::size_t size_ = 0;
    std::unique_ptr<T[], Free> data_;
};

} // namespace hemilux
