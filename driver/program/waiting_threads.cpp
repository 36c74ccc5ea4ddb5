#include "driver/program/waiting_threads.hpp"

#include <omp.h>
#include <sys/prctl.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <latch>
#include <memory>
#include <mutex>
#include <optional>
#include <system_error>
#include <vector>

/// Of libomp only.
extern "C" [[gnu::weak]] void kmp_set_blocktime(int milliseconds);

namespace tanktread::driver {
namespace {

constexpr auto interval = std::chrono::milliseconds(100);

/// Of all threads of the program, in seconds.
struct ThreadTimes {
  double run = 0, waited = 0;
};

/// nullopt if the system does not tell.
std::optional<ThreadTimes> thread_times() {
  ThreadTimes sum;
  std::error_code error;
  std::filesystem::directory_iterator threads("/proc/self/task", error);
  for (; !error && threads != std::filesystem::directory_iterator(); threads.increment(error)) {
    // By C's own functions: this is done ten times a second for every thread, beside them.
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
        std::fopen((threads->path() / "schedstat").c_str(), "r"), std::fclose);
    double run = 0, waited = 0;                                                     // nanoseconds
    if (!file || std::fscanf(file.get(), "%lf %lf", &run, &waited) != 2) continue;  // it has just ended
    sum.run += 1e-9 * run;
    sum.waited += 1e-9 * waited;
  }
  return error || sum.run == 0 ? std::nullopt : std::optional(sum);
}

/// For lists of threads (top -H). Those that it makes have its name too.
void name_this_thread(const char* name) {
  prctl(PR_SET_NAME, name);
}

/// So many can be had at once: libgomp would end the program if not. @throws std::system_error
void try_threads(int n) {
  std::latch all_are_there(1);
  std::vector<std::jthread> threads;
  try {
    for (int k = 0; k < n; ++k) threads.emplace_back([&] { all_are_there.wait(); });
  } catch (...) {
    all_are_there.count_down();
    throw;
  }
  all_are_there.count_down();
}

/// As many threads of OpenMP as there are cores, asleep while it lives. With the two or more that wait for
/// each other those are more than there are cores, however the first is counted, which is the program's own.
class SleepingTeam {
 public:
  /// @throws std::system_error if there are no threads to be had
  SleepingTeam() {
    try_threads(omp_get_num_procs() + 1);  // and the one that they are made by
    first_ = std::jthread([this](const std::stop_token& stop) {
      name_this_thread("sleeping");
#pragma omp parallel num_threads(omp_get_num_procs())
      asm volatile("");  // or a compiler may leave the team out
      std::unique_lock lock(mutex_);
      woken_.wait(lock, stop, [] { return false; });
    });  // libgomp takes the others away as it ends
  }

 private:
  std::mutex mutex_;
  std::condition_variable_any woken_;
  std::jthread first_;  ///< the last member: it uses the others
};

/// Until it is to stop, or there is no thread to be had.
void watch(const std::stop_token& stop) try {
  name_this_thread("watching cores");
  SharedCores cores;
  std::optional<SleepingTeam> team;
  std::mutex mutex;
  std::condition_variable_any woken;
  std::unique_lock lock(mutex);
  while (!woken.wait_for(lock, stop, interval, [&] { return stop.stop_requested(); })) {
    const auto times = thread_times();
    if (!times) return;
    const bool shared = cores.observe(times->run, times->waited);
    if (!shared) team.reset();
    if (shared && !team) team.emplace();
  }
} catch (const std::system_error&) {
}

}  // namespace

bool SharedCores::observe(double run, double waited) {
  constexpr double share_that_tells = 0.1, least_seconds = 0.02;
  constexpr int n_at_first = 5, n_on_trial = 2, n_until_free = 5, n_longest_trial = 40;
  const double ran = run - run_, delay = waited - waited_;
  run_ = run;
  waited_ = waited;
  if (ran < 0 || delay < 0 || ran + delay < least_seconds) return shared_;
  if (shared_ && ++n_shared_ >= n_until_trial_) {
    shared_ = false;
    n_shared_ = n_other_ = n_since_trial_ = 0;
    n_until_trial_ = std::min(2 * n_until_trial_, n_longest_trial);
    return shared_;
  }
  if (!shared_ && ++n_since_trial_ > n_first_trial) n_until_trial_ = n_first_trial;
  const bool now = delay > share_that_tells * (ran + delay);
  n_other_ = now == shared_ ? 0 : n_other_ + 1;
  const int n_until_shared = n_until_trial_ == n_first_trial ? n_at_first : n_on_trial;
  if (n_other_ < (shared_ ? n_until_free : n_until_shared)) return shared_;
  n_other_ = n_shared_ = 0;
  shared_ = now;
  return shared_;
}

WaitingThreads::WaitingThreads() {
  if (std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT") || kmp_set_blocktime) return;
  try {
    watch_ = std::jthread(watch);
  } catch (const std::system_error&) {
    // No thread to be had: they wait as libgomp has it.
  }
}

}  // namespace tanktread::driver
