#include "app/running/write_report.h"

#include "app/running/signals.h"
#include "app/settings/exit_code.h"
#include "app/terminal/log.h"
#include "io/files/error.h"

#include <new>

namespace hemilux {

void WriteReport::attempt(const std::string& path, const std::function<void()>& write) {
    try {
        write();
        written.push_back(path);
    } catch (const Interrupted&) {
        left_out.push_back(path);
    } catch (const OutputError& error) {
        failed.emplace_back(error.what());
    } catch (const std::bad_alloc&) {
        failed.push_back(path + ": there is not enough memory to write it");
    } catch (const std::exception& error) {
        failed.push_back(path + ": " + error.what());
    }
}

void WriteReport::add(const WriteReport& other) {
    written.insert(written.end(), other.written.begin(), other.written.end());
    failed.insert(failed.end(), other.failed.begin(), other.failed.end());
    left_out.insert(left_out.end(), other.left_out.begin(), other.left_out.end());
}

int WriteReport::exit_code(bool interrupted) const {
    if (!failed.empty())
        return exit_output;
    return interrupted ? exit_code_of_signal() : exit_done;
}

void WriteReport::log(Verbosity verbosity) const {
    for (const std::string& path : written)
        log_path(verbosity, Verbosity::normal, "wrote", path);
    for (const std::string& path : left_out)
        log_path(verbosity, Verbosity::quiet, "interrupted; left out", path);
    for (const std::string& message : failed)
        hemilux::log_line(verbosity, Verbosity::quiet, "hemilux: " + message);
}

void WriteReport::log_interruption(Verbosity verbosity, bool interrupted) const {
    if (interrupted && left_out.empty())
        log_line(verbosity, Verbosity::quiet,
                 failed.empty() ? "interrupted; all outputs are written" : "interrupted");
}

} // namespace hemilux
