// The error of a step that one rank would have met first, of those that several have met.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "coupler/inside.hpp"
#include "coupler/tangential_correction.hpp"
#include "driver/system/implicit_forces.hpp"
#include "driver/system/phases.hpp"
#include "fluid/fluid.hpp"
#include "membrane/membrane.hpp"
#include "ranks/packing.hpp"

namespace tanktread::driver {

/// What may go wrong in a step, in the order in which one rank would meet it; before the first one a capsule
/// may not fit the state that it is to be restored to.
enum class StepPhase { restore, correction, move, forces, stencils, implicit_forces, inside, flow };

/// What went wrong in a step.
struct StepError {
  StepPhase phase = StepPhase::flow;
  std::uint64_t precedence = 0;  ///< within the phase: by capsule, node, grid node
  bool says_step = false;        ///< the message tells the step
  std::string message;

  bool is_before(const StepError& other) const {
    return phase != other.phase ? phase < other.phase : precedence < other.precedence;
  }
};

inline void pack(ranks::Packing& packing, const StepError& error) {
  packing.put(error.phase).put(error.precedence).put(error.says_step).put_text(error.message);
}
inline StepError take_step_error(ranks::Unpacking& unpacking) {
  StepError error;
  error.phase = unpacking.take<StepPhase>();
  error.precedence = unpacking.take<std::uint64_t>();
  error.says_step = unpacking.take<bool>();
  error.message = unpacking.take_text();
  return error;
}

/// Keeps the first error of a rank's step, which goes on to where all ranks agree that it has failed: the
/// others wait for what it sends.
class FirstError {
 public:
  /// Calls a part of the step, unless one has failed already. What a step may end with is kept, all else goes
  /// through.
  template <class Part>
  void guard(StepPhase phase, const Part& part) {
    if (error_) return;
    try {
      part();
    } catch (const fluid::Breakdown& error) {
      keep({phase, static_cast<std::uint64_t>(error.node()), true, error.what()});
    } catch (const LongMove& error) {
      keep({phase, error.precedence, false, error.what()});
    } catch (const CapsuleInverted& error) {
      keep({phase, error.precedence, false, error.what()});
    } catch (const coupler::StencilError& error) {
      keep({phase, error.precedence, false, error.what()});
    } catch (const coupler::CorrectionError& error) {
      keep({phase, error.precedence, false, error.what()});
    } catch (const coupler::InsideError& error) {
      keep({phase, error.precedence, false, error.what()});
    } catch (const NotConverged& error) {
      keep({phase, 0, false, error.what()});
    }
  }

  /// Keeps an error, if there is none yet.
  void keep(StepError error) {
    if (!error_) error_ = std::move(error);
  }

  /// The error of another account, if there is none yet.
  void take(const FirstError& other) {
    if (other.error_) keep(*other.error_);
  }

  const std::optional<StepError>& error() const { return error_; }

 private:
  std::optional<StepError> error_;
};

}  // namespace tanktread::driver
