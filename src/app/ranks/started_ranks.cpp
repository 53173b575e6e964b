#include "app/ranks/started_ranks.h"

#include "app/settings/exit_code.h"
#include "io/files/atomic_file.h"
#include "mpi/ranks_by_mpi.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <filesystem>
#include <string_view>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace hemilux {
namespace {

namespace fs = std::filesystem;

/// Returns the number of processes that the environment names: of Open MPI, of MPICH and its kin,
/// or of a step of Slurm.
int count_of_started() {
    for (const char* const name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
        const char* const text = std::getenv(name);
        const bool is_slurm = name[0] == 'S';
        if (!text || (is_slurm && !std::getenv("PMIX_RANK")))
            continue;
        int count = 0;
        const std::string_view digits(text);
        std::from_chars(digits.data(), digits.data() + digits.size(), count);
        return count;
    }
    return 1;
}

/// Makes the rank a child of this process, which waits for it and ends as it does. Where a signal
/// killed the rank, this process ends with an exit code: from a signal mpirun would make one of its
/// own.
void be_watched() {
    const pid_t rank = fork();
    if (rank < 0)
        return; // and nobody watches
    if (rank == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        return;
    }
    for (const int of_both : {SIGINT, SIGTERM}) // mpirun sends them to the group
        std::signal(of_both, SIG_IGN);
    int status = 0;
    while (waitpid(rank, &status, 0) < 0 && errno == EINTR) {
    }
    if (!WIFSIGNALED(status))
        _exit(WEXITSTATUS(status));
    (void)std::fprintf(stderr, "hemilux: a rank was killed by signal %d (%s)\n", WTERMSIG(status),
                       strsignal(WTERMSIG(status)));
    _exit(exit_output);
}

/// Opens the module, beside the program where it was built, or where it is installed.
void* open_module() {
    std::error_code error;
    const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
    for (const char* const place : {"", HEMILUX_MODULE_FOLDER})
        if (const fs::path path = folder / place / "hemilux_mpi.so"; fs::exists(path, error))
            return dlopen(path.c_str(), RTLD_NOW | RTLD_GLOBAL);
    return nullptr;
}

template <class Function>
Function function_of(void* module, const char* name) {
    return reinterpret_cast<Function>(dlsym(module, name));
}

} // namespace

StartedRanks::StartedRanks() {
    if (count_of_started() < 2)
        return;
    be_watched();
    load();
    if (!ranks_->is_first())
        be_silent();
}

void StartedRanks::load() {
    void* const module = open_module();
    const auto start =
        module ? function_of<StartRanks>(module, start_ranks_name) : StartRanks(nullptr);
    const Ranks* const started = start ? start() : nullptr;
    if (!started)
        throw UsageError(
            "several processes were started together, and this program was built without MPI; "
            "install Open MPI (libopenmpi-dev) and build it again, or start it alone");
    ranks_ = started;
    end_ranks_ = function_of<EndRanks>(module, end_ranks_name);
    abort_ranks_ = function_of<AbortRanks>(module, abort_ranks_name);
}

void StartedRanks::be_silent() {
    write_no_files();
    errors_ = dup(STDERR_FILENO);
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
}

int StartedRanks::end(int code) const { return end_ranks_ ? end_ranks_(code) : code; }

void StartedRanks::fail(int code, const std::string& message) const {
    constexpr auto until_the_first_has_spoken = std::chrono::seconds(2);
    if (!abort_ranks_)
        return;
    if (!ranks_->is_first()) {
        std::this_thread::sleep_for(until_the_first_has_spoken);
        const std::string text =
            "hemilux: rank " + std::to_string(ranks_->index()) + ": " + message + "\n";
        (void)!::write(errors_, text.data(), text.size());
    }
    abort_ranks_(code);
}

} // namespace hemilux
