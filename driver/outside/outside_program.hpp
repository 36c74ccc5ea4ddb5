// A user's program in the place of a component: a packet a step to it, and a packet back.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "driver/case/case.hpp"
#include "driver/outside/child_process.hpp"
#include "driver/outside/packet_directory.hpp"
#include "exchange/vtk_files.hpp"

namespace tanktread::driver {

/// What came back, and the name of its file, for messages.
template <class Packet>
struct Reply {
  Packet packet;
  std::string file;
};

/// Starts with the component and ends with it. The protocol: docs/outside-programs.md.
class OutsideProgram {
 public:
  /// @param place the component and which one, as a folder's name: "membrane_0", "fluid"
  /// @param component the same for a person: "membrane of capsule 0"
  /// @throws InputError if it cannot be started
  OutsideProgram(const std::vector<std::string>& command, const RunCase& run, const std::string& place,
                 std::string component);

  /// Hands a packet to the program and reads the packet that it answers with.
  /// @throws NoAnswer; exchange::FileError if a packet cannot be written or read
  Reply<exchange::SurfacePacket> ask(const exchange::SurfacePacket& input);
  Reply<exchange::GridPacket> ask(const exchange::GridPacket& input);

  /// Calls `exchange_packets`. @throws RunError that names step and program in place of NoAnswer and
  /// FileError
  template <class Call>
  auto in_step(std::int64_t step, Call exchange_packets) const {
    try {
      return exchange_packets();
    } catch (const exchange::FileError& error) {
      report(step, error.what());
    } catch (const NoAnswer& error) {
      report(step, error.what());
    }
  }

  /// "the membrane of capsule 0, /usr/bin/python3 my_membrane.py".
  std::string name() const { return component_ + ", " + command_; }

 private:
  [[noreturn]] void report(std::int64_t step, const std::string& what) const;

  std::string component_, command_;
  PacketDirectory directory_;
  std::unique_ptr<ChildProcess> process_;  // ends before its directory goes
};

/// The array of that name in a reply.
/// @param n_tuples on as many points or triangles
/// @param where "point data"
/// @throws exchange::FileError naming file, array, what it is and what was expected
const exchange::Array& reply_array(const std::vector<exchange::Array>& arrays, const std::string& array,
                                   int components, std::size_t n_tuples, const std::string& where,
                                   const std::string& file);

/// @throws exchange::FileError if a reply that says its step is of another
void check_reply_step(const std::vector<exchange::Array>& field_data, std::int64_t step,
                      const std::string& file);

}  // namespace tanktread::driver
