#pragma once
// The bytes of a glTF file's buffers, and the elements of accessors in them (section 3.6).

#include "io/gltf/document/container.h"
#include "io/gltf/document/document.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hemilux::gltf {

/// The buffers, each read when it is first asked for.
class Buffers {
  public:
    Buffers(const Document& document, const Container& container, const std::string& path,
            const ReadGuard& guard, OutsideFiles& outside)
        : document_(document), container_(container), path_(path), guard_(guard), outside_(outside),
          contents_(document.buffers.size()) {}

    /// Returns the bytes of a view. Throws InputError where the buffer cannot be read or is shorter
    /// than the file says.
    [[nodiscard]] std::string_view view(std::size_t view);

    /// Returns all bytes of a buffer. Throws in the same way.
    [[nodiscard]] std::string_view content(std::size_t buffer);

    [[nodiscard]] const Document& document() const { return document_; }
    [[nodiscard]] const std::string& path() const { return path_; }
    /// Is called before a file is read that the document names at this place.
    void check_outside(const std::string& file, const std::string& place, const std::string& what) {
        outside_.check(file, path_ + ": " + place, what);
    }
    /// Returns the files that were read.
    [[nodiscard]] const std::vector<std::string>& files() const { return files_; }

  private:
    [[nodiscard]] std::string read(std::size_t buffer, const std::string& uri);

    const Document& document_;
    const Container& container_;
    const std::string& path_;
    const ReadGuard& guard_;
    OutsideFiles& outside_;
    std::vector<std::optional<std::string>> contents_;
    double bytes_ = 0; ///< of the contents
    std::vector<std::string> files_;
};

/// The elements of an accessor, normalized where it says so.
class Elements {
  public:
    /// Throws InputError, also where the indices of sparse elements do not ascend.
    Elements(Buffers& buffers, std::size_t accessor);

    [[nodiscard]] std::size_t size() const { return accessor_.count; }
    [[nodiscard]] double at(std::size_t element, std::size_t component) const;
    /// Returns an element of an accessor of whole numbers.
    [[nodiscard]] std::uint32_t whole_at(std::size_t element) const;
    /// Returns the bytes of an element, as the file has them.
    [[nodiscard]] std::string bytes_at(std::size_t element) const;
    [[nodiscard]] std::size_t element_bytes() const { return element_bytes_; }
    /// Throws InputError unless the accessor has this type and one of these components.
    void check(const char* type, std::initializer_list<Component> components) const;
    [[noreturn]] void fail(const std::string& message) const;

  private:
    [[nodiscard]] const char* place_of(std::size_t element) const;

    const Accessor& accessor_;
    std::size_t number_;
    const std::string& path_;
    const char* first_ = nullptr; ///< none: zeros
    std::size_t stride_ = 0;
    std::vector<std::uint32_t> sparse_;   ///< indices of elements that are replaced
    const char* sparse_values_ = nullptr; ///< close together
    std::size_t element_bytes_;
};

} // namespace hemilux::gltf
