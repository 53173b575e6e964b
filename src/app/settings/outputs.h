#pragma once
// The places where results go. Each file is checked before the work begins, so that an hour of
// computing is not lost to a mistyped folder.

#include "io/files/file_identity.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hemilux {

enum class OutputKind { png, hdr, exr, ply, glb, obj, vtu, csv, json };

/// A file that the user asked for.
struct Output {
    std::string path;
    OutputKind kind;
};

[[nodiscard]] constexpr bool is_picture(OutputKind kind) {
    return kind == OutputKind::png || kind == OutputKind::hdr || kind == OutputKind::exr;
}

/// Returns whether `bake` writes it: the scene's own file.
[[nodiscard]] constexpr bool is_own_file(OutputKind kind) {
    return kind == OutputKind::glb || kind == OutputKind::obj;
}

/// Returns the kind of output by the extension of the path, in small or capital letters; empty if
/// it is unknown. "-" is a patch table on standard output, and "-.ply" another kind there.
[[nodiscard]] std::optional<Output> parse_output(std::string_view path);

/// Returns the file of --lightmap beside a .glb file: scene.glb has scene.lightmap.exr.
[[nodiscard]] std::string lightmap_path(const std::string& glb);
/// Returns the file of an object of that name: scene.glb has scene.NAME.lightmap.exr.
[[nodiscard]] std::string lightmap_path(const std::string& glb, const std::string& object);

/// Throws OutputError where no file can be made or replaced at the path, links being followed.
void check_writable(const std::string& path);

/// The files of one run. An output replaces a file, so it may not be another output or a file that
/// is read, under whatever name. All functions throw UsageError for such a pair.
class RunFiles {
  public:
    void write(const std::string& role, const std::string& path);
    /// Adds the pictures of steps that exist, as StepPictures names them.
    void write_steps(const std::string& path);
    /// Checks a file that is read, after all that are written.
    void read(const std::string& role, const std::string& path) const;

  private:
    struct Entry {
        std::string role, path;
        std::optional<FileIdentity> identity;
    };
    void check(const Entry& added) const;

    std::vector<Entry> written_;
};

/// Returns the files of a run that reads a scene and writes these outputs. Throws UsageError,
/// OutputError.
[[nodiscard]] RunFiles check_files(const std::vector<std::string>& outputs,
                                   const std::string& scene);

} // namespace hemilux
