#include "driver/engine/followers.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include "driver/engine/capsule_orders.hpp"
#include "driver/engine/part_answers.hpp"
#include "driver/engine/part_files.hpp"
#include "driver/engine/system_part.hpp"
#include "driver/system/part_orders.hpp"
#include "driver/units/units.hpp"

namespace tanktread::driver {
namespace {

using Nodes = std::vector<std::int64_t>;
using Numbers = std::vector<double>;
using ranks::Packing;
using ranks::Unpacking;

/// The part of this rank, and what it is asked.
class Follower {
 public:
  explicit Follower(const ranks::World& world) : world_(world) {}

  /// @return false for Order::end
  bool obey(Order order, Unpacking& message) {
    switch (order) {
      case Order::make_part: {
        const auto box = message.take<ranks::Box>();
        division_.emplace(box, message.take<ranks::Triple>());
        const auto settings = message.take<fluid::LatticeBoltzmannSettings>();
        part_ = make_part(world_, *division_, settings);
        base_viscosity_ = fluid::viscosity_of(settings);
        return true;
      }
      case Order::give_up_part:
        end_exchange(*part_);
        part_.reset();
        nodes_.clear();
        return true;
      case Order::end:
        return false;
      default:
        if (order >= Order::make_system && order <= Order::write_pieces) {
          of_system(order, message);
          return true;
        }
        return of_part(order, message);
    }
  }

 private:
  void of_system(Order order, Unpacking& message) {
    switch (order) {
      case Order::make_system: {
        const auto the_case = take_case(message);
        system_.emplace(world_, *division_, *part_, the_case, parameters(the_case));
        return;
      }
      case Order::give_up_system:
        return system_.reset();
      case Order::begin:
        return answer_if_wrong(system_->begin(message.take<std::int64_t>(), {}));
      case Order::begin_from_case: {
        auto made = make_capsules(world_, system_->the_case());
        return answer_if_wrong(system_->begin(0, std::move(made.capsules), made.error));
      }
      case Order::begin_from_pieces: {
        const auto step = message.take<std::int64_t>();
        auto read = read_capsules(world_, message.take_text(), system_->the_case().capsules.size());
        if (!read.all_well) return answer(Packing().put_text(read.error));
        return answer_if_wrong(system_->begin(step, std::move(read.capsules)));
      }
      case Order::share_out:
        return system_->share_out();
      case Order::advance:
        return answer_if_wrong(system_->advance());
      case Order::write_surfaces:
        return answer(Packing().put_text(write_surfaces(*system_, take_surfaces_to_write(message)).error));
      case Order::write_pieces: {
        const FluidPart part{world_, *division_, *part_, base_viscosity_, system_->marks()};
        return answer(Packing().put_text(write_piece(part, take_pieces_order(message)).error));
      }
      default:
        return look_at(order);
    }
  }

  /// Orders to say what there is.
  void look_at(Order order) {
    Packing packing;
    switch (order) {
      case Order::observe:  // what is of all ranks the first one knows
        packing.put_all(observe(system_->capsules(), system_->the_case(), 0, std::nullopt));
        break;
      case Order::measures:
        pack(packing, measures_rows(*system_));
        break;
      case Order::energy:
        pack(packing, energy_of(*system_, *part_));
        break;
      case Order::marks:
        packing.put_all(system_->marks());
        break;
      default:
        throw std::logic_error("the first rank gave an order that is none");
    }
    answer(packing);
  }

  void answer_if_wrong(const PartStep& step) const {
    if (!step.all_well) answer(packed(step.error));
  }

  bool of_part(Order order, Unpacking& message) {
    switch (order) {
      case Order::velocity: {
        Numbers velocity(3 * nodes_.size());
        part_->velocity(nodes_, velocity);
        answer(Packing().put_all(velocity));
        return true;
      }
      case Order::free_velocity: {
        Numbers velocity(3 * nodes_.size()), mobility(nodes_.size());
        part_->free_velocity(nodes_, velocity, mobility);
        answer(Packing().put_all(velocity));
        answer(Packing().put_all(mobility));
        return true;
      }
      case Order::dissipation:
        answer(Packing().put_all(power_in(*part_, &fluid::Fluid::dissipation)));
        return true;
      case Order::wall_power:
        answer(Packing().put_all(power_in(*part_, &fluid::Fluid::wall_power)));
        return true;
      case Order::moments: {
        const auto of_box = message.take<fluid::Layers>();
        const auto moments = moments_of(*part_, own_layers(of_box, division_->block(world_.rank())));
        answer(Packing().put_all(moments.density));
        answer(Packing().put_all(moments.velocity));
        return true;
      }
      case Order::force:
        answer(Packing().put_all(part_->force()));
        return true;
      case Order::step: {
        Packing packing;
        pack(packing, step_of(*part_));
        answer(packing);
        return true;
      }
      case Order::state: {
        Packing packing;
        pack(packing, part_->state());
        answer(packing);
        return true;
      }
      case Order::restore_pieces: {
        Packing packing;
        pack(packing, restore_part(world_, *part_, *division_, message.take_text()));
        answer(packing);
        return true;
      }
      default:
        change(order, message);
        return true;
    }
  }

  /// Orders without an answer.
  void change(Order order, Unpacking& message) {
    switch (order) {
      case Order::nodes:
        nodes_ = message.take_all<std::int64_t>();
        return;
      case Order::add_force:
        return part_->add_force(nodes_, message.take_all<double>());
      case Order::clear_force:
        return part_->clear_force();
      case Order::set_viscosities:
        return part_->set_viscosity(message.take_all<double>());
      case Order::set_viscosity_of: {
        const auto nodes = message.take_all<std::int64_t>();
        return part_->set_viscosity(nodes, message.take_all<double>());
      }
      case Order::restore:
        return part_->restore(take_state(message));
      default:
        throw std::logic_error("the first rank gave an order that is none");
    }
  }

  void answer(const Packing& packing) const { world_.send(0, packing.bytes()); }

  const ranks::World& world_;
  std::optional<ranks::Division> division_;
  std::unique_ptr<fluid::Fluid> part_;
  double base_viscosity_ = 0;
  std::optional<SystemPart> system_;
  Nodes nodes_;  ///< that velocities and forces are of
};

}  // namespace

void follow(const ranks::World& world) {
  Follower follower(world);
  for (bool goes_on = true; goes_on;) {
    Unpacking message(world.receive(0));
    const auto order = message.take<Order>();
    goes_on = follower.obey(order, message);
  }
}

void end_followers(const ranks::World& world) {
  tell_others(world, order(Order::end).bytes());
}

}  // namespace tanktread::driver
