// How long threads wait awake for each other: as long as libgomp has it while they have the cores to
// themselves, and hardly at all while they share them with other programs.
//
// At the end of a parallel loop a thread of libgomp (GCC's OpenMP) spins some milliseconds before it sleeps.
// Alone that is the fastest; beside another program a thread that spins holds the core which the one that it
// waits for would need, and a run takes ten times as long and more. No one number of spins (GOMP_SPINCOUNT)
// is right for both: 1000 lose 3 % alone and a third beside. But "if there are more OpenMP threads than
// available CPUs" libgomp spins a hundred times only (its manual, GOMP_SPINCOUNT), and it looks at that
// number in every wait. So there are more while the cores are shared: another team, which sleeps. Its threads
// take no time themselves, and it is gone when the cores are free again.
//
// Turned down: to set GOMP_SPINCOUNT, which libgomp reads when it is loaded, and to start the program once
// more by exec, which debuggers and checkers of memory do not all follow; and to set it before libgomp is
// loaded, for in .preinit_array glibc has no environment yet, and replaces what is set there.
//
// With LLVM's libomp nothing is done: its threads spin for 0.2 s, give way to those of its own only (which
// does not help, tried with such a team), and what governs that (KMP_BLOCKTIME) is set by the thread that
// opens the loops. Beside other programs a user sets OMP_WAIT_POLICY=passive there.
#pragma once

#include <thread>

namespace tanktread::driver {

/// Whether other programs share the cores of this one: its threads then wait for a core, although they could
/// run.
class SharedCores {
 public:
  /// Takes the present times, some tenths of a second after the last ones. The cores are shared after five
  /// times in a row in which the threads waited for more than a tenth of what they wanted to run, and free
  /// again after five in which they did not: what goes by in a moment changes nothing. Times in which they
  /// hardly wanted to run say nothing, nor do sums that are smaller, because threads have ended.
  ///
  /// Threads that sleep between their loops get in each other's way when they wake, which looks like another
  /// program. So shared cores are taken for free, on trial, after ten times, and if they turn out to be
  /// shared, for which two times in a row are enough then, after 20 and then 40 more.
  /// @param run, waited seconds that all threads together have run, and waited for a core, since they began
  /// @return whether the cores are shared
  bool observe(double run, double waited);

 private:
  static constexpr int n_first_trial = 10;

  double run_ = 0, waited_ = 0;
  int n_other_ = 0;                    ///< times in a row that said the other
  int n_shared_ = 0;                   ///< times since they are shared
  int n_until_trial_ = n_first_trial;  ///< of these, until they are taken for free
  int n_since_trial_ = 0;              ///< times since they are free
  bool shared_ = false;
};

/// Looks after the waiting threads of the program while it lives: one at a time. It does nothing where the
/// user has said how they wait (OMP_WAIT_POLICY or GOMP_SPINCOUNT), with libomp, and
/// where the system does not tell what threads wait for (/proc/self/task/N/schedstat).
class WaitingThreads {
 public:
  WaitingThreads();

 private:
  std::jthread watch_;
};

}  // namespace tanktread::driver
