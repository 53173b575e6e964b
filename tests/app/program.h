#pragma once
// Runs the built program in a folder of its own and collects what it says.

#include <filesystem>
#include <string>

namespace test {

/// Towards the red wall of the room that `write_room` writes. To choose a camera takes the program
/// longer than all else of a short run.
inline const std::string camera_in_room = "--camera .9,.5,.5,.1,.5,.5 ";

/// A folder that is removed at the end of the test.
class Workplace {
  public:
    Workplace();
    ~Workplace();
    Workplace(const Workplace&) = delete;
    Workplace& operator=(const Workplace&) = delete;

    [[nodiscard]] std::filesystem::path path(const std::string& name) const {
        return folder_ / name;
    }
    [[nodiscard]] bool has(const std::string& name) const {
        return std::filesystem::exists(path(name));
    }
    void write(const std::string& name, const std::string& content) const;
    [[nodiscard]] std::string read(const std::string& name) const;

    struct Outcome {
        int code; ///< 128 + signal where one ended it
        std::string out, err;
    };
    /// `hemilux ARGUMENTS` by the shell, which expands them, inside the folder.
    [[nodiscard]] Outcome hemilux(const std::string& arguments) const;

    /// The same as so many processes that mpirun starts.
    [[nodiscard]] Outcome hemilux_on(int ranks, const std::string& arguments) const;

    /// room.obj with room.mtl: a closed box of 24 quads, a lamp in its ceiling, groups `walls`,
    /// `lamp` and `detail_floor`.
    void write_room() const;

  private:
    [[nodiscard]] Outcome run(const std::string& command) const;

    std::filesystem::path folder_;
};

} // namespace test
